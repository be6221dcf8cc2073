// Common parts of figures: loading of Plotly, axes, colours and the axis of time or speed.

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
export const amount = (value, unit, digits = 4) => `${Number((value / unit.factor).toPrecision(digits))} ${unit.symbol}`;

// An instant or a speed of a run's axis in words: "t = 2 s", "500 mm/s". Instants share a unit, so
// that zero has one.
export const placeText = ({ name, unit, symbol, values }, value) =>
  symbol + amount(value, unitFor(unit, name === "time" ? values : value));

export const capital = (word) => word.charAt(0).toUpperCase() + word.slice(1);

// Positions on the axis of time or speed, linear or logarithmic; on the latter, 0 is half a decade
// before the first step.
export function placeScale({ name, unit: si }, values, onLog) {
  const unit = unitFor(si, values), places = values.map((value) => value / unit.factor), label = capital(name);
  const positive = places.filter((place) => place > 0), first = Math.min(...positive), last = Math.max(...positive);
  if (!onLog || positive.length < 2) return {
    at: (value) => value / unit.factor, axis: () => axis(`${label} [${unit.symbol}]`, { rangemode: "tozero" }),
  };
  const zero = Math.log10(first) - 0.5;
  const lowest = Math.ceil(Math.log10(first)), highest = Math.floor(Math.log10(last) + 1e-9);
  const decades = Array.from({ length: Math.max(0, highest - lowest + 1) }, (_, index) => lowest + index);
  const labels = decades.map((power) => number(10 ** power));
  const begins = positive.length < places.length;
  const ticks = {
    tickmode: "array", tickvals: begins ? [zero, ...decades] : decades, ticktext: begins ? ["0", ...labels] : labels,
  };
  return {
    at: (value) => (value > 0 ? Math.log10(value / unit.factor) : zero),
    axis: () => axis(`${label} [${unit.symbol}], logarithmic`, ticks),
  };
}
