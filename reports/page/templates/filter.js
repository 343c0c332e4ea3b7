// Filters of tables: each row says in its data what it is; the choice stands in the address.
function choices(form) {
  return [...form.elements].filter((field) => field.name);
}

function apply(form) {
  const wanted = Object.fromEntries(choices(form).map((field) => [field.name, field.value.trim().toLowerCase()]));
  const shown = document.getElementById(form.dataset.table), rows = [...shown.tBodies[0].rows];
  let count = 0;
  for (const cell of shown.querySelectorAll('[data-column]')) cell.hidden = Boolean(wanted.column) && cell.dataset.column !== wanted.column;
  for (const row of rows) {
    const {theme = '', words = '', engine = '', tolerance = ''} = row.dataset;
    const kinds = [...row.querySelectorAll('[data-kind]')].filter((cell) => !cell.hidden).map((cell) => cell.dataset.kind.toLowerCase());
    const fits = (!wanted.theme || theme.split(' ').includes(wanted.theme))
      && (!wanted.words || wanted.words.split(/\s+/).every((part) => words.toLowerCase().includes(part)))
      && (!wanted.engine || engine.toLowerCase() === wanted.engine)
      && (!wanted.tolerance || tolerance.toLowerCase() === wanted.tolerance)
      && (!wanted.kind || kinds.includes(wanted.kind));
    row.hidden = !fits;
    count += fits;
  }
  form.querySelector('.count').textContent = `${count} of ${rows.length}`;
  const chosen = new URLSearchParams(choices(form).filter((field) => field.value).map((field) => [field.name, field.value]));
  const section = form.closest('section').id, hash = `#${section}` + (String(chosen) ? `?${chosen}` : '');
  for (const link of form.querySelectorAll('.permalink')) link.setAttribute('href', hash);
  return hash;
}

function filters() {
  for (const form of document.querySelectorAll('form.filters')) {
    form.addEventListener('submit', (event) => event.preventDefault());
    form.addEventListener('input', () => history.replaceState(null, '', apply(form)));
    apply(form);
  }
  for (const button of document.querySelectorAll('.copy')) {
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
