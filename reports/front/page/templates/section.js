// What a section holds below its motion: plots of one quantity, events, and all its numbers.
const NUMBER = /^(h ≤ )?[-−]?[\d.]+(e-?\d+)?( \S+)?$/; // with its unit: it stands on one line
function table(caption, head, rows) {
  const cell = (text, k) => html(k ? 'td' : 'th', {scope: k ? null : 'row', class: NUMBER.test(text) ? 'num' : null}, text instanceof Node ? text : plain(text));
  return html('div', {class: 'scroll'}, html('table', {class: 'rows'}, html('caption', {}, caption),
    html('thead', {}, html('tr', {}, ...head.map((text) => html('th', {scope: 'col'}, text)))),
    html('tbody', {}, ...rows.map((row) => html('tr', {}, ...row.map(cell))))));
}

const folded = (title, content) => {
  const box = html('details', {}, html('summary', {}, title));
  box.addEventListener('toggle', () => { if (box.open && box.children.length === 1) box.append(content()); });
  return box;
};

function orders(ladders, model) {
  const steps = [...ladders].sort((a, b) => a[0] - b[0]);
  if (model) return steps.length ? table('Order of the error in the step', ['setting', 'order', 'usable step [ms]'], steps.map(([column, , , , , order, , usable]) => [COLUMNS[column].title, short(order), usable === null ? '–' : `h ≤ ${milliseconds(usable)}`])) : null;
  const told = steps.map(([column, , ladder, , , order, limit, usable, verdict]) =>
    [COLUMNS[column].title, word(ladder), short(order), short(limit), usable === null ? '–' : `h ≤ ${milliseconds(usable)}`, word(verdict)]);
  return told.length ? table('Order of the error in the step, and what is left of it', ['setting', 'numbers', 'order', 'stays, however small the step', 'usable step [ms]', 'says'], told) : null;
}

function quantityFigures(motion, data, quantity) {
  const rows = data.rows.filter((row) => word(row[1]) === quantity);
  const ladders = data.ladders.filter((row) => word(row[1]) === quantity);
  const unit = rows.length ? word(rows[0][2]) : '', allow = (rows.find((row) => row[4]) || [])[4] || 1;
  const found = motion && motion.curves.quantities[quantity] ? curvesOf(motion, quantity) : null;
  const parts = [];
  if (found) {
    const keys = keyOf([{look: 'reference', title: `${found.against}, ± ${short(allow)} ${unit}`}, ...found.engines]);
    const late = found.until ? ` Later than ${few(found.until)} s, where it is grey, nothing is judged.` : '';
    parts.push(figure(`In its tolerance tube.${late}${leaving(unit, allow, found)}`, tubePlot(quantity, unit, allow, found)),
      figure(`Off the ${found.against}; the largest is marked, the shade is within.`, errorPlot(quantity, allow, found, rows)));
    const climbed = ladderPlot(quantity, allow, ladders);
    const says = found.against === 'reference' ? 'what falls is the step’s, what stays is the model’s. Thin: tuned numbers held as of the largest step.' : 'all of it is the step’s.';
    if (climbed) parts.push(figure(`Largest error by step: ${says}`, climbed));
    return {parts, keys, below: orders(ladders, found.against !== 'reference')};
  }
  const climbed = ladderPlot(quantity, allow, ladders);
  if (climbed) parts.push(figure('Largest error by step.', climbed));
  return {parts, keys: ladders.length ? keyOf(ladders.map((row) => COLUMNS[row[0]])) : null, below: orders(ladders)};
}

function worstFirst(data) {
  const worst = new Map();
  for (const row of data.rows) {
    const name = word(row[1]), size = typeof row[7] === 'number' ? row[7] : 0;
    if (name !== 'audit') worst.set(name, Math.max(worst.get(name) || 0, size));
  }
  return [...worst].sort((a, b) => b[1] - a[1]).map(([name]) => name);
}

function events(data) {
  const right = new Map(data.instants.filter((i) => i[0] === -1).map((i) => [`${i[1]} ${i[2]}`, i[3]]));
  const told = data.instants.filter((i) => i[0] >= 0).map(([column, event, k, time, difference]) =>
    [`${word(event)} ${k}`, COLUMNS[column].title, right.get(`${event} ${k}`) ?? 'not there', time, difference === null ? '–' : short(difference)]);
  return told.length || right.size ? table('When each event happens', ['event', 'setting', 'reference [s]', 'engine [s]', 'off by [s]'], told) : null;
}

