// The plan view: roads, routes, landmarks, vehicles with trails, and the distances at the trigger.

const TRAIL_S = 5;

const view = { k: 4, x: 0, y: 0, width: 0, height: 0, camera: 'fit', labels: [], places: [] };
const layers = {};

const toScreen = (x, y) => [(x - view.x) * view.k + view.width / 2, (view.y - y) * view.k + view.height / 2];
const pathOf = (points) => points.map((p, i) => `${i ? 'L' : 'M'}${p[0]} ${p[1]}`).join('');

function buildPlanView() {
  const stage = byId('stage');
  layers.world = draw('g');
  layers.roads = draw('g');
  layers.moving = draw('g');
  layers.ghosts = draw('g');
  layers.marks = draw('g');
  layers.labels = draw('g');
  layers.moment = draw('g');
  layers.scale = draw('g');
  layers.world.append(layers.roads, layers.marks, layers.ghosts, layers.moving);
  stage.append(draw('svg', { 'aria-hidden': 'true' }, layers.world, layers.labels, layers.scale, layers.moment));
  drawRoads();
  drawRoutes();
  drawVehicles();
  drawGhosts();
  bindCamera(stage);
  onResize(stage, (width, height) => {
    Object.assign(view, { width, height });
    if (view.camera === 'fit') fitRun();
    else placeCamera();
  });
  clock.follow(showMoment);
}

function drawRoads() {
  if (!run.map) return;
  const order = (lane) => (lane.inside ? 0 : 1);
  for (const lane of [...run.map.lanes].sort((a, b) => order(a) - order(b))) {
    const outline = `${pathOf([...lane.left, ...[...lane.right].reverse()])}Z`;
    layers.roads.append(draw('path', { class: `lane ${lane.kind}${lane.inside ? ' inside' : ''}`, d: outline }));
  }
  for (const lane of run.map.lanes.filter((each) => !each.inside)) {
    layers.roads.append(draw('path', { class: 'lane-edge', d: pathOf(lane.left) + pathOf(lane.right) }));
    layers.roads.append(draw('path', { class: 'lane-centre', d: pathOf(lane.centre) }));
  }
  for (const line of run.map.stop_lines) {
    layers.roads.append(draw('path', { class: 'stop-line under', d: pathOf(line) }), draw('path', { class: 'stop-line', d: pathOf(line) }));
  }
}

function drawRoutes() {
  for (const actor of run.actors) {
    if (actor.route.length) layers.marks.append(draw('path', { class: `route ${actor.tone}`, d: pathOf(actor.route) }));
    for (const mark of actor.landmarks) {
      if (mark.name === 'conflict_point' || !isSpokenOf(actor, mark.name)) continue;
      const [dx, dy] = [-Math.sin(mark.heading) * 1.3, Math.cos(mark.heading) * 1.3];
      const ends = [[mark.x - dx, mark.y - dy], [mark.x + dx, mark.y + dy]];
      layers.marks.append(draw('path', { class: `mark ${actor.tone}`, d: pathOf(ends) }));
    }
  }
  view.labels = groupedLandmarks();
}

/** Landmarks that the program speaks of; those at the same place share a label. */
function groupedLandmarks() {
  const spokenOf = ['conflict_point', 'stop_line', 'turn_start', 'turn_end', 'intersection'];
  const groups = [];
  for (const name of spokenOf) {
    for (const actor of run.actors) {
      const mark = actor.landmarks.find((each) => each.name === name);
      if (!mark || !(name === 'conflict_point' || isSpokenOf(actor, name))) continue;
      const near = groups.find((group) => Math.hypot(group.x - mark.x, group.y - mark.y) < 2);
      if (near) {
        if (!near.names.includes(name) && name !== 'intersection') near.names.push(name);
      } else {
        groups.push({ x: mark.x, y: mark.y, names: [name], conflict: name === 'conflict_point', tone: actor.tone });
      }
    }
  }
  return groups;
}

function vehicleShape(actor) {
  const { length: l, width: w } = actor;
  const box = draw('rect', { class: 'box', x: -l / 2, y: -w / 2, width: l, height: w, rx: w * 0.18 });
  const nose = draw('path', { class: 'nose', d: `M${l * 0.16} ${-w * 0.36}L${l * 0.34} 0L${l * 0.16} ${w * 0.36}Z` });
  return [box, nose];
}

const poseTransform = (state) => `translate(${state.x} ${state.y}) rotate(${(state.heading * 180) / Math.PI})`;

