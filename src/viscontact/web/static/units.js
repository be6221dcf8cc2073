// Results in units: SI numbers become numbers that people read.

const PREFIXED = [["G", 1e9], ["M", 1e6], ["k", 1e3], ["", 1], ["m", 1e-3], ["µ", 1e-6], ["n", 1e-9],
  ["p", 1e-12], ["f", 1e-15], ["a", 1e-18]];
const TIMES = [["s", 1], ["ms", 1e-3], ["µs", 1e-6]];
const prefixed = (unit) => PREFIXED.map(([prefix, factor]) => [prefix + unit, factor]);
const LADDERS = {
  m: [["m", 1], ["mm", 1e-3], ["µm", 1e-6], ["nm", 1e-9]],
  m2: [["m²", 1], ["mm²", 1e-6], ["µm²", 1e-12], ["nm²", 1e-18]],
  Pa: prefixed("Pa"), N: prefixed("N"), J: prefixed("J"), rad: [["rad", 1], ["mrad", 1e-3], ["µrad", 1e-6]], s: TIMES,
};
// Of every kind the unit to use; mrad and s suit all but SI.
const system = (name, units) => ({ name, units: { rad: ["mrad", 1e-3], s: ["s", 1], ...units } });
const METRIC = { m: ["mm", 1e-3], m2: ["mm²", 1e-6], Pa: ["MPa", 1e6] };
const TINY = { m: ["µm", 1e-6], m2: ["µm²", 1e-12], Pa: ["kPa", 1e3], N: ["mN", 1e-3], J: ["µJ", 1e-6] };
const IMPERIAL = { m: ["in", 0.0254], m2: ["in²", 0.00064516], Pa: ["psi", 6894.757293168], N: ["lbf", 4.4482216152605] };
export const SYSTEMS = {
  auto: { name: "readable units", units: {} },
  mm: system("mm, N, MPa", { ...METRIC, N: ["N", 1], J: ["mJ", 1e-3] }),
  kn: system("mm, kN, MPa", { ...METRIC, N: ["kN", 1e3], J: ["J", 1] }),
  um: system("µm, mN, kPa", TINY),
  us: system("in, lbf, psi", IMPERIAL),
  si: system("SI: m, N, Pa", { m: ["m", 1], m2: ["m²", 1], Pa: ["Pa", 1], N: ["N", 1], J: ["J", 1], rad: ["rad", 1] }),
};
let chosen = "auto";
export const useSystem = (name) => { chosen = name in SYSTEMS ? name : "auto"; };

// The unit for these values [SI], with its factor to SI.
export function unitFor(si, ...values) {
  const fixed = SYSTEMS[chosen].units[si];
  if (fixed) return { symbol: fixed[0], factor: fixed[1] };
  const largest = Math.max(0, ...values.flat().filter(Number.isFinite).map(Math.abs));
  const ladder = LADDERS[si] ?? [[si === "1" ? "" : si, 1]];
  const found = ladder.find(([, factor]) => largest >= 0.9995 * factor) ?? ladder.at(-1);
  const [symbol, factor] = largest > 0 ? found : ladder.find(([, each]) => each === 1);
  return { symbol, factor };
}

const MINUS = "\u2212";
const decimalsOf = (error) => Math.max(0, 1 - Math.floor(Math.log10(error)));

// As many digits as the error supports, five at most; four where it is not known, and no idle
// zeros where there is none.
export function digits(value, error = null) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  const supported = error > 0 ? Math.max(2, Math.floor(Math.log10(size / error)) + 2) : error === 0 ? 5 : 4;
  const kept = Math.min(5, Math.max(2, Number.isFinite(supported) ? supported : 2));
  if (size > 0 && (size < 1e-4 || size >= 1e7)) return value.toExponential(kept - 1).replace("-", MINUS);
  const rounded = Number(value.toPrecision(kept));
  const places = size > 0 ? Math.max(0, kept - 1 - Math.floor(Math.log10(Math.abs(rounded)))) : 0;
  const plain = rounded.toFixed(Math.min(places, 12));
  return (error === 0 ? String(Number(plain)) : plain).replace("-", MINUS);
}

// The error bar by two digits.
export function bar(error) {
  if (!(error > 0)) return "";
  if (error < 1e-4 || error >= 1e6) return `± ${error.toExponential(1)}`;
  return `± ${Number(error.toPrecision(2)).toFixed(Math.min(decimalsOf(error), 12))}`;
}

// A value with its error and unit.
export function told(value, error, si, mesh = false) {
  const unit = unitFor(si, value);
  if (value === null) return "–";
  const half = error === null ? null : error < 1e-5 * Math.abs(value) ? 0 : error / unit.factor;
  return [mesh ? ">" : "", digits(value / unit.factor, half), bar(half), unit.symbol].filter(Boolean).join(" ");
}

// A duration as people say it.
export function lasting(seconds) {
  if (seconds < 1) return "less than a second";
  if (seconds < 90) return `${Math.round(seconds)} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}