// The shades of the heat map: blue within, orange beyond, hatched where it is declared.
const SHADES = [1e-3, 1e-2, 1e-1, 1, 10, 100, 1000];
function verdictLook(says, ratio) {
  const at = SHADES.findIndex((bound) => ratio <= bound), lost = typeof ratio !== 'number' && says !== 'agrees';
  return `s${lost || at < 0 ? 7 : at}` + (says === 'deviates' ? ' declared' : '');
}

function numbers(data) {
  const refused = new Map(), told = [];
  for (const [column, quantity, unit, step, allowed, largest, when, ratio, verdict, because] of data.rows) {
    const says = word(verdict);
    if (says === 'refused') {
      const key = `${COLUMNS[column].title}: ${[spoken(says), word(because)].filter(Boolean).join(': ')}`;
      refused.set(key, [...(refused.get(key) || []), word(quantity)]);
    } else told.push([COLUMNS[column].title, spoken(word(quantity)), milliseconds(step), `${few(allowed)} ${word(unit)}`, few(largest), few(when), ratio === null ? '' : short(ratio),
      html('span', {class: `chip ${verdictLook(says, ratio)}`}, spoken(says)), word(because)]);
  }
  return html('div', {}, told.length ? table('Every observed quantity', ['setting', 'quantity', 'step [ms]', 'allowed', 'largest error', 'at [s]', '× allowed', 'verdict', 'because'], told) : null,
    ...[...refused].map(([why, names]) => html('p', {class: 'note'}, `${why} (${names.map(spoken).join(', ')})`)));
}

const causes = (data) => table('The smallest changes that bring a row within', ['engine and setting', 'quantity', 'error', 'cured by', 'options', 'step [ms]', 'error then', 'cost, × its own', 'law'],
  data.causes.map((row) => row.map(word)).map(([engine, setting, quantity, before, cure, options, step, after, cost, law]) =>
    [`${engine} ${setting}`, quantity, few(before), cure, options === '{}' ? '' : options, milliseconds(step), few(after), few(cost), law]));
const checks = (data, held) => table(`What holds ${held}`, ['check', 'difference', 'bound', 'certified to', 'verdict'],
  data.checks.map(([check, difference, bound, certified, unit, verdict]) => [word(check), short(difference), short(bound), certified === null ? '' : `${short(certified)} ${word(unit)}`, word(verdict)]));

function build(section) {
  const body = section.querySelector('.body'), {name} = section.dataset, motion = MOTIONS[name];
  const model = section.dataset.against === 'limit';
  const data = ROWS.cases[name] || {rows: [], ladders: [], instants: [], checks: [], causes: []};
  const names = worstFirst(data), above = html('div', {}), below = html('div', {});
  const figures = html('div', {class: 'figures'}, motion ? animation(name, motion) : null);
  const fixed = figures.children.length;
  const choice = html('select', {}, ...names.map((one) => html('option', {}, one)));
  const show = (quantity) => {
    const {parts, keys, below: orders} = quantityFigures(motion, data, quantity);
    choice.value = quantity;
    figures.replaceChildren(...[...figures.children].slice(0, fixed), ...parts);
    above.replaceChildren(...[keys].filter(Boolean));
    below.replaceChildren(orders ? folded('Orders and limits', () => orders) : html('p', {class: 'note'}, 'Other step sizes were not tried.'));
  };
  choice.addEventListener('change', () => { show(choice.value); history.replaceState(null, '', `${addressOf(section.id)}/${encodeURIComponent(choice.value)}`); });
  section.show = (quantity) => { if (names.includes(quantity)) show(quantity); };
  const curves = motion || data.ladders.length;
  if (names.length && curves) {
    body.append(html('div', {class: 'controls'}, html('label', {}, 'quantity ', choice), html('span', {class: 'note'}, 'the worst first')), above);
    show(names[0]);
  }
  if (curves) body.append(figures, below);
  else if (!model) body.append(numbers(data)); // a claim about states: nothing moves, nothing steps
  const happened = events(data);
  if (data.causes.length) body.append(folded('Causes, found by experiment', () => causes(data)));
  if (happened) body.append(folded('Events', () => happened));
  if (curves) body.append(folded('All numbers', () => numbers(data)));
  if (!model || data.checks.length) body.append(folded(model ? 'What holds its equations and its limit' : 'How the reference is certified', () => checks(data, model ? 'its equations and its limit' : 'the reference')));
}
