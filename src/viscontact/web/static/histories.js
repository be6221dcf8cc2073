// Scalars over time or speed with their error bands, beside those of the reference.

import { axis, layout, placeScale, placeText, plotly, quiet } from "./charts.js";
import { make, place } from "./dom.js";
import { colour, faded } from "./theme.js";
import { quantityText, unitFor } from "./units.js";

let onLog = null;

export const forgetScale = () => { onLog = null; };

export const titled = (label, { symbol }) => (symbol ? `${label} [${symbol}]` : label);

export async function drawHistories(shown, reference) {
  const Plotly = await plotly(), data = shown.data;
  const { name: over, values, startsLog } = data.axis;
  onLog ??= startsLog;
  const panels = { ...data.given, ...data.answers };
  if (data.friction) delete panels.friction_coefficient; // it has a figure of its own
  const scale = placeScale(data.axis, [...values, ...(reference?.data.axis.values ?? [])], onLog);
  const button = place("time-scale");
  // Nothing is drawn over a single speed; the table has its numbers.
  place("histories-chapter").hidden = over === "speed" && values.length < 2;
  place("histories-title").textContent = `Over ${over}`;
  button.textContent = onLog ? `Show linear ${over}` : `Show logarithmic ${over}`;
  button.hidden = values.length < 3;
  button.onclick = () => { onLog = !onLog; drawHistories(shown, reference); };
  for (const [name, label] of Object.entries(panels)) drawPanel(Plotly, name, label, shown, reference, scale);
  for (const box of place("histories").querySelectorAll("[data-panel]"))
    if (!(box.dataset.panel in panels)) { Plotly.purge(box.querySelector(".plot")); box.remove(); }
}

function drawPanel(Plotly, name, label, shown, reference, scale) {
  const scalar = shown.data.scalars[name], other = reference?.data.scalars[name];
  const unit = unitFor(scalar.unit, scalar.value, other?.value ?? []);
  const box = panelBox(name);
  const note = scalar.mesh.some(Boolean) ? "depends on the mesh" : "";
  const isDrawn = [scalar, other].some((each) => each?.drawn.some((value) => value !== null));
  box.querySelector("h4").replaceChildren(titled(label, unit), make("span", { textContent: note }));
  const traces = [band(shown.data, scalar, unit, scale), line(shown.data, scalar, unit, scale, colour("blue"), "solid")];
  if (other) traces.unshift(line(reference.data, other, unit, scale, colour("warm"), "dash"));
  return Plotly.react(box.querySelector(".plot"), traces, layout({
    xaxis: scale.axis(), yaxis: axis("", { range: range([scalar, other], unit), showticklabels: isDrawn }), hovermode: "x",
    annotations: note && !isDrawn ? [inWords("not drawn: smaller cells give more")] : [],
  }), quiet());
}

// Words in place of a curve.
const inWords = (text) => ({
  text, showarrow: false, xref: "paper", yref: "paper", x: 0.5, y: 0.5, font: { size: 12, color: colour("faint") },
});

function panelBox(name) {
  const found = place("histories").querySelector(`[data-panel="${name}"]`);
  const box = found ?? make("div", { class: "panel", "data-panel": name }, make("h4"), make("div", { class: "plot" }));
  place("histories").append(box); // in the order of this run
  return box;
}

const scaled = (values, unit) => values.map((value) => (value === null ? null : value / unit.factor));

function line(data, scalar, unit, scale, ink, dash) {
  const y = scaled(scalar.drawn, unit);
  const hoverText = (value, index) => {
    const number = quantityText(value, scalar.error[index], scalar.unit, scalar.mesh[index]);
    return `${placeText(data.axis, data.axis.values[index])}: ${number}`;
  };
  return {
    x: data.axis.values.map(scale.at), y, mode: y.length < 2 ? "markers" : data.axis.name === "time" ? "lines" : "lines+markers",
    line: { color: ink, width: 2, dash }, marker: { color: ink, size: 5 }, text: scalar.value.map(hoverText),
    hovertemplate: "%{text}<extra></extra>",
  };
}

// A closed polygon for each run of instants whose error is known.
function band(data, scalar, unit, scale) {
  const x = [], y = [];
  let part = [];
  const close = () => {
    if (part.length > 1) {
      const at = part.map((i) => scale.at(data.axis.values[i]));
      const edge = (sign) => part.map((i) => (scalar.value[i] + sign * scalar.error[i]) / unit.factor);
      x.push(...at, ...at.slice().reverse(), at[0], null);
      y.push(...edge(1), ...edge(-1).reverse(), edge(1)[0], null);
    }
    part = [];
  };
  scalar.value.forEach((value, i) => (value === null || scalar.error[i] === null ? close() : part.push(i)));
  close();
  return { x, y, mode: "lines", fill: "toself", fillcolor: faded("blue", 0.24), line: { width: 0 }, hoverinfo: "skip" };
}

// One wild error is not to flatten what there is to see; a constant is drawn as one.
function range(scalars, unit) {
  const given = scalars.filter(Boolean).flatMap((each) => scaled(each.drawn, unit)).filter((value) => value !== null);
  if (!given.length) return [0, 1];
  const low = Math.min(...given), high = Math.max(...given), size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low <= 1e-6 * size) return [Math.min(0, 1.15 * low), Math.max(0, 1.15 * high) || 1];
  const bars = scalars[0].drawn.map((value, i) => [value, scalars[0].error[i] ?? 0]).filter(([value]) => value !== null);
  const room = Math.max(high - low, 0.5 * size);
  const least = Math.max(Math.min(low, ...bars.map(([value, error]) => (value - error) / unit.factor)), low - room);
  const most = Math.min(Math.max(high, ...bars.map(([value, error]) => (value + error) / unit.factor)), high + room);
  const margin = 0.06 * (most - least);
  return [least === 0 ? 0 : least - margin, most + margin];
}
