// Small helpers: making elements, formatting numbers, searching sorted arrays, choosing axis ticks.

const SVG = 'http://www.w3.org/2000/svg';

const byId = (id) => document.getElementById(id);

/** Make an HTML element; `attributes` may hold `text`, `class` and any attribute; null leaves one out. */
function make(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/** Make an SVG element, the same way. */
function draw(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined) continue;
    if (name === 'text') element.textContent = value;
    else element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

/** A number with a true minus sign and a fixed count of decimals; a dash for what is not known. */
function fixed(value, digits) {
  if (!isNumber(value)) return '–';
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace('-', '') : text.replace('-', '−');
}

/** At most three decimals, without trailing zeros. */
function brief(value) {
  if (!isNumber(value)) return value === null || value === undefined ? '–' : shownValue(value);
  const text = fixed(value, 3);
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

function shownValue(value) {
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  return Array.isArray(value) ? value.map(brief).join(', ') : String(value);
}

const spoken = (name) => name.replaceAll('_', ' ');

/** Index of the last entry that is not above `value`, at least 0. */
function indexAt(sorted, value) {
  let low = 0;
  let high = sorted.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (sorted[middle] <= value) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Round values that cut `low..high` into about `count` steps. */
function niceTicks(low, high, count) {
  const raw = (high - low) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((factor) => factor * power >= raw * 0.999) * power;
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; i += 1) ticks.push(i * step);
  return { ticks, step };
}

/** How many decimals multiples of `step` need. */
const decimalsOf = (step) => [0, 1, 2, 3].find((digits) => Math.abs(step * 10 ** digits - Math.round(step * 10 ** digits)) < 1e-6) ?? 3;

/** Call `handler` with the element's size now and whenever it changes. */
function onResize(element, handler) {
  const measure = () => {
    const box = element.getBoundingClientRect();
    if (box.width > 10 && box.height > 10) handler(box.width, box.height);
  };
  new ResizeObserver(measure).observe(element);
  measure();
}
