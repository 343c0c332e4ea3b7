// A mechanism that moves: the reference in ink, engines as ghosts. Nothing is simulated here.
const CANVAS = {width: 460, height: 300, pad: 22}, LOOKS = 60;

// Poses of one motion by part, at any time: cubics through its samples with their rates. What is
// held stays at a sample until the next, for nobody knows the way between them.
function poser({times, poses, held = false}) {
  const t = times, parts = Object.entries(poses);
  return (time) => {
    let [low, high] = [1, t.length - 1]; // the first sample that is not before it
    while (low < high) { const middle = (low + high) >> 1; if (t[middle] < time) low = middle + 1; else high = middle; }
    const k = low, h = t[k] - t[k - 1], s = h > 0 ? Math.min(Math.max((time - t[k - 1]) / h, 0), 1) : 1, r = 1 - s;
    if (held) return new Map(parts.map(([name, [pose]]) => [name, pose.map((c) => c[s < 1 ? k - 1 : k])]));
    const [a, b, u, v] = [(1 + 2 * s) * r * r, s * s * (3 - 2 * s), h * s * r * r, -h * s * s * r];
    return new Map(parts.map(([name, [pose, rates]]) => [name, pose.map((c, i) => a * c[k - 1] + b * c[k] + u * rates[i][k - 1] + v * rates[i][k])]));
  };
}

// The place in ground axes of a place on a part.
function placed(pose, place) {
  if (!pose) return place;
  if (place.length === 2) {
    const [x, y, angle = 0] = pose, c = Math.cos(angle), s = Math.sin(angle);
    return [x + c * place[0] - s * place[1], y + s * place[0] + c * place[1]];
  }
  const [x, y, z, w = 1, i = 0, j = 0, k = 0] = pose, n = w * w + i * i + j * j + k * k || 1;
  const [a, b, c] = place;
  const [p, q, r] = [2 * (j * c - k * b) / n, 2 * (k * a - i * c) / n, 2 * (i * b - j * a) / n];
  return [x + a + w * p + j * r - k * q, y + b + w * q + k * p - i * r, z + c + w * r + i * q - j * p];
}

// What is seen: the plane as it is; space from the side and above, as an engineer draws it.
function camera(motion, turn) {
  if (motion.axes === 2) return ([x, y]) => [x, -y];
  const [az, el] = [turn * Math.PI / 180, 20 * Math.PI / 180];
  const [sa, ca, se, ce] = [Math.sin(az), Math.cos(az), Math.sin(el), Math.cos(el)];
  return ([x, y, z]) => [-sa * x + ca * y, -(z * ce - (ca * x + sa * y) * se)];
}