function drawVehicles() {
  for (const actor of run.actors) {
    actor.trails = Array.from({ length: TRAIL_S }, (_, age) => draw('path', { class: `trail ${actor.tone}`, opacity: 0.75 - age * 0.14 }));
    layers.moving.append(...actor.trails);
  }
  for (const actor of run.actors) {
    actor.body = draw('g', { class: `vehicle ${actor.tone}`, 'data-actor': actor.name }, ...vehicleShape(actor));
    layers.moving.append(actor.body);
    actor.tag = labelPill(actor.tone);
    layers.moment.append(actor.tag.group);
  }
}

/** A text on a rounded ground, moved and re-worded as needed. */
function labelPill(tone, className = 'label own') {
  const ground = draw('rect', { class: `pill own ${tone}`, rx: 3, height: 17 });
  const text = draw('text', { class: className, x: 5, y: 12.5 });
  const group = draw('g', { class: tone }, ground, text);
  return {
    group,
    width: 0,
    say(words) {
      if (text.textContent === words) return;
      text.textContent = words;
      this.width = text.getComputedTextLength() + 10;
      ground.setAttribute('width', this.width);
    },
    /** Beside a point, `away` pixels off: below or above a line that runs across, right or left of one that runs up. */
    place(x, y, upright, away) {
      group.classList.toggle('off', x < 0 || y < 0 || x > view.width || y > view.height);
      const left = upright ? x + (away > 0 ? away : away - this.width) : x - this.width / 2;
      const top = upright ? y - 8.5 : y + (away > 0 ? away : away - 17);
      this.at = [clamp(left, 2, view.width - this.width - 2), clamp(top, 2, view.height - 19)];
      group.setAttribute('transform', `translate(${this.at[0]} ${this.at[1]})`);
    },
  };
}

/** The cars as they stood at each trigger, with the distances that define it. */
function drawGhosts() {
  const measured = new Set(); // what triggers of one moment share is measured once
  for (const trigger of run.triggers) {
    trigger.group = draw('g', { class: 'ghosts' });
    trigger.pills = [];
    const stood = new Map(run.actors.map((actor) => [actor.name, stateAt(actor, trigger.time_s)]));
    for (const actor of run.actors) {
      if (actor.name !== trigger.hero && !trigger.measures.some((m) => m.actor === actor.name || m.target === actor.name)) continue;
      const shape = draw('g', { class: `ghost ${actor.tone}`, transform: poseTransform(stood.get(actor.name)) }, ...vehicleShape(actor));
      trigger.group.append(shape);
    }
    for (const measure of trigger.measures) {
      const key = `${fixed(trigger.time_s, 2)} ${JSON.stringify(measure)}`;
      if (!measured.has(key)) addMeasure(trigger, measure, stood);
      measured.add(key);
    }
    layers.ghosts.append(trigger.group);
  }
}

function addMeasure(trigger, measure, stood) {
  const actor = actorNamed(measure.actor);
  const from = stood.get(measure.actor);
  if (!actor || !from) return;
  let line;
  let words;
  if (measure.kind === 'gap') {
    const to = stood.get(measure.target);
    if (!to) return;
    line = [[from.x, from.y], [to.x, to.y]];
    words = `${fixed(Math.hypot(to.x - from.x, to.y - from.y), 2)} m`;
  } else {
    const distance = measure.s_m - from.s;
    line = stretchOf(actor, from.s, measure.s_m);
    words = `${fixed(distance, 2)} m to ${spoken(measure.name)}`;
    if (measure.kind === 'tta') words = `${fixed(distance / from.v, 2)} s, ${words}`;
  }
  if (line.length < 2) return;
  trigger.group.append(draw('path', { class: 'measure-halo', d: pathOf(line) }), draw('path', { class: `measure ${actor.tone}`, d: pathOf(line) }));
  const pill = labelPill(actor.tone, 'label own number');
  layers.moment.append(pill.group);
  trigger.pills.push({ pill, words, line });
}

/** Points along an actor's route between two arc lengths. */
function stretchOf(actor, start, end) {
  const [low, high] = start < end ? [start, end] : [end, start];
  const at = (s) => {
    const i = clamp(indexAt(actor.route.map((p) => p[2]), s), 0, actor.route.length - 2);
    const [p, q] = [actor.route[i], actor.route[i + 1]];
    const share = (s - p[2]) / (q[2] - p[2] || 1);
    return [p[0] + (q[0] - p[0]) * share, p[1] + (q[1] - p[1]) * share];
  };
  if (actor.route.length < 2) return [];
  return [at(low), ...actor.route.filter((p) => p[2] > low && p[2] < high), at(high)];
}

