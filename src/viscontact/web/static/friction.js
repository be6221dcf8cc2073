// Friction coefficient over speed with the limits of slow and fast motion, beside that of the reference.

import { axis, layout, placeText, plotly, quiet } from "./charts.js";
import { place } from "./dom.js";
import { colour } from "./theme.js";
import { quantityText, unitFor } from "./units.js";

// Room above and below the values, as a factor.
const ROOM = 2;

export async function drawFriction(shown, reference) {
  const Plotly = await plotly(), { friction } = shown.data, box = place("friction");
  place("friction-chapter").hidden = !friction;
  if (!friction) { Plotly.purge(box); return; }
  const unit = unitFor("m/s", friction.speed);
  const values = shown.data.scalars.friction_coefficient.value.filter((value) => value > 0);
  const lowest = Math.min(...values) / ROOM, highest = Math.max(...values) * ROOM;
  const limits = friction.limits.filter(({ value }) => value.some((each) => each > lowest && each < highest));
  const traces = [
    ...limits.map((limit) => ({
      x: friction.speed.map((speed) => speed / unit.factor), y: limit.value, name: limit.name, mode: "lines",
      line: { color: colour("faint"), width: 1.2, dash: limit.dash }, hoverinfo: "skip",
    })),
    ...(reference ? [curve(reference, unit, { color: colour("warm"), width: 2, dash: "dash" })] : []),
    curve(shown, unit, { color: colour("blue"), width: 2 }),
  ];
  await Plotly.react(box, traces, layout({
    showlegend: traces.length > 1, legend: { orientation: "h", x: 0, y: 1, yanchor: "bottom" },
    xaxis: axis(`Speed [${unit.symbol}]`, { type: "log", ...ticks(friction.speed.map((speed) => speed / unit.factor)) }),
    yaxis: axis("", { type: "log", range: [Math.log10(lowest), Math.log10(highest)], ...ticks([lowest, highest]) }),
  }), quiet());
}

// Decades, and within two of them 1, 2 and 5 of each.
function ticks(values) {
  const [first, last] = [Math.min(...values), Math.max(...values)].map(Math.log10);
  const steps = last - first > 2 ? [1] : [1, 2, 5], tickvals = [];
  for (let power = Math.floor(first); power <= last; power++)
    for (const step of steps) tickvals.push(Number((step * 10 ** power).toPrecision(1)));
  return { tickmode: "array", tickvals, ticktext: tickvals.map(String) };
}

function curve({ data, status }, unit, line) {
  const { value, error } = data.scalars.friction_coefficient, { values } = data.axis;
  return {
    x: values.map((speed) => speed / unit.factor), y: value, name: status.label, mode: "lines+markers",
    line, marker: { color: line.color, size: 6 },
    error_y: { type: "data", array: error.map((half) => half ?? 0), color: line.color, thickness: 1.2, width: 3 },
    text: value.map((each, i) => `${placeText(data.axis, values[i])}: ${quantityText(each, error[i], "1")}`),
    hovertemplate: "%{text}<extra></extra>",
  };
}
