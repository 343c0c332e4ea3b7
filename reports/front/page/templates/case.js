// The section of a case: built when it is opened, from its motion and its rows.
const CALM = matchMedia('(prefers-reduced-motion: reduce)');

// wanted: the ghosts that are shown at all; by default each, those of an engine by itself at once.
function animation(name, motion, wanted = null) {
  const pose = poser(motion), times = motion.times;
  const last = times[times.length - 1], [slow, long] = [3, 12];
  const rate = last / Math.min(Math.max(last, slow), long); // s of the motion in one second
  const root = svg('svg', {class: motion.axes === 3 ? 'mechanism space' : 'mechanism', viewBox: `0 0 ${CANVAS.width} ${CANVAS.height}`, role: 'img', 'aria-label': `${name} in motion`});
  const fixed = fittings(motion), own = bodies(motion, 'reference');
  const ghosts = Object.entries(motion.ghosts).filter(([key]) => !wanted || wanted.includes(key)).map(([key, ghost]) => ({
    ...COLUMN.get(key), ...bodies(motion, `ghost ${COLUMN.get(key).look}`), pose: poser(ghost), held: ghost.held,
  }));
  const trail = motion.trail, trace = svg('polyline', {class: 'trace'});
  root.append(fixed.group, trace, ...ghosts.map((g) => g.group), own.group);
  let window = null, now = 0, playing = false, before = null;
  const aim = (turn) => {
    window = frame(motion, camera(motion, turn), pose, times);
    if (trail) trace.setAttribute('points', path(Array.from(trail[0], (_, k) => window(trail.map((column) => column[k])))));
  };
  const play = html('button', {type: 'button', class: 'play'});
  const scrub = html('input', {type: 'range', min: 0, max: 1000, value: 0, 'aria-label': 'time'});
  const clock = html('output', {});
  const draw = () => {
    const poses = pose(now);
    fixed.show(poses, window);
    own.show(poses, window);
    for (const ghost of ghosts) if (ghost.group.style.display !== 'none') ghost.show(ghost.pose(now), window);
    scrub.value = String(Math.round(1000 * now / last));
    clock.textContent = `t = ${now.toFixed(2)} s`;
  };
  const tick = (stamp) => {
    if (!playing || !root.isConnected || !root.checkVisibility()) { before = null; return set(false); }
    if (before !== null) now = (now + rate * (stamp - before) / 1000) % last;
    before = stamp;
    const {top, bottom} = root.getBoundingClientRect();
    if (bottom > 0 && top < innerHeight) draw();
    requestAnimationFrame(tick);
  };
  function set(on) {
    const start = on && !playing;
    playing = on;
    play.textContent = on ? 'Pause' : 'Play';
    if (start) requestAnimationFrame(tick); else before = null;
  }
  play.addEventListener('click', () => set(!playing));
  scrub.addEventListener('input', () => { set(false); now = last * scrub.value / 1000; draw(); });
  const turner = motion.axes === 3 ? html('label', {}, 'turn ', html('input', {type: 'range', min: -180, max: 180, value: 35, 'aria-label': 'turn the view'})) : null;
  if (turner) turner.lastChild.addEventListener('input', () => { aim(Number(turner.lastChild.value)); draw(); });
  aim(35);
  draw();
  const keys = html('ul', {class: 'keys', 'aria-label': 'Ghosts'}, ...ghosts.map((ghost) => {
    const box = html('input', {type: 'checkbox'});
    box.checked = ghost.realised === 'native';
    const show = () => { ghost.group.style.display = box.checked ? '' : 'none'; draw(); };
    box.addEventListener('change', show);
    show();
    return html('li', {}, html('label', {}, box, swatch(ghost.look), ghost.title));
  }));
  set(!CALM.matches);
  const controls = html('div', {class: 'controls'}, play, scrub, clock, wanted ? null : turner);
  if (wanted) return [root, controls];
  const covered = motion.covered.map((key) => COLUMN.get(key).title).join(', ');
  const pace = rate >= .995 && rate <= 1.005 ? '' : ` Shown at ${short(rate)} of its speed.`;
  const held = ghosts.filter((ghost) => ghost.held).map((ghost) => ghost.title).join(', ');
  const behind = trail ? ' The line is the way of the place that is observed.' : '';
  return html('figure', {class: 'moving'}, root, controls, keys,
    html('figcaption', {}, `The ${motion.against} in ink.${behind}${pace}` + (covered ? ` Not to be told apart from it at this size: ${covered}.` : '') + (held ? ` Shown at their samples alone: ${held}.` : '')));
}

function swatch(look) {
  return svg('svg', {viewBox: '0 0 42 14', 'aria-hidden': 'true', class: look},
    svg('path', {class: `curve ${look}`, d: 'M1 7H41'}), look === 'reference' ? null : marker(look, 21, 7));
}

