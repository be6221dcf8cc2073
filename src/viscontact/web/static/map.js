// Pressure map with a slider over time or speed, sections along x and y, and the line load of long contacts.

import { axis, capital, config, layout, placeText, plotly, quiet } from "./charts.js";
import { make, place, settled } from "./dom.js";
import { colour } from "./theme.js";
import { digits, unitFor } from "./units.js";

const COLOURS = [
  [0, "#f1f8c9"], [0.2, "#c7e9b4"], [0.4, "#7fcdbb"], [0.6, "#41b6c4"],
  [0.8, "#1d91c0"], [0.9, "#225ea8"], [1, "#0c2c84"],
];
const LINE_LOAD = "line-load";
let picture = null;
let clock = null;

export function setUpMap() {
  place("instant-slider").addEventListener("input", () => showInstant(Number(place("instant-slider").value)));
  place("instant-slider").addEventListener("pointerdown", pause);
  place("play").addEventListener("click", () => (clock === null ? play() : pause()));
  // The height depends on the width, which changes with the window.
  window.addEventListener("resize", settled(() => picture && drawPlane(), 150));
}

// Redraws the map; the instant is kept for the same run.
export async function drawMap(shown, reference) {
  const Plotly = await plotly(), map = shown.data.map;
  place("map-chapter").hidden = !map;
  if (!map) { picture = null; return; }
  const same = picture?.id === shown.id, index = same ? picture.index : map.start;
  const extent = [...map.x, ...map.y].map((value) => value * map.lengthFactor);
  picture = {
    id: shown.id, map, reference: reference?.data.map ?? null, Plotly, index, kept: same ? picture.kept : new Map(),
    length: unitFor("m", extent), pressure: unitFor("Pa", map.peak * map.pressureFactor), over: { ...shown.data.axis, values: map.places },
  };
  const slider = place("instant-slider");
  slider.max = String(map.places.length - 1);
  slider.setAttribute("aria-label", capital(shown.data.axis.row));
  slider.value = String(index);
  place("map-controls").hidden = map.places.length < 2;
  showInstant(index);
}

function unpacked(index) {
  const { map, kept } = picture;
  if (kept.has(index)) return kept.get(index);
  const bytes = Uint8Array.from(atob(map.parts[index]), (letter) => letter.charCodeAt(0));
  const parts = new DataView(bytes.buffer), width = map.x.length;
  const step = map.peak * map.pressureFactor / map.steps;
  const rows = map.y.map((_, j) => map.x.map((_, i) => parts.getUint16(2 * (j * width + i), true) * step || null));
  kept.set(index, rows);
  return rows;
}

function showInstant(index) {
  if (!picture) return;
  picture.index = index;
  const { map, pressure, over } = picture, peak = Math.max(...unpacked(index).flat());
  const label = placeText(over, map.places[index]);
  place("instant").value = label;
  place("instant-slider").setAttribute("aria-valuetext", label);
  const body = map.body[index];
  const stretch = map.stretch === 1 ? "" : ` y is drawn ${digits(map.stretch, 0)} times as long as x.`;
  const largest = `Largest pressure ${map.mesh[index] ? "> " : ""}${digits(peak / pressure.factor)} ${pressure.symbol}.`;
  const moved = body ? ` Cross: the body’s axis${body.direction ? ", arrow: its motion" : ", at rest"}.` : "";
  place("map-text").textContent = (peak > 0 ? largest + stretch : "No contact.") + moved;
  drawPlane();
  place(LINE_LOAD).parentElement.hidden = !map.sections.some((each) => each.name === LINE_LOAD);
  for (const curve of map.sections) drawCurve(curve);
}

const rim = (source, index, unit) => {
  const factor = source.lengthFactor / unit.factor;
  const times = (values) => values.map((value) => (value === null ? null : value * factor));
  return { x: times(source.rims[index].x), y: times(source.rims[index].y), mode: "lines", hoverinfo: "skip" };
};

// Index of the nearest instant or speed of the reference.
function nearest(places, place) {
  return places.reduce((best, each, index) => (Math.abs(each - place) < Math.abs(places[best] - place) ? index : best), 0);
}

// Title of an axis as an annotation: a horizontal colour bar would shift a real one into the labels.
const below = (text) => ({
  text, showarrow: false, xref: "paper", yref: "paper", x: 0.5, y: 0, yanchor: "top", yshift: -20,
  font: { size: 12, color: colour("ink") },
});

// The axis of a moving body, and an arrow from it along the motion, 34 pixels long.
const cross = ({ axis: [x, y] }) => ({
  x: [x], y: [y], mode: "markers", hoverinfo: "skip",
  marker: { symbol: "cross-thin", size: 9, line: { color: colour("warm"), width: 2 } },
});
function arrow({ axis: [x, y], direction }, stretch) {
  const up = stretch * direction[1], pixels = 34 / Math.hypot(direction[0], up);
  const [across, ahead] = [pixels * direction[0], pixels * up];
  return {
    x, y, xref: "x", yref: "y", text: "", showarrow: true, arrowhead: 2, arrowwidth: 2.2, arrowcolor: colour("warm"),
    xshift: across, yshift: ahead, ax: -across, ay: ahead,
  };
}

