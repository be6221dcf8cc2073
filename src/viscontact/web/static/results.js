// What a run found: the numbers with their errors, the pressure, the histories, the downloads.

import { instant } from "./charts.js";
import { make, place, write } from "./dom.js";
import { drawHistories, forgetScale } from "./histories.js";
import { titleOf } from "./hints.js";
import { drawMap } from "./map.js";
import { state } from "./runs.js";
import { bar, digits, told, unitFor } from "./units.js";

const FACTS = { contact_area: "Contact area", approach: "Approach", peak_pressure: "Peak pressure", mean_pressure: "Mean pressure" };
const DOWNLOADS = [
  ["case.yaml", "Case (YAML)", true], ["report.html", "Report (HTML)", true], ["report.html?view=1", "Open the report", false],
  ["result.nc", "Result (netCDF)", true], ["history.csv", "Histories (CSV)", true],
];

export function newRunShown() {
  forgetScale();
}

export async function drawResults() {
  const shown = state.shown;
  place("results").hidden = !shown;
  if (!shown) return;
  const { data, status } = shown, reference = state.reference?.id === shown.id ? null : state.reference;
  write(place("result-title"), data.title);
  place("quality").textContent = status.quality === "coarse" ? "coarse answer" : "full run";
  place("quality").className = `chip ${status.quality}`;
  place("result-notes").replaceChildren(...notes(status, data));
  facts(data);
  place("told").replaceChildren(table(data, reference));
  place("reference-told").replaceChildren(...referenceTold(reference));
  place("downloads").replaceChildren(...downloads(shown));
  place("accuracy").replaceChildren(...data.accuracy.flatMap(([name, account]) => [make("dt", { textContent: name }), make("dd", { textContent: account })]));
  await Promise.all([drawMap(shown, reference), drawHistories(shown, reference)]);
  document.documentElement.dataset.drawn = shown.id;
}

function notes(status, data) {
  const said = [];
  if (status.quality === "coarse") said.push(make("p", { class: "note", textContent: "Fewer cells and steps than the case asks for, and no error bars. Refine to have the case as it is written." }));
  if (status.state !== "done") said.push(make("p", { class: "note", textContent: status.message }));
  said.push(...data.notices.map((text) => make("p", { class: "note warm", textContent: text })));
  if (data.warnings.length) said.push(make("div", { class: "note warm" }, make("p", { textContent: "This run warns:" }), make("ul", {}, data.warnings.map((text) => make("li", { textContent: text })))));
  return said;
}

// The end of the run, or where the contact was largest, if it is lost by then.
function telling(data) {
  const areas = data.scalars.contact_area.value;
  return areas.at(-1) > 0 ? areas.length - 1 : areas.indexOf(Math.max(...areas));
}

function facts(data) {
  const index = telling(data), time = unitFor("s", data.time);
  write(place("facts-when"), `At t = ${instant(data.time[index], time)}${index < data.time.length - 1 ? ", when the contact is largest" : ""}`);
  place("facts").replaceChildren(...Object.entries(FACTS).map(([name, label]) => {
    const { value, error, unit, mesh } = data.scalars[name];
    return make("div", {}, make("dt", { textContent: label }), make("dd", { textContent: told(value[index], error[index], unit, mesh) }));
  }));
}

function table(data, reference) {
  const time = unitFor("s", data.time), heads = [`t = ${instant(data.time[0], time)}`, `t = ${instant(data.time.at(-1), time)}`, "largest"];
  const stated = data.told.some((name) => data.scalars[name].mesh || data.scalars[name].error.some((error) => error !== null));
  if (stated) heads.push("error at most");
  const more = reference ? ["reference, end", "change"] : [];
  const head = make("tr", {}, make("th", { scope: "col", textContent: "Quantity" }),
    [...heads, ...more].map((text, index) => make("th", { scope: "col", class: `number${index === 0 ? " first" : index === 2 ? " largest" : ""}`, textContent: text })));
  return make("table", {}, make("thead", {}, head), make("tbody", {}, data.told.map((name) => row(name, data, reference, stated))));
}

function row(name, data, reference, stated) {
  const scalar = data.scalars[name], other = reference?.data.scalars[name];
  const unit = unitFor(scalar.unit, scalar.value), known = scalar.value.filter((value) => value !== null);
  const largest = known.reduce((best, value) => (Math.abs(value) > Math.abs(best) ? value : best), 0);
  const errors = scalar.error.filter((error) => error !== null), worst = errors.length ? Math.max(...errors) : null;
  const cell = (value, error, style = "") => make("td", { class: `number ${style}`, textContent: (scalar.mesh && value !== null ? "> " : "") + digits(value === null ? null : value / unit.factor, error === null ? null : error / unit.factor) });
  return make("tr", {}, make("th", { scope: "row" }, titleOf(name), make("small", { textContent: ` [${unit.symbol}]` })),
    cell(scalar.value[0], scalar.error[0], "first"), cell(scalar.value.at(-1), scalar.error.at(-1)), cell(largest, worst, "largest"),
    stated && make("td", { class: "number", textContent: errorTold(scalar, worst, largest, unit) }),
    reference && make("td", { class: "number", textContent: other ? digits(other.value.at(-1) === null ? null : other.value.at(-1) / unit.factor) : "–" }),
    reference && make("td", { class: "number", textContent: other ? change(scalar.value.at(-1), other.value.at(-1)) : "–" }));
}

function errorTold(scalar, worst, largest, unit) {
  if (scalar.mesh) return "depends on the mesh";
  if (worst === null) return "not known";
  const part = largest ? Math.abs(worst / largest) : 0;
  return worst > 0 ? `${bar(worst / unit.factor)} (${part < 1e-5 ? "< 0.001" : Number((100 * part).toPrecision(2))} %)` : "0";
}

function change(value, before) {
  if (!before || value === null) return "–";
  const part = 100 * (value / before - 1);
  return `${part < 0 ? "\u2212" : "+"}${Number(Math.abs(part).toPrecision(3))} %`;
}

function referenceTold(reference) {
  if (!reference) return [];
  return [make("span", { class: "key" }), `Dashed: ${reference.data.title}, ${reference.status.quality === "coarse" ? "coarse answer" : "full run"}`];
}

function downloads({ id, status }) {
  return DOWNLOADS.filter(([name]) => name !== "result.nc" || status.over).map(([name, text, saved]) =>
    make("a", { class: "button", href: `/api/runs/${id}/${name}`, textContent: text, download: saved ? "" : null, target: saved ? null : "_blank", rel: saved ? null : "noopener" }));
}