function keyOf(curves) {
  return html('ul', {class: 'keys'}, ...curves.map(({look, title}) => html('li', {}, html('label', {}, swatch(look), title))));
}

const figure = (caption, ...parts) => html('figure', {}, html('figcaption', {}, caption), ...parts);

// A quantity in its tube, and beside it what is off, in parts of what is allowed.
function curvesOf(motion, quantity, wanted = () => true) {
  const times = motion.curves.times, {reference: right, off} = motion.curves.quantities[quantity];
  const engines = Object.entries(off).filter(([key]) => wanted(COLUMN.get(key))).map(([key, found]) => {
    const error = found.curve, own = found.times ?? times;
    const values = found.values ?? error.map((e, k) => right[k] + e);
    return {...COLUMN.get(key), x: own, error, y: values};
  });
  const place = (one) => COLUMNS.findIndex(({key}) => key === one.key);
  return {times, right, until: motion.curves.until, against: motion.against, engines: engines.sort((a, b) => place(a) - place(b))};
}

// From where to where a tube's plot goes: not all the way with an engine that is lost.
function tubeRange(allow, {right, engines}) {
  const [bottom, top] = [least([right]) - allow, most([right]) + allow], room = (top - bottom) * .9;
  return [Math.max(bottom - room, least([[bottom], ...engines.map((e) => e.y)])), Math.min(top + room, most([[top], ...engines.map((e) => e.y)]))];
}

// What leaves that range, and how far off it is.
function leaving(unit, allow, found) {
  const [bottom, top] = tubeRange(allow, found);
  const told = found.engines.filter((e) => most([e.y]) > top || least([e.y]) < bottom)
    .map((e) => `${e.title} by up to ${short(most([e.error.map(Math.abs)]))} ${unit}`);
  return told.length ? ` Out of the picture: ${told.join(', ')}.` : '';
}

function tubePlot(quantity, unit, allow, found) {
  const {times, right, engines, until, against} = found, y = tubeRange(allow, found);
  const [low, high] = [right.map((v) => v - allow), right.map((v) => v + allow)];
  const pad = (y[1] - y[0]) * .04 || 1;
  return plot({title: `${quantity} over time`, xLabel: 't [s]', yLabel: `${quantity} [${unit}]`, x: [times[0], times[times.length - 1]],
    y: [y[0] - pad, y[1] + pad], tube: {x: times, low, high}, until,
    curves: [...engines, {x: times, y: right, look: 'reference', title: against}]});
}

function errorPlot(quantity, allow, {times, engines, until}, rows) {
  const parts = engines.map((e) => ({...e, y: e.error.map((v) => Math.abs(v) / allow)}));
  const top = Math.max(2, most(parts.map((e) => e.y))), worst = rows.filter((r) => r[6] !== null && typeof r[7] === 'number').sort((a, b) => b[7] - a[7])[0];
  const marks = worst && worst[7] > 0 ? [{x: worst[6], y: Math.max(worst[7], 1e-8), text: `${short(worst[7])} at ${short(worst[6])} s`}] : [];
  const low = Math.min(.1, Math.max(1e-8, least(parts.map((e) => [most([e.y])]).filter((m) => m[0] > 0)) / 100));
  return plot({title: `error of ${quantity}`, xLabel: 't [s]', yLabel: 'error / allowed', x: [times[0], times[times.length - 1]],
    y: [low, Math.max(top, marks.length ? marks[0].y : 0) * 3], yLog: true, bound: 1, curves: parts, marks, until});
}

function ladderPlot(quantity, allow, ladders) {
  const curves = ladders.map(([column, , ladder, steps, errors]) => {
    const kept = steps.map((h, k) => [1e3 * h, errors[k] / allow]).filter(([, e]) => e > 0 && isFinite(e));
    const one = COLUMNS[column], held = word(ladder) === 'held' && ladders.some((l) => l[0] === column && l[2] !== ladder);
    return {x: kept.map((p) => p[0]), y: kept.map((p) => p[1]), look: one.look + (held ? ' held' : ''), title: `${one.title}, ${word(ladder)}`, dots: 9};
  }).filter((c) => c.x.length > 1);
  if (!curves.length) return null;
  const x = [least(curves.map((c) => c.x)) / 1.3, most(curves.map((c) => c.x)) * 1.3];
  const y = [Math.min(.3, Math.max(1e-12, least(curves.map((c) => c.y)) / 3)), Math.max(3, most(curves.map((c) => c.y)) * 3)];
  return plot({title: `ladder of ${quantity}`, xLabel: 'step h [ms]', yLabel: 'error / allowed', x, y, xLog: true, yLog: true, bound: 1, curves});
}
