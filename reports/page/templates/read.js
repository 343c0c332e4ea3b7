'use strict';
// The data of the page, and what everything below is built with. Text is only ever set as text.
const LETTERS = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_';
const LEVEL = new Map([...LETTERS].map((letter, k) => [letter, k]));
const MOTIONS = JSON.parse(document.getElementById('motions').textContent);
const ROWS = JSON.parse(document.getElementById('rows').textContent);
const COLUMNS = ROWS.columns.map((key) => {
  const [engine, setting, realised] = key.split('.');
  const own = ['mujoco', 'pymunk', 'book'].includes(engine) ? engine : 'own';
  return {key, engine, setting, realised, look: `${own} ${setting} ${realised}`,
    title: `${engine} ${setting}` + (realised === 'native' ? '' : ` + ${realised}`)};
});
const COLUMN = new Map(COLUMNS.map((one) => [one.key, one]));

function unpack([low, step, letters]) {
  const found = new Float64Array(letters.length / 2);
  for (let k = 0; k < found.length; k++) {
    found[k] = low + step * (64 * LEVEL.get(letters[2 * k]) + LEVEL.get(letters[2 * k + 1]));
  }
  return found;
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
const word = (k) => ROWS.words[k];
const plain = (number) => (number === null ? '' : String(number));
