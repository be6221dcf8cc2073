// Display units: SI numbers in readable units.

const PREFIXED = [["G", 1e9], ["M", 1e6], ["k", 1e3], ["", 1], ["m", 1e-3], ["µ", 1e-6], ["n", 1e-9],
  ["p", 1e-12], ["f", 1e-15], ["a", 1e-18]];
const TIMES = [["s", 1], ["ms", 1e-3], ["µs", 1e-6], ["ns", 1e-9]];
const LONG_TIMES = [[2.6e5, "d", 86400], [1e4, "h", 3600]];
const prefixed = (unit, least = 0) =>
  PREFIXED.filter(([, factor]) => factor >= least).map(([prefix, factor]) => [prefix + unit, factor]);
const LADDERS = {
  m: [["m", 1], ["mm", 1e-3], ["µm", 1e-6], ["nm", 1e-9]],
  m2: [["m²", 1], ["mm²", 1e-6], ["µm²", 1e-12], ["nm²", 1e-18]],
  Pa: prefixed("Pa", 1e-9), N: prefixed("N"), "N/m": prefixed("N/m", 1e-9), J: prefixed("J"), W: prefixed("W"), "m/s": prefixed("m/s", 1e-9).filter(([, factor]) => factor <= 1),
  rad: [["rad", 1], ["mrad", 1e-3], ["µrad", 1e-6], ["nrad", 1e-9]], s: TIMES,
};
// Units of each system; mrad and s are used in all but SI.
const system = (name, units) => ({ name, units: { rad: ["mrad", 1e-3], s: ["s", 1], ...units } });
const METRIC = { m: ["mm", 1e-3], "m/s": ["mm/s", 1e-3], m2: ["mm²", 1e-6], Pa: ["MPa", 1e6], "N/m": ["N/mm", 1e3] };
const TINY = {
  m: ["µm", 1e-6], "m/s": ["µm/s", 1e-6], m2: ["µm²", 1e-12], Pa: ["kPa", 1e3], N: ["mN", 1e-3], "N/m": ["N/m", 1],
  J: ["µJ", 1e-6],
};
const IMPERIAL = {
  m: ["in", 0.0254], m2: ["in²", 0.00064516], Pa: ["psi", 6894.757293168], N: ["lbf", 4.4482216152605],
  "N/m": ["lbf/in", 175.12683524647636], "m/s": ["in/s", 0.0254], J: ["in·lbf", 0.11298482902761668],
  W: ["in·lbf/s", 0.11298482902761668],
};
export const SYSTEMS = {
  auto: { name: "readable units", units: {} },
  mm: system("mm, N, MPa", { ...METRIC, N: ["N", 1], J: ["mJ", 1e-3] }),
  kn: system("mm, kN, MPa", { ...METRIC, N: ["kN", 1e3], "N/m": ["kN/mm", 1e6], J: ["J", 1] }),
  um: system("µm, mN, kPa", TINY),
  us: system("in, lbf, psi", IMPERIAL),
  si: system("SI: m, N, Pa", {
    m: ["m", 1], m2: ["m²", 1], Pa: ["Pa", 1], N: ["N", 1], "N/m": ["N/m", 1], J: ["J", 1], rad: ["rad", 1],
    "m/s": ["m/s", 1],
  }),
};
let chosen = "auto";
export const useSystem = (name) => { chosen = name in SYSTEMS ? name : "auto"; };
export const chosenSystem = () => chosen;

// Unit for values [SI], with its factor to SI.
export function unitFor(si, ...values) {
  const fixed = SYSTEMS[chosen].units[si];
  if (fixed) return { symbol: fixed[0], factor: fixed[1] };
  const largest = Math.max(0, ...values.flat().filter(Number.isFinite).map(Math.abs));
  const long = si === "s" && LONG_TIMES.find(([above]) => largest > above);
  if (long) return { symbol: long[1], factor: long[2] };
  const ladder = LADDERS[si] ?? [[si === "1" ? "" : si, 1]];
  // Areas keep their unit down to a hundredth: 0.7 mm² is clearer than 700000 µm².
  const least = si === "m2" ? 0.01 : 1;
  const found = ladder.find(([, factor]) => 1.001 * largest >= least * factor) ?? ladder.at(-1);
  const [symbol, factor] = largest > 0 ? found : ladder.find(([, each]) => each === 1);
  return { symbol, factor };
}

const MINUS = "\u2212";
// Relative error below which it is not shown; a value of unknown error has four digits.
const NEGLIGIBLE = 1e-4, DIGITS = 4, MOST = 7;
// Bars may be parts of a cell, such as 3.75 µm: rounding errors must not decide on the digit.
const TIES_UP = 1 + 1e-9;
// Decimal place of the first digit of a number rounded to two digits: 0 for ones, -1 for tenths.
const leading = (value) => Number(Math.abs(value * TIES_UP).toExponential(1).split("e")[1]);

// A number with a count of significant digits, without an exponent where possible.
function inDigits(value, count) {
  const size = Math.abs(value);
  if (size === 0) return "0";
  if (size < 1e-4 || size >= 1e6) return value.toExponential(count - 1).replace("-", MINUS);
  const rounded = Number(value.toPrecision(count));
  const places = Math.max(0, count - 1 - Math.floor(Math.log10(Math.abs(rounded))));
  return value.toFixed(Math.min(places, 12)).replace("-", MINUS);
}

const withoutIdleZeros = (text) => (/\.\d*$/.test(text) ? text.replace(/\.?0+$/, "") : text);
const isShown = (error, value) => error > NEGLIGIBLE * Math.abs(value);

// Digits down to the second one of the error; no trailing zeros where it is 0.
export function digits(value, error = null) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (error === 0) return withoutIdleZeros(inDigits(value, DIGITS + 1));
  if (!isShown(error, value)) return inDigits(value, DIGITS);
  const last = leading(error) - 1, rounded = Math.round(value / 10 ** last) * 10 ** last;
  if (rounded === 0) return "0";
  return inDigits(rounded, Math.min(Math.max(leading(rounded) - last + 1, 1), MOST));
}

// A value with its error in a unit; without a negligible error.
export function valueText(unit, value, error, mesh = false) {
  if (value === null || value === undefined) return "–";
  const number = value / unit.factor, half = isShown(error, value) ? (error / unit.factor) * TIES_UP : null;
  const parts = [mesh ? ">" : "", digits(number, half), half === null ? "" : `± ${inDigits(Number(half.toPrecision(2)), 2)}`];
  return parts.filter(Boolean).join(" ");
}

// A value with its error and unit, for sentences: without trailing zeros.
export function quantityText(value, error, si, mesh = false) {
  if (value === null || value === undefined) return "–";
  const unit = unitFor(si, value), number = valueText(unit, value, error, mesh);
  return `${number.includes("±") ? number : withoutIdleZeros(number)} ${unit.symbol}`.trim();
}

export const amount = (value, unit, digits = 4) => `${Number((value / unit.factor).toPrecision(digits))} ${unit.symbol}`;

// An instant or a speed of a run's axis in words: "t = 2 s", "500 mm/s". Instants share a unit, so
// that zero has one.
export const placeText = ({ name, unit, symbol, values }, value) =>
  symbol + amount(value, unitFor(unit, name === "time" ? values : value));

// A duration in a readable unit.
export function lasting(seconds) {
  if (seconds < 1) return "less than a second";
  if (seconds < 90) return `${Math.round(seconds)} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}