function drawPlane() {
  const { map, reference, index, length, pressure, Plotly } = picture, box = place("map");
  const factor = map.lengthFactor / length.factor, scaled = (values) => values.map((value) => value * factor);
  const z = unpacked(index).map((row) => row.map((value) => (value === null ? null : value / pressure.factor)));
  const at = `x %{x:.4g} ${length.symbol}, y %{y:.4g} ${length.symbol}`;
  const heat = {
    type: "heatmap", x: scaled(map.x), y: scaled(map.y), z, zmin: 0,
    zmax: map.peak * map.pressureFactor / pressure.factor, colorscale: COLOURS, hoverongaps: false, zsmooth: false,
    hovertemplate: `${at}<br>%{z:.4g} ${pressure.symbol}<extra></extra>`,
    colorbar: {
      orientation: "h", thickness: 10, len: 0.9, x: 0.5, y: 1, yanchor: "bottom", outlinewidth: 0,
      tickfont: { size: 11, color: colour("ink") },
      title: { text: `Pressure [${pressure.symbol}]`, side: "top", font: { size: 12, color: colour("ink") } },
    },
  };
  const traces = [heat, { ...rim(map, index, length), line: { color: colour("ink"), width: 1 } }];
  if (reference) {
    const then = nearest(reference.places, map.places[index]);
    traces.push({ ...rim(reference, then, length), line: { color: colour("warm"), width: 1.6, dash: "dash" } });
  }
  const body = map.body[index] && { ...map.body[index], axis: scaled(map.body[index].axis) };
  if (body) traces.push(cross(body));
  const xRange = scaled(map.xRange), yRange = scaled(map.yRange), constrain = map.periodic ? "domain" : "range";
  const ratio = map.stretch * (yRange[1] - yRange[0]) / (xRange[1] - xRange[0]);
  const height = Math.round(Math.min(Math.max((box.clientWidth - 76) * ratio + 128, 190), 560));
  // The colour bar adds its own space above the map.
  const plane = layout({
    height,
    margin: { l: 56, r: 20, t: 0, b: 50 },
    annotations: [below(`x [${length.symbol}]`), ...(body?.direction ? [arrow(body, map.stretch)] : [])],
    xaxis: axis("", { range: xRange, constrain, showgrid: false }),
    yaxis: axis(`y [${length.symbol}]`, {
      range: yRange, constrain, showgrid: false, scaleanchor: "x", scaleratio: map.stretch,
    }),
  });
  Plotly.react(box, traces, plane, config());
}

function drawCurve(curve) {
  const { map, reference, index, length, over, Plotly } = picture;
  const unit = unitFor(curve.si, curve.values.flat().map((value) => value * curve.valueFactor));
  const line = (source, part, at, look) => ({
    x: part.position.map((value) => value * source.lengthFactor / length.factor), mode: "lines", line: look,
    y: part.values[at].map((value) => value * part.valueFactor / unit.factor),
    hovertemplate: `${curve.along} %{x:.4g} ${length.symbol}: %{y:.4g} ${unit.symbol}`
      + `<extra>${placeText(over, source.places[at])}</extra>`,
  });
  const traces = map.places.map((_, each) => line(map, curve, each, { color: colour("line"), width: 1 }));
  const part = reference?.sections.find((each) => each.name === curve.name);
  if (part) {
    const then = nearest(reference.places, map.places[index]);
    traces.push(line(reference, part, then, { color: colour("warm"), width: 2, dash: "dash" }));
  }
  traces.push(line(map, curve, index, { color: colour("blue"), width: 2.4 }));
  const edges = curve.edges?.[index];
  if (edges) traces.push(edgeMarks(edges.map((edge) => edge * map.lengthFactor / length.factor)));
  const box = place(curve.name);
  box.previousElementSibling.replaceChildren(...headingOf(curve));
  Plotly.react(box, traces, layout({
    xaxis: axis(`${curve.along} [${length.symbol}]`),
    yaxis: axis(`${curve.label} [${unit.symbol}]`, { rangemode: "tozero" }),
  }), quiet());
}

// Leading (full) and trailing (hollow) edge of a moving contact.
const edgeMarks = (edges) => ({
  x: edges, y: [0, 0], mode: "markers", cliponaxis: false, text: ["leading edge", "trailing edge"],
  marker: { size: 8, color: [colour("blue"), colour("card")], line: { color: colour("blue"), width: 1.6 } },
  hovertemplate: "%{text}: %{x:.4g}<extra></extra>",
});

function headingOf(curve) {
  if (curve.name === LINE_LOAD) return ["Line load along x"];
  const { map, length, index } = picture, other = curve.along === "x" ? 1 : 0;
  const through = `${"xy"[other]} = ${digits(map.crossings[index][other] / length.factor, 0)} ${length.symbol}`;
  const edges = curve.edges?.[index] ? ", ● leading, ○ trailing edge" : "";
  return [`Along ${curve.along} `, make("span", { textContent: `at ${through}${edges}` })];
}

function play() {
  const slider = place("instant-slider"), last = Number(slider.max);
  if (Number(slider.value) >= last) { slider.value = "0"; showInstant(0); }
  place("play").textContent = "Stop";
  clock = setInterval(() => {
    if (Number(slider.value) >= last) { pause(); return; }
    slider.value = String(Number(slider.value) + 1);
    showInstant(Number(slider.value));
  }, 800);
}

function pause() {
  clearInterval(clock);
  clock = null;
  place("play").textContent = "Play";
}
