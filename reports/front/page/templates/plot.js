// One plot: curves over a range, linear or logarithmic, with a tube, a bound and marks.
const PLOT = {width: 460, height: 270, left: 74, right: 12, top: 10, bottom: 40};
let plots = 0;

function linearTicks(low, high) {
  const rough = (high - low) / 5 || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= rough);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(k * step);
  const digits = Math.max(0, -Math.floor(Math.log10(step)));
  const exponent = Math.max(Math.abs(low), Math.abs(high)) >= 1e5 || digits > 4;
  return found.map((at) => [at, exponent ? at.toExponential(1) : at.toFixed(digits)]);
}

function logTicks(low, high) {
  const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
  const every = Math.max(1, Math.ceil((last - first) / 6));
  const found = [];
  for (let k = first; k <= last; k += every) found.push([10 ** k, Math.abs(k) < 4 ? String(Number((10 ** k).toPrecision(1))) : `1e${k}`]);
  return found;
}

function axis(range, log, from, to) {
  const [low, high] = log ? range.map(Math.log10) : range;
  const span = high - low || 1;
  const of = log ? (v) => Math.log10(Math.max(v, 1e-300)) : (v) => v;
  return (v) => from + ((of(v) - low) / span) * (to - from);
}

const MARKER = {
  mujoco: (x, y) => svg('circle', {cx: x, cy: y, r: 3.2}),
  pymunk: (x, y) => svg('path', {d: `M${x} ${y - 4}l4 7h-8z`}),
  book: (x, y) => svg('path', {d: `M${x} ${y - 4.2}l4.2 4.2l-4.2 4.2l-4.2 -4.2z`}),
  other: (x, y) => svg('rect', {x: x - 3, y: y - 3, width: 6, height: 6}),
  mine0: (x, y) => svg('path', {d: `M${x - 1.3} ${y - 4}h2.6v2.7h2.7v2.6h-2.7v2.7h-2.6v-2.7h-2.7v-2.6h2.7z`}),
  mine1: (x, y) => svg('path', {d: `M${x} ${y - 1.8}l2.4 -2.4l1.8 1.8l-2.4 2.4l2.4 2.4l-1.8 1.8l-2.4 -2.4l-2.4 2.4l-1.8 -1.8l2.4 -2.4l-2.4 -2.4l1.8 -1.8z`}),
  mine2: (x, y) => svg('path', {d: `M${x} ${y - 5}l1.3 3.4l3.5 .2l-2.7 2.3l.9 3.5l-3 -1.9l-3 1.9l.9 -3.5l-2.7 -2.3l3.5 -.2z`}),
};
// Hollow as shipped, with a dot in it as recommended, full as tuned.
function marker(look, x, y) {
  const [kind, setting] = look.split(' '), shape = MARKER[kind](x, y);
  shape.setAttribute('class', ['shipped', 'recommended'].includes(setting) ? 'hollow' : 'marker');
  return setting === 'recommended' ? svg('g', {}, shape, svg('circle', {class: 'marker', cx: x, cy: y, r: .9})) : shape;
}

// curves: [{x, y, look, title, dots}]; tube: {x, low, high}; bound: y; until: x, what is later is not judged; marks: [{x, y, text}]
function plot({title, xLabel, yLabel, x, y, xLog = false, yLog = false, curves, tube, bound, marks = [], until = null}) {
  const {width, height, left, right, top, bottom} = PLOT;
  const at = axis(x, xLog, left, width - right), up = axis(y, yLog, height - bottom, top);
  const clip = `clip${plots++}`;
  const inside = {x: left, y: top, width: width - left - right, height: height - top - bottom};
  const limit = (v) => Math.min(Math.max(v, -1e4), 1e4).toFixed(1);
  const points = (xs, ys) => Array.from(xs, (v, k) => `${limit(at(v))},${limit(up(ys[k]))}`).join(' ');
  const root = svg('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': title},
    svg('clipPath', {id: clip}, svg('rect', inside)));
  for (const [v, text] of (xLog ? logTicks : linearTicks)(...x)) {
    root.append(svg('path', {class: 'grid', d: `M${at(v)} ${top}V${height - bottom}`}),
      svg('text', {class: 'tick', x: at(v), y: height - bottom + 15, 'text-anchor': 'middle'}, text));
  }
  for (const [v, text] of (yLog ? logTicks : linearTicks)(...y)) {
    root.append(svg('path', {class: 'grid', d: `M${left} ${up(v)}H${width - right}`}),
      svg('text', {class: 'tick', x: left - 6, y: up(v) + 4, 'text-anchor': 'end'}, text));
  }
  const drawn = svg('g', {'clip-path': `url(#${clip})`});
  if (tube) {
    const there = points(tube.x, tube.high), back = points(tube.x, tube.low).split(' ').reverse().join(' ');
    drawn.append(svg('polygon', {class: 'tube', points: `${there} ${back}`}));
  }
  if (bound !== undefined) {
    if (yLog) drawn.append(svg('rect', {class: 'tube', x: left, width: inside.width, y: up(bound), height: Math.max(0, height - bottom - up(bound))}));
    drawn.append(svg('path', {class: 'bound', d: `M${left} ${up(bound)}H${width - right}`}));
  }
  if (until) drawn.append(svg('rect', {class: 'later', x: at(until), width: Math.max(0, width - right - at(until)), y: top, height: inside.height}, svg('title', {}, 'not judged')));
  for (const [{x: xs, y: ys, look, title: name, dots = 5}, index] of curves.map((curve, k) => [curve, k])) {
    const line = svg('polyline', {class: `curve ${look}`, points: points(xs, ys)}, svg('title', {}, name));
    const every = Math.max(1, Math.floor(xs.length / dots));
    const shapes = [];
    for (let k = Math.floor(every * (index + .5) / curves.length); k < xs.length && look !== 'reference'; k += every) shapes.push(marker(look, at(xs[k]), up(ys[k])));
    drawn.append(svg('g', {class: look}, line, shapes));
  }
  for (const {x: mx, y: my, text} of marks) {
    const [px, py] = [at(mx), up(my)], end = px > width * .6;
    drawn.append(svg('circle', {class: 'largest', cx: px, cy: py, r: 6}),
      svg('text', {class: 'label', x: end ? px - 9 : px, y: py < top + 28 ? py + 21 : py - 11, 'text-anchor': end ? 'end' : 'start'}, text));
  }
  root.append(drawn, svg('rect', {class: 'axis', ...inside}),
    svg('text', {class: 'label', x: (left + width - right) / 2, y: height - 6, 'text-anchor': 'middle'}, xLabel),
    svg('text', {class: 'label', transform: `translate(13 ${(top + height - bottom) / 2}) rotate(-90)`, 'text-anchor': 'middle'}, yLabel));
  return root;
}

const least = (arrays) => arrays.reduce((m, a) => a.reduce((n, v) => Math.min(n, v), m), Infinity);
const most = (arrays) => arrays.reduce((m, a) => a.reduce((n, v) => Math.max(n, v), m), -Infinity);
