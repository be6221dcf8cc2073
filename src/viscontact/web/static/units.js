// SI numbers in readable units, from the server's table.

let systems = {};
// Units of each SI unit, the smallest first, with the least size from which each is used.
let ladders = {};
let chosen = "auto";
export function useUnits(table) { ({ systems, ladders } = table); }
export const systemNames = () => Object.entries(systems).map(([value, { name }]) => [value, name]);
export const useSystem = (name) => { chosen = name in systems ? name : "auto"; };
export const chosenSystem = () => chosen;

// Unit for values [SI], with its factor to SI.
export function unitFor(si, ...values) {
  const fixed = systems[chosen].units[si];
  if (fixed) return fixed;
  const largest = Math.max(0, ...values.flat().filter(Number.isFinite).map(Math.abs));
  const ladder = ladders[si];
  if (largest === 0) return ladder.find(({ factor }) => factor === 1);
  return ladder.findLast(({ least }) => least <= largest) ?? ladder[0];
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
// that zero has one, but for those that are small in it, as a second of a year.
export function placeText({ name, unit, symbol, values }, value) {
  const shared = unitFor(unit, values);
  const fits = name === "time" && (value === 0 || Math.abs(value) >= 0.01 * shared.factor);
  return symbol + amount(value, fits ? shared : unitFor(unit, value));
}

// A duration in a readable unit.
export function lasting(seconds) {
  if (seconds < 1) return "less than a second";
  if (seconds < 90) return `${Math.round(seconds)} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}
