// Addresses: #four_bar opens a case, #four_bar/A.force one of its quantities, #heat?theme=loops a choice.
function reveal(node) {
  for (let outer = node; outer; outer = outer.parentElement) if (outer.matches('details')) outer.open = true;
}

function fill(section) {
  if (section.dataset.full) return;
  section.dataset.full = 'yes';
  if (section.matches('.case')) build(section);
  if (section.id === 'work') work();
  if (section.id === 'stick-slip') stickSlip();
}

function follow() {
  const [, id, rest] = /^#([^?/]*)[?/]?(.*)$/.exec(location.hash) || [];
  const found = id && document.getElementById(decodeURIComponent(id));
  if (!found) return;
  reveal(found);
  if (ROWS && found.matches('details.case')) {
    fill(found);
    if (rest) found.show(decodeURIComponent(rest));
  }
  const form = found.querySelector('form.filters');
  if (form && rest) take(form, new URLSearchParams(rest));
  found.scrollIntoView();
}

function firstMotions() {
  for (const place of document.querySelectorAll('#in-motion figure')) {
    const name = place.dataset.case, named = [...place.querySelectorAll('[data-ghost]')];
    for (const ghost of named) ghost.prepend(swatch(COLUMN.get(ghost.dataset.ghost).look), ' ');
    place.prepend(...animation(name, MOTIONS[name], named.map((ghost) => ghost.dataset.ghost)));
  }
}

function stickSlip() {
  for (const place of document.querySelectorAll('#stick-slip-figures figure')) {
    const motion = MOTIONS[place.dataset.case], {quantity} = place.dataset;
    const rows = ROWS.cases[place.dataset.case].rows.filter((row) => word(row[1]) === quantity);
    const found = curvesOf(motion, quantity, (one) => one.engine === 'book' || one.realised !== 'driver');
    const allow = (rows.find((row) => row[4]) || [])[4] || 1, unit = word(rows[0][2]), tube = place.dataset.plot === 'tube';
    place.append(tube ? tubePlot(quantity, unit, allow, found) : errorPlot(quantity, allow, found, rows));
    if (tube) place.querySelector('figcaption').append(leaving(unit, allow, found));
    document.getElementById('stick-slip-keys').replaceChildren(keyOf([{look: 'reference', title: 'exact law'}, ...found.engines]));
  }
}

function work() {
  const place = document.getElementById('work-figures'), form = document.getElementById('precision');
  if (!place) return;
  const show = () => {
    const precision = Number(form.elements.precision.value);
    const kinds = [...new Set(ROWS.work.flatMap((panel) => Object.keys(panel.curves)))].map((key) => COLUMN.get(key));
    const rank = ({engine, setting}) => COLUMNS.findIndex((one) => one.engine === engine && one.setting === setting);
    kinds.sort((a, b) => rank(a) - rank(b));
    document.getElementById('work-keys').replaceChildren(keyOf(kinds));
    place.replaceChildren(...ROWS.work.map(({theme, cases, curves}) => {
      const drawn = Object.entries(curves).map(([key, found]) => {
        const [x, y] = found[precision], corners = {x: [], y: []};
        x.forEach((at, k) => { if (k) { corners.x.push(at); corners.y.push(y[k - 1]); } corners.x.push(at); corners.y.push(y[k]); });
        return {...COLUMN.get(key), ...corners, dots: 4};
      });
      const count = `${cases} ${cases === 1 ? 'case' : 'cases'}`;
      return figure(`${theme}: ${count}`, plot({title: `work against precision of ${theme}`, xLabel: 'steps per simulated second', yLabel: 'cases within [%]', x: [10, 1e5], y: [-3, 103], xLog: true, curves: drawn}));
    }));
  };
  form.addEventListener('input', show);
  show();
}

async function begin() {
  filters();
  addEventListener('hashchange', follow);
  if (!globalThis.DecompressionStream) {
    document.getElementById('old').hidden = false;
    return follow();
  }
  await read();
  for (const section of document.querySelectorAll('details.case, details.fold')) {
    const opened = () => { if (section.open) fill(section); };
    section.addEventListener('toggle', opened);
    opened();
    // What a person opens stands in the address.
    section.querySelector('summary').addEventListener('click', () => { if (!section.open) history.replaceState(null, '', addressOf(section.id)); });
  }
  firstMotions();
  follow();
  document.documentElement.dataset.ready = 'yes';
}
begin();
