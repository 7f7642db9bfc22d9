// The run: its data, the states of all actors at any instant, and the clock that every part of the page follows.

const run = JSON.parse(byId('data').textContent);
const times = run.time;
const FIRST = times[0];
const LAST = times[times.length - 1];

run.actors.forEach((actor, index) => { actor.tone = `actor-${index % 8}`; });
const actorNamed = (name) => run.actors.find((actor) => actor.name === name);

/** Whether the program speaks of this landmark on this actor's route; without a program, what is always worth naming. */
function isSpokenOf(actor, name) {
  const named = run.places ? run.places[actor.name] ?? [] : ['stop_line', 'conflict_point'];
  const alias = { intersection: ['turn'], conflict_point: ['intersection', 'turn'] }[name] ?? [];
  return [name, ...alias].some((each) => named.includes(each));
}

function between(values, index, share) {
  const here = values[index];
  const next = values[Math.min(index + 1, values.length - 1)];
  if (here === null || next === null) return here;
  return here + (next - here) * share;
}

/** State of an actor at an instant: straight lines between samples, the shorter way round for the heading. */
function stateAt(actor, time) {
  const t = clamp(time, FIRST, LAST);
  const index = indexAt(times, t);
  const width = index + 1 < times.length ? times[index + 1] - times[index] : 1;
  const share = index + 1 < times.length ? (t - times[index]) / width : 0;
  const heading = actor.heading[index];
  const turned = (actor.heading[Math.min(index + 1, times.length - 1)] ?? heading) - heading;
  return {
    x: between(actor.x, index, share),
    y: between(actor.y, index, share),
    heading: heading + Math.atan2(Math.sin(turned), Math.cos(turned)) * share,
    s: between(actor.s, index, share),
    v: between(actor.v, index, share),
    a: actor.a[index],
  };
}

const clock = {
  time: FIRST,
  playing: false,
  rate: 1,
  followers: [],
  lastFrame: null,

  /** Call `handler(time)` now and whenever the time changes. */
  follow(handler) {
    this.followers.push(handler);
    handler(this.time);
  },
  seek(time) {
    this.time = clamp(Number(time) || 0, FIRST, LAST);
    for (const handler of this.followers) handler(this.time);
  },
  play() {
    if (this.playing) return;
    if (this.time >= LAST) this.seek(FIRST);
    this.playing = true;
    this.lastFrame = null;
    requestAnimationFrame((now) => this.frame(now));
    this.seek(this.time);
  },
  pause() {
    this.playing = false;
    this.seek(this.time);
  },
  toggle() {
    if (this.playing) this.pause();
    else this.play();
  },
  frame(now) {
    if (!this.playing) return;
    const elapsed = this.lastFrame === null ? 0 : Math.min(0.25, (now - this.lastFrame) / 1000);
    this.lastFrame = now;
    this.seek(this.time + elapsed * this.rate);
    if (this.time >= LAST) this.pause();
    else requestAnimationFrame((next) => this.frame(next));
  },
};

/** Jump there and stand still, so that the moment can be looked at. */
function jumpTo(time) {
  clock.playing = false;
  clock.seek(time);
}
