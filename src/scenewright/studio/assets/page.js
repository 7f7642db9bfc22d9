// Puts the page together: transport, keyboard, and the handle that tests and other scripts use.

function buildTransport() {
  const scrubber = byId('scrubber');
  Object.assign(scrubber, { min: FIRST, max: LAST });
  scrubber.addEventListener('input', () => jumpTo(scrubber.value));
  byId('play').addEventListener('click', () => clock.toggle());
  byId('back').addEventListener('click', () => jumpTo(clock.time - 0.1));
  byId('forward').addEventListener('click', () => jumpTo(clock.time + 0.1));
  byId('speed').addEventListener('change', (event) => { clock.rate = Number(event.target.value); });
  for (const trigger of run.triggers) {
    const who = run.triggers.length > 1 ? ` ${trigger.hero}` : '';
    const button = make('button', { type: 'button', class: 'trigger', text: `▼ Trigger${who} ${fixed(trigger.time_s, 2)} s`, title: 'Jump to the trigger (T)' });
    button.addEventListener('click', () => jumpTo(trigger.time_s));
    byId('jumps').append(button);
  }
  placeTicks();
  const width = fixed(LAST, 2).length;
  clock.follow((time) => {
    scrubber.value = time;
    scrubber.setAttribute('aria-valuetext', `${fixed(time, 2)} seconds`);
    byId('clock').textContent = `${fixed(time, 2).padStart(width)} / ${fixed(LAST, 2)} s`;
    byId('play').textContent = clock.playing ? 'Pause' : 'Play';
  });
}

function placeTicks() {
  const put = (time, kind) => {
    const tick = make('i', { class: kind });
    const share = (time - FIRST) / (LAST - FIRST || 1);
    tick.style.left = `calc(6px + ${share} * (100% - 12px))`;
    byId('ticks').append(tick);
  };
  for (const group of knotGroups()) if (!group.trigger) put(group.time, 'knot');
  for (const trigger of run.triggers) put(trigger.time_s, 'trigger');
}

const KEYS = {
  ' ': () => clock.toggle(),
  ArrowLeft: (event) => jumpTo(clock.time - (event.shiftKey ? 1 : 0.1)),
  ArrowRight: (event) => jumpTo(clock.time + (event.shiftKey ? 1 : 0.1)),
  Home: () => jumpTo(FIRST),
  End: () => jumpTo(LAST),
  t: jumpToTrigger,
  f: fitRun,
};

/** The next trigger after now, else the first. */
function jumpToTrigger() {
  const next = run.triggers.find((trigger) => trigger.time_s > clock.time + 1e-6) ?? run.triggers[0];
  if (next) jumpTo(next.time_s);
}

function bindKeyboard() {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { tagName } = event.target;
    // Selects and buttons keep the keys that work them.
    if (tagName === 'SELECT' || (event.key === ' ' && ['BUTTON', 'SUMMARY'].includes(tagName))) return;
    const act = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act) return;
    event.preventDefault();
    act(event);
  });
}

/** `#t=6.3` in the address opens the page at that moment. */
function startFromAddress() {
  const wanted = /[#&]t=([\d.]+)/.exec(window.location.hash);
  if (wanted) jumpTo(Number(wanted[1]));
}

buildHeader();
buildConditions();
buildParameters();
buildFacts();
buildMore();
buildPlanView();
buildCharts();
buildReplans();
buildTransport();
bindKeyboard();
startFromAddress();

window.scenewright = {
  ready: true,
  duration: LAST,
  actors: run.actors.map((actor) => actor.name),
  triggers: run.triggers.map(({ time_s, hero }) => ({ time_s, hero })),
  get time() { return clock.time; },
  get playing() { return clock.playing; },
  get camera() { return { mode: view.camera, pixelsPerMetre: view.k }; },
  seek: jumpTo,
  play: () => clock.play(),
  pause: () => clock.pause(),
  /** Where an actor is drawn now: map coordinates in metres, heading in radians. */
  pose(name) {
    const state = stateAt(actorNamed(name), clock.time);
    return { x_m: state.x + run.origin[0], y_m: state.y + run.origin[1], heading_rad: state.heading };
  },
};
