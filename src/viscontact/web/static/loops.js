// Resistance over the position of a body that moves back and forth, beside that of the reference.

import { axis, layout, plotly, quiet } from "./charts.js";
import { make, place } from "./dom.js";
import { titled } from "./histories.js";
import { colour } from "./theme.js";
import { unitFor } from "./units.js";

const inSI = (values, factor) => values.map((value) => (value === null ? null : value * factor));

export async function drawLoops(shown, reference) {
  const Plotly = await plotly(), { loops } = shown.data;
  place("loops-chapter").hidden = loops.length === 0;
  for (const each of place("loops").querySelectorAll(".plot")) Plotly.purge(each);
  const boxes = loops.map(() => make("div", { class: "panel" }, make("h4"), make("div", { class: "plot" })));
  place("loops").replaceChildren(...boxes);
  const earlier = loops.some(({ last }) => last > 0) ? "Bold: the last cycle. " : "";
  place("loops-text").textContent = `${earlier}The area inside is the motion work of a cycle.`;
  loops.forEach((loop, index) => {
    const other = reference?.data.loops.find(({ along }) => along === loop.along);
    drawLoop(Plotly, boxes[index], loop, other);
  });
}

function drawLoop(Plotly, box, loop, other) {
  const positions = inSI(loop.position, loop.lengthFactor), forces = inSI(loop.values, loop.valueFactor);
  const length = unitFor("m", positions), force = unitFor("N", forces);
  const part = (from, to, look) => ({
    x: inSI(positions.slice(from, to), 1 / length.factor), y: inSI(forces.slice(from, to), 1 / force.factor),
    mode: "lines", line: look, text: loop.hover.slice(from, to),
    hovertemplate: `${loop.along} %{x:.4g} ${length.symbol}, %{text}<extra></extra>`,
  });
  const traces = [
    part(0, loop.last + 1, { color: colour("line"), width: 1 }),
    part(loop.last, undefined, { color: colour("blue"), width: 2.2 }),
  ];
  if (other) traces.unshift({
    x: inSI(other.position, other.lengthFactor / length.factor), hoverinfo: "skip", mode: "lines",
    y: inSI(other.values, other.valueFactor / force.factor), line: { color: colour("warm"), width: 1.6, dash: "dash" },
  });
  box.querySelector("h4").textContent = titled(`Resistance along ${loop.along}`, force);
  return Plotly.newPlot(box.querySelector(".plot"), traces, layout({
    xaxis: axis(titled(`Position along ${loop.along}`, length)),
    yaxis: axis("", { zeroline: true, zerolinecolor: colour("edge") }),
  }), quiet());
}
