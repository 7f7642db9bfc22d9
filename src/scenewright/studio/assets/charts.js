// Position, speed and acceleration over time: what happened, what was planned, knots, the trigger, limits.

const CHARTS = [
  { key: 's', title: 'position s', unit: 'm', digits: 2 },
  { key: 'v', title: 'speed v', unit: 'm/s', digits: 2 },
  { key: 'a', title: 'acceleration a', unit: 'm/s²', digits: 2 },
];
const LEFT = 42;
const RIGHT = 12;
const KNOT_BAND = 46;
const charts = [];
const motion = { hover: null, reference: 'start' };

const commonMark = (name) => run.actors.every((actor) => actor.landmarks.some((mark) => mark.name === name));
const zeroOf = (actor) => (motion.reference === 'start' ? 0 : actor.landmarks.find((mark) => mark.name === motion.reference).s);
const shownValueOf = (actor, key, value) => (key === 's' && value !== null ? value - zeroOf(actor) : value);

function buildCharts() {
  buildReference();
  byId('legend').append(
    ...run.actors.map((actor) => make('span', { class: actor.tone }, make('i'), actor.name)),
    run.actors.some((actor) => actor.plan.length) ? make('span', { class: 'plan' }, make('i'), 'first plan') : null,
  );
  CHARTS.forEach((spec, index) => {
    const holder = make('div', { class: index ? 'chart' : 'chart first', role: 'img', 'aria-label': `${spec.title} in ${spec.unit} over time` });
    byId('charts').append(holder);
    const svg = draw('svg', { 'aria-hidden': 'true' });
    holder.append(svg);
    const chart = { ...spec, svg, top: index ? 20 : KNOT_BAND, bottom: index === CHARTS.length - 1 ? 22 : 8 };
    charts.push(chart);
    bindHover(holder);
    onResize(holder, (width, height) => {
      Object.assign(chart, { width, height });
      paintChart(chart);
    });
  });
  clock.follow(moveCursors);
}

function buildReference() {
  const choices = [['start', 'route start'], ...['conflict_point', 'stop_line', 'intersection'].filter(commonMark).map((name) => [name, spoken(name)])];
  const select = byId('reference');
  select.append(...choices.map(([value, text]) => make('option', { value, text })));
  motion.reference = choices.length > 1 && choices[1][0] === 'conflict_point' ? 'conflict_point' : 'start';
  select.value = motion.reference;
  byId('reference-tools').hidden = choices.length < 2;
  select.addEventListener('change', () => {
    motion.reference = select.value;
    paintChart(charts[0]);
    moveCursors(clock.time);
  });
}

const timeToX = (chart, time) => LEFT + ((time - FIRST) / (LAST - FIRST || 1)) * (chart.width - LEFT - RIGHT);
const xToTime = (width, x) => clamp(FIRST + ((x - LEFT) / (width - LEFT - RIGHT)) * (LAST - FIRST), FIRST, LAST);

/** The first plan as points: in each piece the acceleration changes evenly. */
function plannedPoints(actor, key) {
  const points = [];
  for (const [start, duration, s, v, accel, jerk] of actor.plan) {
    if ([start, duration, s, v].some((value) => value === null)) continue;
    const [a, j] = [accel ?? 0, jerk ?? 0];
    const steps = { s: 16, v: 8, a: 1 }[key];
    for (let i = 0; i <= steps; i += 1) {
      const t = (duration * i) / steps;
      const value = { s: s + v * t + (a * t * t) / 2 + (j * t * t * t) / 6, v: v + a * t + (j * t * t) / 2, a: a + j * t }[key];
      if (start + t <= LAST) points.push([start + t, shownValueOf(actor, key, value)]);
    }
  }
  return points;
}

function rangeOf(chart) {
  const values = run.actors.flatMap((actor) => [
    ...actor[chart.key].filter(isNumber).map((value) => shownValueOf(actor, chart.key, value)),
    ...plannedPoints(actor, chart.key).map((point) => point[1]),
    ...(chart.key === 'a' ? [actor.limits.accel_min_mpss, actor.limits.accel_max_mpss].filter(isNumber) : []),
  ]);
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (low > high) [low, high] = [0, 1];
  if (chart.key !== 's') [low, high] = [Math.min(low, 0), Math.max(high, 0)];
  const air = Math.max((high - low) * 0.08, 0.25);
  return [low - air, high + air];
}

