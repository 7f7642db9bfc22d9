// The re-solves: how long each took, how it ended and why, on the time axis of the run.

const STATUS_CLASSES = [
  ['bad', ['unsat', 'infeasible', 'failed', 'error', 'invalid']],
  ['unsure', ['unknown', 'timeout', 'time limit', 'gave up', 'relaxed']],
  ['reuse', ['kept', 'reused', 'shifted', 'held', 'frozen', 'last plan', 'skipped', 'unchanged']],
  ['ok', ['sat', 'ok', 'solved', 'optimal', 'feasible']],
];

function statusClass(status) {
  const words = spoken(status).toLowerCase();
  const exact = STATUS_CLASSES.find(([, names]) => names.includes(words));
  return (exact ?? STATUS_CLASSES.find(([, names]) => names.some((name) => words.startsWith(name))) ?? ['other'])[0];
}

function buildReplans() {
  const holder = byId('replans');
  if (!run.replans || !run.replans.rows.length) {
    holder.classList.remove('strip');
    holder.append(make('p', { class: 'empty', text: run.replans ? 'The run had no re-solves (open loop).' : 'No record of re-solves.' }));
    byId('replan-readout').hidden = true;
    return;
  }
  summariseReplans();
  const svg = draw('svg', { role: 'img', 'aria-label': 'Wall time of each re-solve in milliseconds over the run' });
  holder.append(svg);
  const strip = { svg, holder, rows: run.replans.rows, top: 14, bottom: 22, key: 'strip' };
  onResize(holder, (width, height) => {
    Object.assign(strip, { width: width - 8, height: height - 8 });
    paintStrip(strip);
  });
  clock.follow((time) => moveStripCursor(strip, time));
  bindStrip(strip);
}

function summariseReplans() {
  const { count, solved, p50_ms: p50, p99_ms: p99, max_ms: most, statuses } = run.replans.summary;
  const words = [`${count} moment${count === 1 ? '' : 's'}, ${solved} solved`];
  if (isNumber(p50)) words.push(`p50 ${brief(p50)} ms`, `p99 ${brief(p99)} ms`, `max ${brief(most)} ms`);
  const keys = Object.entries(statuses).map(([status, times_]) => make('span', { class: `key ${statusClass(status)}` }, make('i'), `${times_} ${spoken(status)}`));
  byId('replans-summary').append(words.join(' · '), ...keys);
}

function paintStrip(strip) {
  const walls = strip.rows.map((row) => row.wall_ms).filter(isNumber);
  const most = Math.max(...walls, 0.1);
  const { p50_ms: p50 = most } = run.replans.summary;
  // A few slow solves would flatten all others: then the scale is logarithmic.
  strip.log = most / Math.max(p50, 0.01) > 10;
  strip.floor = strip.log ? Math.max(0.05, Math.min(most, ...walls.filter((wall) => wall > 0)) / 1.5) : 0;
  const share = (wall) => (strip.log ? Math.log(Math.max(wall, strip.floor) / strip.floor) / Math.log((most * 1.1) / strip.floor) : wall / (most * 1.1));
  const y = (wall) => strip.height - strip.bottom - share(wall) * (strip.height - strip.top - strip.bottom);
  strip.svg.replaceChildren();
  paintStripAxes(strip, most, y);
  const bar = clamp((strip.width - LEFT - RIGHT) / Math.max(strip.rows.length, 1) - 1, 1.5, 7);
  strip.bars = strip.rows.map((row) => {
    const x = timeToX(strip, row.time);
    const top = Math.min(y(row.wall_ms ?? 0), strip.height - strip.bottom - 2);
    const kind = statusClass(row.status);
    const rect = draw('rect', { class: `bar ${kind}`, x: x - bar / 2, y: top, width: bar, height: strip.height - strip.bottom - top });
    strip.svg.append(rect);
    if (kind === 'bad') strip.svg.append(draw('path', { class: 'cross', d: `M${x - 3} ${top - 8}l6 6m0 -6l-6 6` }));
    return rect;
  });
  strip.cursor = draw('line', { class: 'cursor', y1: strip.top, y2: strip.height - strip.bottom });
  strip.svg.append(strip.cursor);
  moveStripCursor(strip, clock.time);
}

function paintStripAxes(strip, most, y) {
  const decades = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000];
  let last = Infinity;
  for (const value of strip.log ? decades.filter((each) => each > strip.floor && each < most * 1.1) : niceTicks(0, most, 3).ticks) {
    if (last - y(value) < 16) continue;
    last = y(value);
    strip.svg.append(
      draw('line', { class: 'grid', x1: LEFT, x2: strip.width - RIGHT, y1: last, y2: last }),
      draw('text', { class: 'axis-number', x: LEFT - 5, y: last + 3.5, 'text-anchor': 'end', text: brief(value) }),
    );
  }
  strip.svg.append(draw('text', { class: 'chart-title', x: 2, y: 10, text: `wall time, ms${strip.log ? ' (logarithmic)' : ''}` }));
  const along = niceTicks(FIRST, LAST, (strip.width - LEFT - RIGHT) / 70);
  for (const time of along.ticks) {
    const words = `${fixed(time, decimalsOf(along.step))}${time === along.ticks[along.ticks.length - 1] ? ' s' : ''}`;
    strip.svg.append(draw('text', { class: 'axis-number', x: timeToX(strip, time), y: strip.height - 6, 'text-anchor': 'middle', text: words }));
  }
  for (const trigger of run.triggers) {
    const x = timeToX(strip, trigger.time_s);
    strip.svg.append(draw('line', { class: 'knot trigger', x1: x, x2: x, y1: strip.top, y2: strip.height - strip.bottom }));
  }
}

function moveStripCursor(strip, time) {
  if (!strip.cursor) return;
  strip.cursor.setAttribute('x1', timeToX(strip, time));
  strip.cursor.setAttribute('x2', timeToX(strip, time));
  if (!strip.pointed) readReplan(strip, indexAt(strip.rows.map((row) => row.time), time));
}

function readReplan(strip, index) {
  strip.bars?.forEach((bar, i) => bar.classList.toggle('lit', i === index));
  const row = strip.rows[index];
  const parts = [`t ${fixed(row.time, 2)} s`, spoken(row.status), row.wall_ms ? `${brief(row.wall_ms)} ms` : null, row.backend || null,
    isNumber(row.tolerance) ? `off by ${fixed(row.tolerance, 2)} tight tolerances` : null, row.reason || null];
  byId('replan-readout').textContent = parts.filter(Boolean).join(' · ');
}

function bindStrip(strip) {
  const nearest = (event) => {
    const box = strip.svg.getBoundingClientRect();
    const time = xToTime(strip.width, event.clientX - box.left);
    const after = indexAt(strip.rows.map((row) => row.time), time);
    const next = Math.min(after + 1, strip.rows.length - 1);
    return Math.abs(strip.rows[next].time - time) < Math.abs(strip.rows[after].time - time) ? next : after;
  };
  strip.holder.addEventListener('pointermove', (event) => {
    strip.pointed = true;
    readReplan(strip, nearest(event));
  });
  strip.holder.addEventListener('pointerleave', () => {
    strip.pointed = false;
    moveStripCursor(strip, clock.time);
  });
  strip.holder.addEventListener('click', (event) => jumpTo(strip.rows[nearest(event)].time));
}
