// Histories of an active run, drawn from its progress lines.

import { make, place } from "./dom.js";
import { get } from "./server.js";
import { amount, unitFor } from "./units.js";

const WIDTH = 200, HEIGHT = 60, MOST_POINTS = 400;
// Time between two requests [ms]; a run may complete hundreds of steps a second.
const PAUSE = 400;
let curves = null;
let requested = 0;

const none = (id) => ({ id, after: 0, step: -1, busy: false, places: [], scalars: {}, labels: {}, texts: {}, reached: "" });

export function drawGrowing(status) {
  if (curves?.id !== status.id) curves = none(status.id);
  const box = place("growing");
  box.hidden = status.over || !status.figures.length;
  if (box.hidden) { box.replaceChildren(); curves = null; return; }
  if (!curves.busy && status.step > curves.step) request(curves, status);
}

async function request(run, status) {
  run.busy = true;
  await new Promise((ready) => setTimeout(ready, Math.max(0, requested + PAUSE - Date.now())));
  requested = Date.now();
  try {
    const added = await get(`/api/runs/${run.id}/grown?after=${run.after}`);
    append(run, added);
    run.step = run.places.length - (status.axis === "time" ? 1 : 0);
    if (curves === run) show(run, status);
  } catch (error) {
    if (!error.problems) throw error; // the next event repeats the request
  } finally {
    run.busy = false;
  }
}

// A resumed run may have written some lines again.
function append(run, added) {
  if (added.begun === 0) Object.assign(run, none(run.id), { busy: true });
  const places = added.speed ?? added.time, again = run.places.indexOf(places[0]);
  const kept = again < 0 ? run.places.length : again;
  run.places.splice(kept, Infinity, ...places);
  for (const [name, values] of Object.entries(added.scalars)) (run.scalars[name] ??= []).splice(kept, Infinity, ...values);
  if (places.length) Object.assign(run, { labels: added.labels, texts: added.texts, reached: added.reached });
  run.after = added.after;
}

function show(run, status) {
  const { axis: over, begin, end } = status, isFirst = !place("growing").firstChild;
  const at = over === "speed" ? speedScale(begin, end) : scale(run.places, end);
  // Speeds may be computed in any order.
  const order = run.places.map((_, index) => index).sort((one, other) => run.places[one] - run.places[other]);
  const places = order.map((index) => run.places[index]), unit = over === "speed" ? "m/s" : "s";
  const start = begin ? amount(begin, unitFor(unit, begin)) : "0";
  // The numbers are those of the last line read, which may be behind the step of the status.
  const when = make("p", { class: "faint", textContent: `Values at ${run.reached}` });
  place("growing").replaceChildren(when, ...Object.entries(run.labels).map(([name, label]) => {
    const text = run.texts[name] ?? "";
    return make("figure", {},
      make("figcaption", {}, `${label} `, make("b", { textContent: text })), drawn(places, order.map((index) => run.scalars[name][index]), at, `${label} over ${over}`),
      make("div", { class: "ends", "aria-hidden": "true" },
        make("span", { textContent: start }), make("span", { textContent: amount(end, unitFor(unit, end)) })));
  }));
  if (isFirst) place("progress").scrollIntoView({ block: "nearest" });
}

// Position of an instant, 0 to 1: on a logarithmic axis where the steps grow.
function scale(times, end) {
  const first = times.find((time) => time > 0) ?? end;
  if (first > end / 200) return (time) => time / end;
  const zero = Math.log10(first) - 0.5, length = Math.log10(end) - zero;
  return (time) => (time > 0 ? (Math.log10(time) - zero) / length : 0);
}

function speedScale(slowest, fastest) {
  const length = Math.log(fastest / slowest);
  return (speed) => (length > 0 ? Math.log(speed / slowest) / length : 0.5);
}

function drawn(places, values, at, label) {
  const extreme = (choose) => values.reduce((found, value) => choose(found, value ?? 0), 0);
  const least = extreme(Math.min), range = extreme(Math.max) - least || 1;
  const each = Math.max(1, Math.ceil(values.length / MOST_POINTS));
  const height = (value) => (HEIGHT * (1 - (value - least) / range)).toFixed(2);
  const points = values.map((value, i) => (value === null || (i % each && i < values.length - 1) ? null
    : `${(WIDTH * at(places[i])).toFixed(2)},${height(value)}`));
  const svg = (tag, attributes) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    return element;
  };
  const picture = svg("svg", {
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: "none", role: "img",
    "aria-label": `${label} so far`,
  });
  picture.append(svg("line", { class: "base", x1: 0, x2: WIDTH, y1: height(0), y2: height(0) }),
    svg("polyline", { class: "curve", points: points.filter(Boolean).join(" ") }));
  return picture;
}
