// Addresses: #four_bar opens a case, #four_bar/A.force one of its quantities, #heat?theme=loops a choice.
function open(section, quantity) {
  section.open = true;
  fill(section);
  if (quantity) section.show(quantity);
  section.scrollIntoView();
}

function fill(section) {
  if (section.dataset.full) return;
  section.dataset.full = 'yes';
  build(section);
}

function follow() {
  const [, id, rest] = /^#([^?/]*)[?/]?(.*)$/.exec(location.hash) || [];
  if (!id) return;
  const found = document.getElementById(decodeURIComponent(id));
  if (!found) return;
  if (found.matches('details.case')) return open(found, decodeURIComponent(rest));
  const form = found.querySelector('form.filters');
  if (form && rest) {
    const chosen = new URLSearchParams(rest);
    for (const field of choices(form)) field.value = chosen.get(field.name) || '';
    apply(form);
    found.scrollIntoView();
  }
}

function stickSlip() {
  for (const place of document.querySelectorAll('#stick-slip-figures figure')) {
    const motion = MOTIONS[place.dataset.case], {quantity} = place.dataset;
    const rows = ROWS.cases[place.dataset.case].rows.filter((row) => word(row[1]) === quantity);
    const found = curvesOf(motion, quantity, (one) => one.engine === 'book' || one.realised !== 'driver');
    const allow = (rows.find((row) => row[4]) || [])[4] || 1;
    place.append(place.dataset.plot === 'tube' ? tubePlot(quantity, word(rows[0][2]), allow, found) : errorPlot(quantity, allow, found, rows));
    document.getElementById('stick-slip-keys').replaceChildren(keyOf([{look: 'reference', title: 'exact law'}, ...found.engines]));
  }
}

async function begin() {
  filters();
  if (!globalThis.DecompressionStream) {
    document.getElementById('old').hidden = false;
    return;
  }
  await read();
  for (const section of document.querySelectorAll('details.case')) section.addEventListener('toggle', () => {
    if (!section.open) return;
    fill(section);
    if (!location.hash.startsWith(addressOf(section.id))) history.replaceState(null, '', addressOf(section.id));
  });
  stickSlip();
  addEventListener('hashchange', follow);
  follow();
  document.documentElement.dataset.ready = 'yes';
}
begin();