// The window: all that the reference draws at any of its poses, and at as many times between them.
function frame(motion, look, pose, times) {
  const seen = [], last = times[times.length - 1];
  for (const time of [...times, ...Array.from({length: LOOKS}, (_, k) => last * k / LOOKS)]) {
    const now = pose(time);
    for (const [name, body] of Object.entries(motion.sketch.bodies)) {
      seen.push(look(now.get(name)), ...body.lines.flat().map((p) => look(placed(now.get(name), p))));
    }
    for (const link of motion.sketch.links) seen.push(...link.ends.map(([part, p]) => look(placed(now.get(part), p))));
  }
  seen.push(...motion.sketch.ground.map(look));
  const [xs, ys] = [seen.map((p) => p[0]), seen.map((p) => p[1])];
  const [x0, x1, y0, y1] = [least([xs]), most([xs]), least([ys]), most([ys])];
  const room = {width: CANVAS.width - 2 * CANVAS.pad, height: CANVAS.height - 2 * CANVAS.pad};
  const scale = Math.min(room.width / (x1 - x0 || 1e-9), room.height / (y1 - y0 || 1e-9), 300 / motion.size);
  const [cx, cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
  return (p) => {
    const [x, y] = look(p);
    return [CANVAS.width / 2 + scale * (x - cx), CANVAS.height / 2 + scale * (y - cy)];
  };
}

const at = ([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`;
const path = (points) => points.map(at).join(' ');

function zigzag([x0, y0], [x1, y1]) {
  const [dx, dy] = [x1 - x0, y1 - y0], length = Math.hypot(dx, dy) || 1, [nx, ny] = [-dy / length * 6, dx / length * 6];
  const found = [[x0, y0], [x0 + .12 * dx, y0 + .12 * dy]];
  for (let k = 0; k < 10; k++) {
    const s = .12 + .76 * (k + .5) / 10, side = k % 2 ? 1 : -1;
    found.push([x0 + s * dx + side * nx, y0 + s * dy + side * ny]);
  }
  return [...found, [x0 + .88 * dx, y0 + .88 * dy], [x1, y1]];
}

function piston([x0, y0], [x1, y1]) {
  const [dx, dy] = [x1 - x0, y1 - y0], length = Math.hypot(dx, dy) || 1, [nx, ny] = [-dy / length * 6, dx / length * 6];
  const p = (s, side) => [x0 + s * dx + side * nx, y0 + s * dy + side * ny];
  return [p(0, 0), p(.4, 0), p(.4, 1), p(.65, 1), p(.4, 1), p(.4, -1), p(.65, -1), p(.4, -1), p(.4, 0), p(.5, 0), p(.5, .7), p(.5, -.7), p(.5, 0), p(1, 0)];
}
const LINK = {spring: zigzag, damper: piston};

const closed = (line) => line.length > 2 && line[0].every((v, i) => v === line[line.length - 1][i]);

// The bodies of one motion: what is drawn of the reference and of each ghost.
function bodies(motion, kind) {
  const group = svg('g', {class: kind});
  const parts = Object.entries(motion.sketch.bodies).map(([name, body]) => ({
    name, body,
    lines: body.lines.map((line) => group.appendChild(svg('polyline', {class: closed(line) ? 'body closed' : 'body'}))),
    dot: body.dot ? group.appendChild(svg('circle', {class: 'dot', r: kind === 'reference' ? 5 : 6})) : null,
  }));
  const show = (now, window) => {
    for (const {name, body, lines, dot} of parts) {
      const pose = now.get(name);
      if (!pose) continue;
      lines.forEach((line, k) => line.setAttribute('points', path(body.lines[k].map((p) => window(placed(pose, p))))));
      if (dot) {
        const [x, y] = window(placed(pose, motion.axes === 2 ? [0, 0] : [0, 0, 0]));
        dot.setAttribute('cx', x.toFixed(1));
        dot.setAttribute('cy', y.toFixed(1));
      }
    }
  };
  return {group, show};
}

// What hangs between bodies and stands on the ground, moving with the reference.
function fittings(motion) {
  const group = svg('g', {}), {links, joints, blades, planes, ground} = motion.sketch;
  const add = (name, kind, extra = {}) => group.appendChild(svg(name, {class: kind, ...extra}));
  const size = motion.size * 2, drawn = [];
  const line = (kind, of) => { const shape = add('polyline', kind); drawn.push((now, window) => shape.setAttribute('points', path(of(now, window)))); };
  const end = (now, [part, place]) => placed(now.get(part), place);
  for (const plane of planes) {
    if (plane.floor) {
      const [place, u, w] = plane.floor, on = (s, t) => place.map((v, i) => v + (s * u[i] + t * w[i]) * size / 2);
      for (const k of [-1, -.5, 0, .5, 1]) {
        line('rail', (now, window) => [on(k, -1), on(k, 1)].map(window));
        line('rail', (now, window) => [on(-1, k), on(1, k)].map(window));
      }
    } else {
      const [[x, y], [u, w]] = [plane.at, plane.along];
      line('plane', (now, window) => [[x - 9 * size * u, y - 9 * size * w], [x + 9 * size * u, y + 9 * size * w]].map(window));
    }
  }
  for (const {rail} of joints) {
    if (!rail) continue;
    const [part, place, along] = rail;
    line('rail', (now, window) => [-1, 1].map((s) => window(placed(now.get(part), place.map((v, i) => v + s * size * along[i])))));
  }
  for (const link of links) {
    const shape = add('polyline', 'link');
    drawn.push((now, window) => {
      const places = link.ends.map((one) => end(now, one)), ends = places.map(window);
      const length = Math.hypot(...places[0].map((v, i) => v - places[places.length - 1][i]));
      const idle = link.only && (link.only === 'tension' ? length < link.rest : length > link.rest);
      shape.classList.toggle('idle', Boolean(idle));
      shape.setAttribute('points', path(ends.length === 2 && LINK[link.kind] ? LINK[link.kind](...ends) : ends));
    });
  }
  for (const {body, line: blade} of blades) line('body', (now, window) => blade.map((p) => window(placed(now.get(body), p))));
  for (const {at: place, rail} of joints) {
    if (rail) continue;
    const dot = add('circle', 'joint', {r: 3.4});
    drawn.push((now, window) => { const [x, y] = window(end(now, place)); dot.setAttribute('cx', x); dot.setAttribute('cy', y); });
  }
  for (const place of ground) {
    const mark = add('path', 'ground');
    drawn.push((now, window) => { const [x, y] = window(place); mark.setAttribute('d', `M${x} ${y}l-7 11h14z`); });
  }
  return {group, show: (now, window) => drawn.forEach((draw) => draw(now, window))};
}