function paintChart(chart) {
  if (!chart.width) return;
  [chart.low, chart.high] = rangeOf(chart);
  chart.y = (value) => chart.height - chart.bottom - ((value - chart.low) / (chart.high - chart.low)) * (chart.height - chart.top - chart.bottom);
  chart.svg.replaceChildren();
  paintGrid(chart);
  if (chart.key === 'a') paintLimits(chart);
  if (chart.key === 's') paintPlaces(chart);
  paintKnots(chart);
  for (const actor of run.actors) {
    const planned = plannedPoints(actor, chart.key).map(([t, value]) => [timeToX(chart, t).toFixed(1), chart.y(value).toFixed(1)]);
    if (planned.length) chart.svg.append(draw('path', { class: `planned ${actor.tone}`, d: pathOf(planned) }));
  }
  for (const actor of run.actors) chart.svg.append(draw('path', { class: `curve ${actor.tone}`, d: curveOf(chart, actor) }));
  paintTitle(chart);
  addCursor(chart);
}

function curveOf(chart, actor) {
  let path = '';
  let pen = 'M';
  actor[chart.key].forEach((value, i) => {
    if (value === null) {
      pen = 'M';
      return;
    }
    path += `${pen}${timeToX(chart, times[i]).toFixed(1)} ${chart.y(shownValueOf(actor, chart.key, value)).toFixed(1)}`;
    pen = 'L';
  });
  return path;
}

function paintGrid(chart) {
  const { ticks, step } = niceTicks(chart.low, chart.high, (chart.height - chart.top - chart.bottom) / 20);
  for (const value of ticks) {
    const y = chart.y(value);
    chart.svg.append(
      draw('line', { class: Math.abs(value) < step / 100 ? 'grid zero' : 'grid', x1: LEFT, x2: chart.width - RIGHT, y1: y, y2: y }),
      draw('text', { class: 'axis-number', x: LEFT - 5, y: y + 3.5, 'text-anchor': 'end', text: fixed(value, decimalsOf(step)) }),
    );
  }
  const along = niceTicks(FIRST, LAST, (chart.width - LEFT - RIGHT) / 60);
  for (const time of along.ticks) {
    const x = timeToX(chart, time);
    chart.svg.append(draw('line', { class: 'grid', x1: x, x2: x, y1: chart.top, y2: chart.height - chart.bottom }));
    if (chart.bottom > 10) {
      const words = `${fixed(time, decimalsOf(along.step))}${time === along.ticks[along.ticks.length - 1] ? ' s' : ''}`;
      chart.svg.append(draw('text', { class: 'axis-number', x, y: chart.height - 7, 'text-anchor': 'middle', text: words }));
    }
  }
}

function paintTitle(chart) {
  const from = chart.key === 's' && motion.reference !== 'start' ? ` from ${spoken(motion.reference)}` : '';
  if (chart.names) chart.svg.append(chart.names);
  chart.svg.append(draw('text', { class: 'chart-title', x: 6, y: 13, text: `${chart.title}${from}, ${chart.unit}` }));
}

function paintLimits(chart) {
  const limited = run.actors.filter((actor) => isNumber(actor.limits.accel_min_mpss) && isNumber(actor.limits.accel_max_mpss));
  if (!limited.length) return;
  const lowest = chart.y(Math.min(...limited.map((actor) => actor.limits.accel_min_mpss)));
  const highest = chart.y(Math.max(...limited.map((actor) => actor.limits.accel_max_mpss)));
  const width = chart.width - LEFT - RIGHT;
  chart.svg.append(
    draw('rect', { class: 'beyond', x: LEFT, y: chart.top, width, height: Math.max(0, highest - chart.top) }),
    draw('rect', { class: 'beyond', x: LEFT, y: lowest, width, height: Math.max(0, chart.height - chart.bottom - lowest) }),
  );
  for (const actor of limited) {
    for (const limit of [actor.limits.accel_min_mpss, actor.limits.accel_max_mpss]) {
      const y = chart.y(limit);
      chart.svg.append(draw('line', { class: `limit ${actor.tone}`, x1: LEFT, x2: chart.width - RIGHT, y1: y, y2: y }));
    }
  }
}

/** Stop line and conflict point of each route as level lines, named at the right where there is room. */
function paintPlaces(chart) {
  const used = [];
  chart.names = draw('g');
  for (const actor of run.actors) {
    for (const mark of actor.landmarks.filter((each) => each.name !== 'intersection' && isSpokenOf(actor, each.name))) {
      const y = chart.y(mark.s - zeroOf(actor));
      if (y < chart.top || y > chart.height - chart.bottom || used.some((other) => Math.abs(other - y) < 3)) continue;
      chart.svg.append(draw('line', { class: `place ${actor.tone}`, x1: LEFT, x2: chart.width - RIGHT, y1: y, y2: y }));
      if (used.every((other) => Math.abs(other - y) >= 13)) {
        const beside = y - 13 < chart.top ? y + 11 : y - 3; // above the chart moments have their names
        chart.names.append(draw('text', { class: 'knot-name', x: chart.width - RIGHT - 3, y: beside, 'text-anchor': 'end', text: spoken(mark.name) }));
      }
      used.push(y);
    }
  }
}

