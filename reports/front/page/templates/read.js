'use strict';
// The data of the page, and what everything below is built with. Text is only ever set as text.
let MOTIONS, ROWS, COLUMNS, COLUMN;

async function data(id) {
  const packed = Uint8Array.from(atob(document.getElementById(id).textContent), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).json();
}

async function read() {
  [MOTIONS, ROWS] = await Promise.all([data('motions'), data('rows')]);
  for (const named of [MOTIONS, ROWS.cases]) Object.setPrototypeOf(named, null); // a file may be called constructor
  const own = [...new Set(ROWS.columns.filter((key) => mine(...key.split('.'))).map((key) => key.split('.').slice(0, 2).join('.')))].sort();
  COLUMN = new Map([...ROWS.columns, ...ROWS.work.flatMap((panel) => Object.keys(panel.curves))].map((key) => [key, columnOf(key, own)]));
  COLUMNS = ROWS.columns.map((key) => COLUMN.get(key));
}

// A person's own settings have colours, dashes and markers of their own; no name of one is a class.
const mine = (engine, setting) => engine !== 'book' && !['shipped', 'recommended', 'tuned'].includes(setting);
function columnOf(key, own) {
  const [engine, setting, realised] = key.split('.'), way = realised === 'any way' ? 'law' : realised;
  const place = own.indexOf(`${engine}.${setting}`) % 3;
  const whose = ['mujoco', 'pymunk', 'book'].includes(engine) ? engine : 'other';
  return {key, engine, setting, realised, look: mine(engine, setting) ? `mine${place} mine ${way}` : `${whose} ${setting} ${way}`,
    title: `${engine} ${setting}` + (realised === 'native' ? '' : ` + ${realised === 'any way' ? 'our force law or loop' : spoken(realised)}`)};
}

function made(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value);
  }
  for (const child of children.flat()) if (child !== null) element.append(child);
  return element;
}
const html = (name, attributes = {}, ...children) => made(document.createElement(name), attributes, children);
const svg = (name, attributes = {}, ...children) =>
  made(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);

// 470, 2.3, 0.02, 3e-7: two digits, as a person says it
function short(number) {
  if (number === null) return '–';
  if (typeof number === 'string') return number;
  if (number === 0) return '0';
  const size = Math.abs(number);
  if (size >= 1e4 || size < 1e-3) return number.toExponential(1).replace('.0e', 'e').replace('e+', 'e');
  return size >= 100 ? number.toFixed(0) : String(Number(number.toPrecision(2)));
}
// The same with three digits, for a table; what is no number stays as it is.
function few(number) {
  if (number === null || number === '') return '';
  const size = Math.abs(Number(number));
  if (!isFinite(size)) return String(number);
  const digits = Number(Number(number).toPrecision(3));
  return size !== 0 && (size >= 1e5 || size < 1e-3) ? digits.toExponential().replace('e+', 'e') : String(digits);
}
const milliseconds = (step) => (step === null || step === '' ? '' : few(1e3 * step));
const word = (k) => ROWS.words[k];
const spoken = (text) => ROWS.spoken[text] ?? text; // a table's word as it is said
const addressOf = (id) => `#${encodeURIComponent(id)}`; // a file may have any name
const plain = (number) => (number === null ? '' : String(number));
