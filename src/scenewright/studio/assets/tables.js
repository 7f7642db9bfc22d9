// What is said in words and numbers: the verdict, what came of it, the description, conditions, parameters, what else is known, notes.

const VERDICTS = {
  tight: ['✓', 'Success', 'at tight tolerance'],
  loose: ['◐', 'Loose only', 'a success at the loose tolerance, a failure at the tight one'],
  failed: ['✗', 'Failed', ''],
  interrupted: ['‖', 'Interrupted', 'the run did not reach its end'],
  unjudged: ['?', 'Not judged', 'there is no verdict'],
};

function buildHeader() {
  document.title = `${VERDICTS[run.outcome.level][1]}: ${run.name}`;
  const [glyph, words, more] = VERDICTS[run.outcome.level];
  const { judged, total, tight, loose } = run.outcome;
  const count = judged ? `${tight} of ${total} conditions tight, ${loose} loose` : '';
  const detail = [more, count].filter(Boolean).join(' · ');
  byId('verdict').classList.add(run.outcome.level);
  byId('verdict').append(
    make('span', { class: 'glyph', 'aria-hidden': 'true', text: glyph }),
    make('div', {}, make('strong', { text: words }), make('span', { class: 'count', text: detail })),
  );
  byId('name').textContent = run.name;
  byId('about').append(...run.about.map(([label, value]) => make('div', {}, make('dt', { text: label }), make('dd', { text: value }))));
  byId('missing').hidden = !run.missing.length;
  byId('missing').append(...run.missing.map((text) => make('li', { text })));
  byId('cause').hidden = !run.cause;
  byId('cause').textContent = run.cause ? `Why: ${run.cause}`.replaceAll('^2', '²') : '';
  buildAftermath();
  buildDescription();
  buildUnderstood();
}

/** What was understood, a sentence a line, each with the words that it came from. */
function buildUnderstood() {
  const holder = byId('understood');
  holder.hidden = !run.understood.length;
  if (!run.understood.length) return;
  const rows = run.understood.map(({ sentence, words }) => make('li', {}, make('span', { text: sentence.replaceAll('^2', '²') }), words ? make('q', { text: words }) : null));
  holder.append(make('summary', { text: run.description.length ? 'What was understood' : 'What the program says' }), make('ul', {}, ...rows));
}

/** What came of it is not part of the verdict: a test that went as told may end in a collision. */
function buildAftermath() {
  const holder = byId('aftermath');
  holder.hidden = !run.aftermath;
  if (!run.aftermath) return;
  const { text, collision_s: hit } = run.aftermath;
  holder.append(`What came of it: ${text.replaceAll('^2', '²')}. `);
  if (!isNumber(hit)) return;
  holder.classList.add('collision');
  const button = make('button', { type: 'button', class: 'jump', text: `${fixed(hit, 2)} s`, 'aria-label': 'Jump to the collision' });
  button.addEventListener('click', () => jumpTo(hit));
  holder.append(button);
}

function buildDescription() {
  const holder = byId('description');
  holder.hidden = !run.description.length;
  for (const clause of run.description) {
    if (!clause.ids.length) {
      holder.append(clause.text);
      continue;
    }
    const rows = run.conditions.filter((condition) => clause.ids.includes(condition.owner));
    const missed = rows.some((condition) => condition.loose === false);
    const span = make('span', { class: `clause${missed ? ' missed' : ''}`, text: clause.text, title: rows.map((row) => row.text).join('\n') || null });
    span.dataset.ids = clause.ids.join(' ');
    span.addEventListener('pointerenter', () => lightUp(clause.ids));
    span.addEventListener('pointerleave', () => lightUp([]));
    holder.append(span);
  }
}

/** Light the clauses and the table rows of these constraints, and no others. */
function lightUp(ids) {
  for (const span of document.querySelectorAll('.clause')) span.classList.toggle('lit', span.dataset.ids.split(' ').some((id) => ids.includes(id)));
  for (const row of document.querySelectorAll('tr[data-owner]')) row.classList.toggle('lit', ids.includes(row.dataset.owner));
}

function buildConditions() {
  const holder = byId('conditions');
  if (!run.conditions.length) {
    holder.append(make('p', { class: 'empty', text: run.outcome.judged ? 'The verdict lists no conditions.' : 'The run was not judged.' }));
    return;
  }
  byId('conditions-hint').textContent = 'a row shows its words in the description; its moment jumps there';
  const heads = [['Kind', ''], ['Condition', ''], ['Required', 'number'], ['Measured', 'number'], ['Error', 'number'], ['Tight', ''], ['Loose', ''], ['Moment', 'number']];
  const head = make('tr', {}, ...heads.map(([text, kind]) => make('th', { scope: 'col', class: kind || null, text })));
  const [story, routine] = [run.conditions.filter((each) => !isRoutine(each)), run.conditions.filter(isRoutine)];
  const table = make('table', { id: 'condition-table' }, make('thead', {}, head), make('tbody', {}, ...story.map(conditionRow)));
  if (routine.length) table.append(...routineBodies(routine, heads.length));
  holder.append(table);
}

