// Common parts of figures: loading of Plotly, axes, colours and the time axis.

import { make } from "./dom.js";
import { colour } from "./theme.js";
import { unitFor } from "./units.js";

let loading = null;

// The library is large, so it is loaded with the first result.
export function plotly() {
  loading ??= new Promise((ready, failed) => {
    const script = make("script", { src: "/static/plotly.min.js" });
    script.onload = () => ready(window.Plotly);
    script.onerror = () => { loading = null; failed(new Error("plotly.min.js cannot be loaded")); };
    document.head.append(script);
  });
  return loading;
}

// Scrolling with a finger must not zoom the figures.
const byFinger = () => window.matchMedia("(pointer: coarse)").matches || window.innerWidth < 640;
export const config = () => ({
  responsive: true, displaylogo: false, displayModeBar: byFinger() ? false : "hover",
  doubleClick: "reset", modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
  toImageButtonOptions: { format: "svg" },
});
export const quiet = () => ({ ...config(), displayModeBar: false });

export const axis = (title, more = {}) => ({
  title: { text: title, standoff: 8, font: { size: 12 } }, color: colour("ink"), tickfont: { size: 11 },
  gridcolor: colour("grid"), zeroline: false, linecolor: colour("edge"), ticks: "outside", ticklen: 3,
  automargin: true, ...more,
});

export const layout = (more) => ({
  font: { family: "system-ui, -apple-system, 'Segoe UI', Roboto, Arial, sans-serif", color: colour("ink") },
  margin: { l: 50, r: 20, t: 10, b: 42 }, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
  dragmode: byFinger() ? false : "zoom", showlegend: false,
  modebar: { bgcolor: "rgba(0,0,0,0)", color: colour("faint"), activecolor: colour("ink") },
  hoverlabel: { bgcolor: colour("card"), bordercolor: colour("edge"), font: { color: colour("ink") } }, ...more,
});

const number = (value) => String(Number(value.toPrecision(3)));
export const instant = (seconds, unit) => `${Number((seconds / unit.factor).toPrecision(4))} ${unit.symbol}`;

// Positions on the time axis, linear or logarithmic; on the latter, 0 is half a decade before the
// first step.
export function timeScale(instants, onLog) {
  const unit = unitFor("s", instants), times = instants.map((time) => time / unit.factor);
  const positive = times.filter((time) => time > 0), first = Math.min(...positive), last = Math.max(...positive);
  if (!onLog || positive.length < 2) return {
    unit, at: (time) => time / unit.factor, axis: () => axis(`Time [${unit.symbol}]`, { rangemode: "tozero" }),
  };
  const zero = Math.log10(first) - 0.5;
  const lowest = Math.ceil(Math.log10(first)), highest = Math.floor(Math.log10(last) + 1e-9);
  const decades = Array.from({ length: Math.max(0, highest - lowest + 1) }, (_, index) => lowest + index);
  const labels = decades.map((power) => number(10 ** power));
  const ticks = { tickmode: "array", tickvals: [zero, ...decades], ticktext: ["0", ...labels] };
  return {
    unit, at: (time) => (time > 0 ? Math.log10(time / unit.factor) : zero),
    axis: () => axis(`Time [${unit.symbol}], logarithmic`, ticks),
  };
}
