// Force over approach and resistance over position, beside those of the reference.

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
  place("loops-text").textContent = `${earlier}The area inside is the ${[...new Set(loops.map(({ area }) => area))].join(" or the ")} of a cycle.`;
  loops.forEach((loop, index) => {
    const other = reference?.data.loops.find(({ name }) => name === loop.name);
    drawLoop(Plotly, boxes[index], loop, other);
  });
}

function drawLoop(Plotly, box, loop, other) {
  const positions = inSI(loop.position, loop.lengthFactor), forces = inSI(loop.values, loop.valueFactor);
  const length = unitFor("m", positions), force = unitFor("N", forces);
  const part = (from, to, look) => ({
    x: inSI(positions.slice(from, to), 1 / length.factor), y: inSI(forces.slice(from, to), 1 / force.factor),
    mode: "lines", line: look, text: loop.hover.slice(from, to),
    hovertemplate: `${loop.across} %{x:.4g} ${length.symbol}, %{text}<extra></extra>`,
  });
  const thin = { color: colour("line"), width: 1 };
  const traces = [
    part(0, loop.last + 1, thin), part(loop.last, loop.end + 1, { color: colour("blue"), width: 2.2 }),
    part(loop.end, undefined, thin),
  ];
  if (other) traces.unshift({
    x: inSI(other.position, other.lengthFactor / length.factor), hoverinfo: "skip", mode: "lines",
    y: inSI(other.values, other.valueFactor / force.factor), line: { color: colour("warm"), width: 1.6, dash: "dash" },
  });
  box.querySelector("h4").textContent = titled(loop.title, force);
  return Plotly.newPlot(box.querySelector(".plot"), traces, layout({
    xaxis: axis(titled(loop.across, length)),
    yaxis: axis("", { zeroline: true, zerolinecolor: colour("edge") }),
  }), quiet());
}
