// Results of a run: numbers with errors, pressure, histories, downloads.

import { definitions, items, make, place, write } from "./dom.js";
import { drawFigures } from "./figures.js";
import { largestAt, numbersTable } from "./numbers.js";
import { state } from "./runs.js";
import { placeText, quantityText } from "./units.js";

// Downloads: path, title, and whether the file is saved or opened.
const DOWNLOADS = [
  ["case.yaml", "Case (YAML)", true],
  ["report.html", "Report (HTML)", true],
  ["report.html?view=1", "Open the report", false],
  ["result.nc", "Result (netCDF)", true],
  ["history.csv", "Histories (CSV)", true],
];
const COARSE = "Fewer cells and steps than in the case, and no error bars. "
  + "Refine to compute the case as written.";

const WITHOUT_BARS = "All steps are computed; the error bars are being estimated and will be added.";

const qualityOf = (run) => (run.status.quality === "coarse" ? "coarse answer" : "full run");

export async function drawResults() {
  const shown = state.shown;
  place("results").hidden = !shown;
  if (!shown) return;
  const { data, status } = shown, kept = state.reference?.id === shown.id ? null : state.reference;
  const reference = kept?.data.axis.name === data.axis.name ? kept : null;
  write(place("result-title"), status.label);
  write(place("quality"), qualityOf(shown));
  place("quality").className = `chip ${status.quality}`;
  place("result-notes").replaceChildren(...notes(status, data));
  drawFacts(data);
  place("numbers").replaceChildren(numbersTable(data, reference));
  place("reference-text").replaceChildren(...referenceText(kept, data));
  place("downloads").replaceChildren(...downloads(shown));
  place("accuracy").replaceChildren(...definitions(data.accuracy));
  if (isEarly(status)) document.documentElement.dataset.early = shown.id;
  await drawFigures(shown, reference);
  if (!isEarly(status)) document.documentElement.dataset.drawn = shown.id;
}

// Shown before its error bars.
const isEarly = (status) => status.stage === "errors" && !status.over;

function notes(status, data) {
  const note = (text, style = "") => make("p", { class: `note ${style}`, textContent: text });
  // For a run that stopped early, the notes state where it ended.
  const parts = [status.quality === "coarse" && note(COARSE), isEarly(status) && note(WITHOUT_BARS), status.state === "failed" && note(status.message)];
  parts.push(...status.verdicts.map(({ verdict, text }) => note(`${verdict}: ${text}`, verdict === "passed" ? "" : "warm")));
  parts.push(...data.notices.map((text) => note(text, "warm")));
  if (data.warnings.length) parts.push(warned(data.warnings));
  return parts.filter(Boolean);
}

// The first few warnings are shown, the others are folded.
const FEW = 3;
function warned(warnings) {
  const count = warnings.length > FEW + 1 ? FEW : warnings.length, rest = warnings.slice(count);
  return make("div", { class: "note warm" },
    make("p", { textContent: "Warnings of this run:" }), make("ul", {}, items(warnings.slice(0, count))),
    rest.length > 0 && make("details", {},
      make("summary", { textContent: `${rest.length} more warnings` }), make("ul", {}, items(rest))));
}

// The end of the run, or the instant of the largest contact if it is lost at the end.
function factsIndex(data) {
  const areas = data.scalars.contact_area.value;
  return areas.at(-1) > 0 ? areas.length - 1 : areas.indexOf(Math.max(...areas));
}

function factsPlace(data) {
  const { name, values } = data.axis, many = values.length > 1;
  if (name === "speed" && many) return "Largest values over the speeds, each with its speed";
  const index = name === "speed" ? 0 : factsIndex(data), at = `At ${placeText(data.axis, values[index])}`;
  return index === values.length - 1 ? at : `${at}, when the contact is largest`;
}

function drawFacts(data) {
  const isWorst = data.axis.name === "speed", where = isWorst && data.axis.values.length > 1;
  write(place("facts-when"), factsPlace(data));
  place("facts").replaceChildren(...Object.entries(data.facts).map(([name, label]) => {
    const { value, error, unit, mesh } = data.scalars[name], index = isWorst ? largestAt(value) : factsIndex(data);
    const [number, half] = quantityText(value[index], error[index], unit, mesh[index]).split(" ± ");
    return make("div", {}, make("dt", { textContent: label }),
      make("dd", {}, [number, half?.split(" ")[1]].filter(Boolean).join(" "),
        half && make("small", { textContent: `± ${half}` }),
        where && make("small", { textContent: `at ${placeText(data.axis, data.axis.values[index])}` }),
        worstTexts(data, name).map((textContent) => make("small", { textContent }))));
  }));
}

// The range of the last cycle, and the largest value of the run with its instant.
function worstTexts(data, name) {
  const { value, error, unit, mesh } = data.scalars[name], { cycle, largest } = data.worst[name];
  const text = (index) => quantityText(value[index], error[index], unit, mesh[index]);
  const texts = cycle ? [`last cycle: ${cycle.map(text).join(" to ")}`] : [];
  if (largest !== null) texts.push(`largest: ${text(largest)} at ${placeText(data.axis, data.axis.values[largest])}`);
  return texts;
}

function referenceText(reference, data) {
  if (!reference) return [];
  const { axis } = reference.data;
  if (axis.name !== data.axis.name)
    return [`Not compared: ${reference.status.label} is over ${axis.name}, this result over ${data.axis.name}.`];
  return [make("span", { class: "key" }), `Dashed: ${reference.status.label}, ${qualityOf(reference)}`];
}

function downloads({ id, status }) {
  const there = DOWNLOADS.filter(([name]) => name !== "result.nc" || status.over);
  return there.map(([name, text, saved]) => make("a", {
    class: "button", href: `/api/runs/${id}/${name}`, textContent: text,
    ...(saved ? { download: "" } : { target: "_blank", rel: "noopener" }),
  }));
}