/** Checks on routes and physics that hold, as they nearly always do: folded away. One that fails stands with the others. */
function isRoutine(condition) {
  return ['route', 'safety'].includes(condition.kind) && condition.id !== 'no_collision' && condition.tight === true && run.conditions.length > 12;
}

function routineBodies(conditions, columns) {
  const rows = make('tbody', { hidden: '' }, ...conditions.map(conditionRow));
  const words = (shown) => `${shown ? '▾ Hide' : '▸ Show'} ${conditions.length} checks of routes and physics, all met`;
  const button = make('button', { type: 'button', id: 'routine', 'aria-expanded': 'false', text: words(false) });
  button.addEventListener('click', () => {
    rows.hidden = !rows.hidden;
    button.setAttribute('aria-expanded', String(!rows.hidden));
    button.textContent = words(!rows.hidden);
  });
  return [make('tbody', {}, make('tr', {}, make('td', { colspan: columns }, button))), rows];
}

function conditionRow(condition) {
  const words = condition.words ? make('span', { class: 'words', text: `“${condition.words}”` }) : null;
  const text = make('td', {}, make('div', { class: 'said' }, make('span', { text: condition.text.replaceAll('^2', '²') }), words));
  const known = isNumber(condition.time) && condition.time >= FIRST && condition.time <= LAST;
  const jump = known ? make('button', { type: 'button', class: 'jump', text: `${fixed(condition.time, 2)} s`, 'aria-label': `Jump to ${fixed(condition.time, 2)} seconds` }) : null;
  const row = make('tr', { class: known ? 'jumps-to' : null, 'data-owner': condition.owner, 'data-id': condition.id },
    make('td', {}, make('span', { class: 'kind', text: condition.kind })),
    text,
    measuredCell(condition.required, condition.unit, 'required'),
    measuredCell(condition.measured, condition.unit, 'measured'),
    measuredCell(condition.error, condition.unit, 'error'),
    make('td', { class: 'mark-cell' }, markOf(condition.tight)),
    make('td', { class: 'mark-cell' }, markOf(condition.loose)),
    make('td', { class: 'number' }, jump ?? '–'));
  if (known) row.addEventListener('click', () => jumpTo(condition.time));
  for (const name of ['pointerenter', 'focusin']) row.addEventListener(name, () => lightUp([condition.owner]));
  for (const name of ['pointerleave', 'focusout']) row.addEventListener(name, () => lightUp([]));
  return row;
}

function measuredCell(value, unit, name) {
  const cell = make('td', { class: 'number', 'data-cell': name, 'data-value': JSON.stringify(value ?? null), text: brief(value) });
  if (isNumber(value) && unit) cell.append(' ', make('span', { class: 'unit', text: unit.replace('^2', '²') }));
  return cell;
}

function markOf(met) {
  if (typeof met !== 'boolean') return make('span', { class: 'kind', text: '–' });
  return make('span', { class: met ? 'met' : 'not-met', text: met ? '✓ met' : '✗ missed' });
}

function buildParameters() {
  const holder = byId('parameters');
  if (!run.parameters.length) {
    holder.append(make('p', { class: 'empty', text: 'No parameters.' }));
    return;
  }
  const sources = { given: 'given', solver: 'chosen by the solver', program: 'written in the program' };
  const rows = run.parameters.map(({ name, value, unit, source }) => make('tr', {},
    make('td', {}, make('code', { text: name })),
    make('td', { class: 'number', text: (value ?? 'open').replace('-', '−') }, ' ', make('span', { class: 'unit', text: unit.replace('^2', '²') })),
    make('td', {}, make('span', { class: `source-tag ${source}`, text: sources[source] ?? source }))));
  holder.append(make('table', {}, make('thead', {}, make('tr', {},
    make('th', { scope: 'col', text: 'Name' }), make('th', { scope: 'col', class: 'number', text: 'Value' }), make('th', { scope: 'col', text: 'Source' }))),
  make('tbody', {}, ...rows)));
}

function buildFacts() {
  const holder = byId('facts');
  if (!run.facts.length) {
    holder.append(make('p', { class: 'empty', text: 'Nothing more is known of this run.' }));
    return;
  }
  holder.append(make('ul', { class: 'facts' }, ...run.facts.map(([text, time]) => {
    const known = isNumber(time) && time >= FIRST && time <= LAST;
    const jump = known ? make('button', { type: 'button', class: 'jump', text: `${fixed(time, 2)} s`, 'aria-label': `Jump to ${fixed(time, 2)} seconds` }) : null;
    jump?.addEventListener('click', () => jumpTo(time));
    return make('li', {}, make('span', { text }), jump);
  })));
}

function buildMore() {
  const holder = byId('more');
  if (run.notes.length) {
    holder.append(make('div', { class: 'panel-head' }, make('h2', { text: 'Findings and notes' })), make('ul', {}, ...run.notes.map((text) => make('li', { text }))));
  }
  if (run.program) {
    holder.append(make('details', {}, make('summary', { text: 'Program (program.scene)' }), make('pre', { class: 'source-text', text: run.program })));
  }
  holder.hidden = !holder.childElementCount;
}