function showMoment(time) {
  for (const actor of run.actors) {
    const state = stateAt(actor, time);
    const known = state.x !== null && state.y !== null;
    actor.body.toggleAttribute('hidden', !known);
    if (!known) continue;
    actor.body.setAttribute('transform', poseTransform(state));
    actor.trails.forEach((trail, age) => trail.setAttribute('d', trailOf(actor, time - age - 1, time - age)));
    if (view.camera === `follow:${actor.name}`) Object.assign(view, { x: state.x, y: state.y });
  }
  if (view.camera.startsWith('follow:')) placeCamera();
  showTags(time);
}

function trailOf(actor, from, to) {
  if (to <= FIRST) return '';
  const points = [];
  for (let k = 0; k <= 8; k += 1) {
    const t = from + ((to - from) * k) / 8;
    if (t < FIRST) continue;
    const state = stateAt(actor, t);
    if (state.x !== null && state.y !== null) points.push([state.x, state.y]);
  }
  return pathOf(points);
}

function showTags(time) {
  if (!view.width) return;
  const taken = [...view.places];
  for (const trigger of run.triggers) {
    const since = time - trigger.time_s;
    for (const part of [trigger.group, ...trigger.pills.map(({ pill }) => pill.group)]) {
      part.toggleAttribute('hidden', since < -0.011);
      part.classList.toggle('faded', since > 1.5);
    }
    if (since >= -0.011) taken.push(...trigger.pills.map(({ pill }) => [...pill.at, pill.width, 17]));
  }
  for (const actor of run.actors) {
    const state = stateAt(actor, time);
    if (state.x === null || state.y === null) continue;
    const upright = Math.abs(Math.sin(state.heading)) > 0.7;
    const near = actor.width * 0.5 * view.k + 9;
    actor.tag.say(`${actor.name} ${fixed(state.v, 1)} m/s`);
    placeClear(actor.tag, toScreen(state.x, state.y), upright, upright ? near : -near, taken);
  }
}

/** Put a pill beside a point, as much further off as it takes to hide nothing that has its place, and take its own. */
function placeClear(pill, [x, y], upright, away, taken) {
  for (const level of [0, 1, 2, 3]) {
    pill.place(x, y, upright, away + Math.sign(away) * level * (upright ? 60 : 19));
    const [left, top] = pill.at;
    if (taken.every(([tx, ty, tw, th]) => left > tx + tw || left + pill.width < tx || top > ty + th || top + 17 < ty)) break;
  }
  taken.push([...pill.at, pill.width, 17]);
}

/** Measures stay where they are for a camera: across from the vehicles' tags. */
function placeMeasures() {
  const taken = [];
  for (const { pill, words, line } of run.triggers.flatMap((trigger) => trigger.pills)) {
    const middle = middleOf(line);
    const [from, to] = [line[0], line[line.length - 1]];
    const upright = Math.abs(to[1] - from[1]) > Math.abs(to[0] - from[0]);
    pill.say(words);
    placeClear(pill, toScreen(middle[0], middle[1]), upright, (upright ? -1 : 1) * (view.k + 9), taken);
  }
}

function middleOf(line) {
  const lengths = line.slice(1).map((p, i) => Math.hypot(p[0] - line[i][0], p[1] - line[i][1]));
  let rest = lengths.reduce((sum, length) => sum + length, 0) / 2;
  for (let i = 0; i < lengths.length; i += 1) {
    if (rest <= lengths[i] && lengths[i] > 0) {
      const share = rest / lengths[i];
      return [line[i][0] + (line[i + 1][0] - line[i][0]) * share, line[i][1] + (line[i + 1][1] - line[i][1]) * share];
    }
    rest -= lengths[i];
  }
  return line[0];
}

// --- camera ---------------------------------------------------------------------------------------------------------

function fitRun() {
  const xs = run.actors.flatMap((actor) => actor.x).filter(isNumber);
  const ys = run.actors.flatMap((actor) => actor.y).filter(isNumber);
  const [left, right] = [Math.min(...xs), Math.max(...xs)];
  const [low, high] = [Math.min(...ys), Math.max(...ys)];
  view.camera = 'fit';
  view.k = clamp(Math.min(view.width / (right - left + 24), view.height / (high - low + 26)), 0.2, 30);
  Object.assign(view, { x: (left + right) / 2, y: (low + high) / 2 });
  placeCamera();
}

function placeCamera() {
  const { k, x, y, width, height } = view;
  layers.world.setAttribute('transform', `matrix(${k} 0 0 ${-k} ${width / 2 - x * k} ${height / 2 + y * k})`);
  byId('camera').value = view.camera;
  placeMeasures();
  placeLabels();
  drawScale();
  showTags(clock.time);
}

