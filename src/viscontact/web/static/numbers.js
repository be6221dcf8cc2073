// Table of the scalars of a run with their errors, beside those of the reference.

import { make } from "./dom.js";
import { titleOf } from "./hints.js";
import { amount, placeText, unitFor, valueText } from "./units.js";

const number = (text, style = "") => make("td", { class: `number ${style}`, textContent: text });

export function numbersTable(data, reference) {
  const stated = data.listed.some((name) => isStated(data.scalars[name]));
  const rows = data.listed.map((name) => row(name, data, reference, stated));
  // The column "largest" is left out where all values are largest at the start or the end.
  const isRepeated = data.listed.every((name) => {
    const { value } = data.scalars[name];
    return [0, value.length - 1].includes(largestAt(value));
  });
  const kind = isSteady(data) ? "steady" : isRepeated && "repeated";
  const style = [reference && "compared", kind].filter(Boolean).join(" ");
  return make("table", { class: style },
    make("thead", {}, head(data, reference, stated)), make("tbody", {}, rows));
}

// Results over speed are judged by their largest values.
const isSteady = (data) => data.axis.name === "speed";

const isStated = (scalar) => scalar.mesh.some(Boolean) || scalar.error.some((error) => error !== null);

function head(data, reference, stated) {
  const at = (index) => placeText(data.axis, data.axis.values.at(index)).replaceAll(" ", "\u00a0");
  const column = (text, style = "") => make("th", { scope: "col", class: `number ${style}`, textContent: text });
  return make("tr", {}, make("th", { scope: "col", textContent: "Quantity" }),
    isSteady(data) ? [column("largest"), column("at")] : [column(at(0), "first"), column(at(-1)), column("largest", "largest")],
    stated && column("largest error", "worst"),
    reference && [column(isSteady(data) ? "reference, largest" : "reference, end"), column("change")]);
}

function row(name, data, reference, stated) {
  const scalar = data.scalars[name], other = reference?.data.scalars[name];
  const compared = isSteady(data) ? largestAt : (values) => values.length - 1;
  const then = other && compared(other.value), now = scalar.value[compared(scalar.value)];
  // Values that are rounding errors in the reference are not compared.
  const before = reference?.data.listed.includes(name) ? other.value[then] : null;
  const unit = unitFor(scalar.unit, scalar.value);
  const at = largestAt(scalar.value), largest = scalar.value[at] ?? null;
  const cell = (value, error, mesh, style) =>
    number(whole(valueText(unit, value, shownError(value, error, largest), mesh)), style);
  const cellAt = (index, style) => cell(scalar.value.at(index), scalar.error.at(index), scalar.mesh.at(index), style);
  return make("tr", {},
    make("th", { scope: "row" }, titleOf(name), make("small", { textContent: unit.symbol && ` [${unit.symbol}]` })),
    isSteady(data) ? [cellAt(at), number(speedText(data.axis, at, scalar.value))]
      : [cellAt(0, "first"), cellAt(-1), cellAt(at, "largest")],
    stated && number(errorText(scalar, largest, data.axis), "worst"),
    reference && [cell(before, other?.error[then] ?? null, other?.mesh[then]), number(change(now, before))]);
}

// The speed of the largest value; none where values differ by rounding, as those of a constant force.
const speedText = (axis, at, values) => (values.length > 1 && Math.max(...values) - Math.min(...values) <= 1e-6 * Math.abs(values[at])
  ? "–" : placeText(axis, axis.values[at]).replace(" ", "\u00a0"));

// On narrow pages a value is placed above its error.
const whole = (text) => text.replace("± ", "±\u00a0").replace("> ", ">\u00a0");

export const largestAt = (values) =>
  values.reduce((best, value, index) => (Math.abs(value) > Math.abs(values[best] ?? 0) ? index : best), 0);

// A change from zero is shown as the new value.
const shownError = (value, error, largest) =>
  (value === 0 && error <= 1e-4 * Math.abs(largest) ? 0 : error);

// The largest error as a part of the largest value, and its instant or speed.
function errorText(scalar, largest, { unit: si, values }) {
  if (scalar.mesh.some(Boolean)) return "depends on the mesh";
  const worst = scalar.error.reduce((best, error, index) =>
    (error !== null && !(error <= (scalar.error[best] ?? -1)) ? index : best), -1);
  if (worst < 0) return "not known";
  const part = largest ? Math.abs(scalar.error[worst] / largest) : 0;
  if (part < 1e-4) return "<0.01\u00a0%";
  return `${percent(part)} at ${amount(values[worst], unitFor(si, values[worst]), 3).replace(" ", "\u00a0")}`;
}

const percent = (part) => `${part >= 0.0995 ? (100 * part).toFixed(0) : (100 * part).toPrecision(2)}\u00a0%`;

function change(value, before) {
  if (!before || value === null) return "–";
  const part = Number((100 * (value / before - 1)).toPrecision(3));
  const sign = part < 0 ? "\u2212" : "+";
  return `${Math.abs(part) < 1e-3 ? 0 : sign + Math.abs(part)}\u00a0%`;
}
