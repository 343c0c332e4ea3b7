// Filters of tables: each row says in its data what it is; the choice stands in the address.
function choices(form) {
  return [...form.elements].filter((field) => field.name);
}

function chosen(form) {
  return new URLSearchParams(choices(form).filter((field) => field.value).map((field) => [field.name, field.value]));
}

function addressed(form) {
  const hash = `#${form.closest('details.fold, section').id}` + (String(chosen(form)) ? `?${chosen(form)}` : '');
  for (const link of form.querySelectorAll('.permalink')) link.setAttribute('href', hash);
  return hash;
}

function apply(form) {
  const wanted = Object.fromEntries(choices(form).map((field) => [field.name, field.value.trim().toLowerCase()]));
  const told = [];
  for (const name of (form.dataset.table || '').split(' ').filter(Boolean)) {
    const shown = document.getElementById(name), rows = [...shown.tBodies[0].rows];
    for (const cell of shown.querySelectorAll('[data-column]')) cell.hidden = Boolean(wanted.column) && cell.dataset.column !== wanted.column;
    for (const row of rows) row.hidden = !fits(row, wanted);
    if ('order' in wanted) sort(shown.tBodies[0], wanted.order);
    told.push(`${rows.filter((row) => !row.hidden).length} of ${rows.length}`);
  }
  const count = form.querySelector('.count');
  if (count) count.textContent = told.join(', by case ');
  return addressed(form);
}

function fits(row, wanted) {
  const {theme = '', words, engine = '', tolerance = ''} = row.dataset;
  const kinds = [...row.querySelectorAll('[data-kind]')].filter((cell) => !cell.hidden).map((cell) => cell.dataset.kind.toLowerCase());
  return (!wanted.theme || theme.split(' ').includes(wanted.theme))
    && (!wanted.words || words === undefined || wanted.words.split(/\s+/).every((part) => words.toLowerCase().includes(part)))
    && (!wanted.engine || engine.toLowerCase() === wanted.engine)
    && (!wanted.tolerance || tolerance.toLowerCase() === wanted.tolerance)
    && (!wanted.kind || kinds.includes(wanted.kind));
}

// By the worst of the cells that are shown: what was lost is worse than any number.
function badness(row) {
  const shown = [...row.querySelectorAll('[data-kind]')].filter((cell) => !cell.hidden && cell.dataset.kind !== 'refused');
  return Math.max(-1, ...shown.map((cell) => (isNaN(cell.textContent) ? Infinity : Number(cell.textContent))));
}

function sort(body, order) {
  const rows = [...body.rows].map((row, k) => [row, Number(row.dataset.place ??= k), order === 'worst' ? badness(row) : 0]);
  rows.sort(([, a, bad], [, b, worse]) => (bad === worse ? a - b : worse > bad ? 1 : -1));
  body.append(...rows.map(([row]) => row));
}

// A map is one stop of the tab key: arrows go from cell to cell, and each says its words.
function explore(map, words) {
  const cells = () => [...map.tBodies[0].rows].filter((row) => !row.hidden).map((row) => [...row.cells].filter((cell) => !cell.hidden));
  const say = (cell) => {
    const name = cell.parentNode.cells[0].textContent, rows = map.tHead.rows;
    const head = rows[1].cells[cell.cellIndex].innerText.replace(/\s+/g, ' ');
    const engine = cell.dataset.column;
    words.textContent = cell.cellIndex === 0 ? name : `${name}, ${engine} ${head}: ${cell.title || 'not run in this way'}`;
  };
  const go = (cell) => {
    for (const other of map.querySelectorAll('[tabindex="0"]')) other.tabIndex = -1;
    cell.tabIndex = 0;
    cell.focus();
  };
  map.tBodies[0].rows[0].cells[0].tabIndex = 0;
  map.addEventListener('focusin', (event) => { const cell = event.target.closest('tbody td, tbody th'); if (cell) say(cell); });
  map.addEventListener('click', (event) => { const cell = event.target.closest('tbody td'); if (cell) go(cell); });
  map.addEventListener('keydown', (event) => {
    const cell = event.target.closest('tbody td, tbody th'), step = {ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowDown: [1, 0], ArrowUp: [-1, 0]}[event.key];
    if (!cell) return;
    if (event.key === 'Enter') cell.parentNode.cells[0].querySelector('a').click();
    if (!step) return;
    event.preventDefault();
    const all = cells(), row = all.findIndex((one) => one.includes(cell)), at = all[row].indexOf(cell);
    const next = (all[row + step[0]] || [])[at + step[1]];
    if (next) go(next);
  });
}

// One setting for an engine, a theme and a tolerance: the row of the table that says so.
function choose(form) {
  const {engine, theme, tolerance} = Object.fromEntries(chosen(form)), place = document.getElementById('answer');
  const row = [...document.querySelectorAll('#advice-themes tbody tr')].find(({dataset: of}) => of.engine === engine && of.theme === theme && of.tolerance === tolerance);
  const more = html('a', {href: `#need?${chosen(form)}`}, 'all recipes of this choice, case by case');
  if (!row || !row.dataset.recipe) {
    place.replaceChildren(html('p', {}, row ? `No setting of ${engine} keeps a case about ${theme} within: ` : `No case about ${theme} was asked in ${engine}: `, more, '.'));
  } else {
    const [step, times] = ['.step', '.times'].map((cell) => row.querySelector(cell).textContent);
    const snippet = row.querySelector('.snippet').cloneNode(true);
    const none = row.dataset.most ? null : `No one setting of ${engine} does: each case about ${theme} needs its own. The one that most need, `;
    place.replaceChildren(html('p', {}, none, html('b', {}, row.dataset.recipe), ` at ${step} ${row.dataset.says}` + (times ? `, at ${times} the work as shipped: ` : ': '), more, '.'), snippet);
    copies(snippet);
  }
  return addressed(form);
}

function copies(place) {
  for (const button of place.querySelectorAll('.copy')) {
    button.addEventListener('click', async () => {
      const code = button.previousElementSibling;
      try {
        await navigator.clipboard.writeText(code.textContent);
        button.textContent = 'copied';
      } catch { // a file may not be let near the clipboard: then it is marked, to be copied by hand
        getSelection().selectAllChildren(code);
        button.textContent = 'marked';
      }
    });
  }
}

function take(form, values) {
  for (const field of choices(form)) if (values.has(field.name) || !form.matches('#chooser')) field.value = values.get(field.name) || '';
  return update(form);
}
const update = (form) => (form.id === 'chooser' ? choose(form) : apply(form));

function filters() {
  copies(document);
  for (const form of document.querySelectorAll('form.filters')) {
    form.addEventListener('submit', (event) => event.preventDefault());
    const told = Boolean(form.querySelector('.permalink'));
    form.addEventListener('input', () => { const hash = update(form); if (told) history.replaceState(null, '', hash); });
    update(form);
  }
  const map = document.getElementById('heat-map');
  if (map && map.tBodies[0].rows.length) explore(map, document.getElementById('heat-words'));
}