/** Moments of all actors of which something is said; those told alike share a label, and the trigger's is marked. */
function knotGroups() {
  const groups = [];
  for (const actor of run.actors) {
    for (const [, time, name] of actor.knots) {
      if (!name || time < FIRST || time > LAST) continue;
      const same = groups.find((group) => group.name === name && Math.abs(group.time - time) < 0.03);
      if (same) same.actors.push(actor);
      else groups.push({ name, time, actors: [actor] });
    }
  }
  for (const group of groups) group.trigger = run.triggers.some((trigger) => Math.abs(trigger.time_s - group.time) < 0.03);
  for (const trigger of run.triggers) {
    if (!groups.some((group) => Math.abs(trigger.time_s - group.time) < 0.03)) groups.push({ name: '', time: trigger.time_s, actors: [], trigger: true });
  }
  return groups.sort((a, b) => a.time - b.time);
}

function paintKnots(chart) {
  const rows = [-Infinity, -Infinity];
  const lines = draw('g');
  chart.svg.append(lines);
  for (const group of knotGroups()) {
    const x = timeToX(chart, group.time);
    const tone = group.trigger ? 'trigger' : group.actors.length === 1 ? `own ${group.actors[0].tone}` : '';
    lines.append(draw('line', { class: `knot ${group.trigger ? 'trigger' : ''}`, x1: x, x2: x, y1: chart.top, y2: chart.height - chart.bottom }));
    if (chart.key !== 's') continue;
    const text = draw('text', { class: `knot-name ${tone}`, text: group.trigger ? `▼ ${group.name || 'trigger'}` : group.name });
    chart.svg.append(text);
    const width = text.getComputedTextLength();
    const left = clamp(x - width / 2, LEFT - 14, chart.width - width - 2);
    const row = rows.findIndex((end) => end + 5 < left);
    if (row < 0) {
      text.remove();
      continue;
    }
    rows[row] = left + width;
    text.setAttribute('x', left);
    text.setAttribute('y', chart.top - 4 - row * 12);
  }
}

// --- cursor and hover -----------------------------------------------------------------------------------------------

function addCursor(chart) {
  chart.cursor = draw('line', { class: 'cursor', y1: chart.top, y2: chart.height - chart.bottom });
  chart.pointer = draw('line', { class: 'hover', y1: chart.top, y2: chart.height - chart.bottom });
  chart.dots = run.actors.map((actor) => draw('circle', { class: `dot ${actor.tone}`, r: 3.2 }));
  chart.values = run.actors.map((actor) => draw('text', { class: `value ${actor.tone}`, 'text-anchor': 'end' }));
  chart.svg.append(chart.pointer, chart.cursor, ...chart.dots, ...chart.values);
  moveCursor(chart, clock.time);
}

function moveCursors(time) {
  for (const chart of charts) if (chart.cursor) moveCursor(chart, time);
}

function moveCursor(chart, time) {
  const read = motion.hover ?? time;
  const place = (line, at) => {
    line.setAttribute('x1', timeToX(chart, at));
    line.setAttribute('x2', timeToX(chart, at));
  };
  place(chart.cursor, time);
  place(chart.pointer, read);
  chart.pointer.toggleAttribute('hidden', motion.hover === null);
  // With many actors the titles need the room: the first ones keep their numbers, the curves' dots show the rest.
  const shown = Math.min(run.actors.length, Math.floor((chart.width - RIGHT - 230) / 62));
  run.actors.forEach((actor, i) => {
    const value = shownValueOf(actor, chart.key, stateAt(actor, read)[chart.key]);
    chart.dots[i].toggleAttribute('hidden', !isNumber(value));
    if (isNumber(value)) {
      chart.dots[i].setAttribute('cx', timeToX(chart, read));
      chart.dots[i].setAttribute('cy', chart.y(value));
    }
    chart.values[i].textContent = i < shown ? fixed(value, chart.digits) : '';
    chart.values[i].setAttribute('x', chart.width - RIGHT - (shown - 1 - i) * 62);
    chart.values[i].setAttribute('y', 13);
  });
}

/** Reading values follows the pointer; pressing and dragging moves the replay. */
function bindHover(holder) {
  const timeOf = (event) => {
    const box = holder.getBoundingClientRect();
    return xToTime(box.width, event.clientX - box.left);
  };
  holder.addEventListener('pointermove', (event) => {
    motion.hover = timeOf(event);
    if (event.buttons === 1) jumpTo(motion.hover);
    else moveCursors(clock.time);
  });
  holder.addEventListener('pointerdown', (event) => jumpTo(timeOf(event)));
  holder.addEventListener('pointerleave', () => {
    motion.hover = null;
    moveCursors(clock.time);
  });
}