/** Put each landmark's label beside its place: the first of eight sides where it hides nothing. */
function placeLabels() {
  layers.labels.replaceChildren();
  view.places = [];
  const taken = view.labels.map((group) => {
    const [x, y] = toScreen(group.x, group.y);
    return [x - 6, y - 6, 12, 12];
  });
  for (const { pill } of run.triggers.flatMap((trigger) => trigger.pills)) taken.push([...pill.at, pill.width, 17]);
  for (const group of view.labels) {
    const [x, y] = toScreen(group.x, group.y);
    if (x < 0 || y < 0 || x > view.width || y > view.height) continue;
    if (group.conflict) layers.labels.append(draw('path', { class: 'conflict', d: `M${x - 6} ${y}L${x} ${y - 6}L${x + 6} ${y}L${x} ${y + 6}Z` }));
    const words = group.names.map(spoken).join(', ');
    const text = draw('text', { class: 'label', text: words });
    layers.labels.append(text);
    const [w, h] = [text.getComputedTextLength() + 8, 16];
    const place = freePlace(x, y, w, h, taken);
    taken.push(place);
    view.places.push(place);
    const [px, py] = place;
    const anchor = [clamp(x, px, px + w), clamp(y, py, py + h)];
    text.before(draw('path', { class: 'leader', d: pathOf([[x, y], anchor]) }), draw('rect', { class: 'pill', x: px, y: py, width: w, height: h, rx: 2 }));
    text.setAttribute('x', px + 4);
    text.setAttribute('y', py + 12);
  }
}

function freePlace(x, y, w, h, taken) {
  for (const far of [26, 44, 66, 92]) {
    for (const [dx, dy] of [[-1, -1], [1, -1], [-1, 1], [1, 1], [0, -1], [0, 1], [1, 0], [-1, 0]]) {
      const px = x + dx * far - (dx < 0 ? w : dx === 0 ? w / 2 : 0);
      const py = y + dy * far * 0.8 - h / 2;
      const inside = px > 2 && py > 2 && px + w < view.width - 2 && py + h < view.height - 2;
      const clear = taken.every(([tx, ty, tw, th]) => px > tx + tw + 3 || px + w + 3 < tx || py > ty + th + 3 || py + h + 3 < ty);
      if (inside && clear) return [px, py, w, h];
    }
  }
  return [x + 10, y - h / 2, w, h];
}

function drawScale() {
  const metres = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((length) => length * view.k > 56) ?? 1000;
  const [x, y] = [12, view.height - 14];
  layers.scale.replaceChildren(
    draw('rect', { class: 'pill', x: x - 5, y: y - 20, width: metres * view.k + 10, height: 28, rx: 3 }),
    draw('path', { class: 'scale', d: `M${x} ${y - 4}v4h${metres * view.k}v-4` }),
    draw('text', { class: 'label', x: x + 2, y: y - 7, text: `${metres} m` }),
  );
}

function zoomBy(factor, px = view.width / 2, py = view.height / 2) {
  const k = clamp(view.k * factor, 0.2, 60);
  if (!view.camera.startsWith('follow:')) {
    view.camera = 'free';
    view.x += (px - view.width / 2) * (1 / view.k - 1 / k);
    view.y -= (py - view.height / 2) * (1 / view.k - 1 / k);
  }
  view.k = k;
  placeCamera();
}

function setCamera(name) {
  if (name === 'fit') return fitRun();
  view.camera = name;
  if (name.startsWith('follow:')) view.k = Math.max(view.k, 7);
  placeCamera();
  return clock.seek(clock.time);
}

function bindCamera(stage) {
  const choices = [['fit', 'whole run'], ...run.actors.map((actor) => [`follow:${actor.name}`, `follow ${actor.name}`]), ['free', 'free']];
  byId('camera').append(...choices.map(([value, text]) => make('option', { value, text })));
  byId('camera').addEventListener('change', (event) => setCamera(event.target.value));
  byId('fit').addEventListener('click', fitRun);
  byId('zoom-in').addEventListener('click', () => zoomBy(1.4));
  byId('zoom-out').addEventListener('click', () => zoomBy(1 / 1.4));
  stage.addEventListener('wheel', (event) => {
    event.preventDefault();
    const box = stage.getBoundingClientRect();
    zoomBy(Math.exp(-clamp(event.deltaY, -200, 200) * 0.0016), event.clientX - box.left, event.clientY - box.top);
  }, { passive: false });
  stage.addEventListener('pointerdown', (event) => {
    stage.setPointerCapture(event.pointerId);
    stage.classList.add('dragging');
  });
  stage.addEventListener('pointermove', (event) => {
    if (!stage.classList.contains('dragging')) return;
    view.camera = 'free';
    view.x -= event.movementX / view.k;
    view.y += event.movementY / view.k;
    placeCamera();
  });
  for (const name of ['pointerup', 'pointercancel']) stage.addEventListener(name, () => stage.classList.remove('dragging'));
}
