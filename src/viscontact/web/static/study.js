// Studies of the case in the form: several values of its keys, or the values of the best result.

import { caseValues, dotted, draft, renew } from "./draft.js";
import { make, place, settled, write } from "./dom.js";
import { titleOf } from "./hints.js";
import { startStudy } from "./runs.js";
import { leaves, unitsOf, wholeCase } from "./schema.js";

const KINDS = { sweep: "Several values", design: "Best values" };
const ABOUT = {
  sweep: "Values with commas between them, or a range with a colon, on which the runs are spread. Of several keys, all combinations.",
  design: "A range for each key, or values to choose from. Found are those for which the result is least or largest.",
};
// Sections that are no part of the physics, and none of a design.
const NEVER = ["title", "output", "report", "schema"], NO_DESIGN = ["grid", "time"];
const MOST_KEYS = 4;
const SENSES = { minimise: "Least", maximise: "Largest" };
const KEPT = "viscontact.study";
const begin = () => ({ kind: "sweep", keys: [{ key: "", values: "" }], quality: "full", sense: "minimise", goal: "peak_pressure", limits: [], runs: "" });

let asked = begin();
let scalars = [];
let complain = () => {};

export function setUpStudy(known, onError) {
  scalars = known;
  complain = onError;
  try { asked = { ...asked, ...JSON.parse(sessionStorage.getItem(KEPT)) }; } catch { /* nothing is kept */ }
  const form = place("study-form");
  form.addEventListener("submit", (event) => { event.preventDefault(); study().catch(complain); });
  form.addEventListener("input", keep);
  drawForm();
  const renewed = settled(offerKeys, 300);
  for (const event of ["values", "replaced", "structure"]) draft.addEventListener(event, renewed);
}

// Sends the study; its problems are shown at its fields.
export async function study() {
  const button = place("study-go");
  button.disabled = true;
  try {
    await renew();
    await startStudy(requested());
    showProblems([]);
    place("answer").scrollIntoView({ behavior: "smooth", block: "nearest" });
  } catch (error) {
    if (error.status !== 422) throw error;
    place("study").open = true;
    showProblems(error.problems);
  } finally {
    button.disabled = false;
  }
}

function requested() {
  const { kind, keys, quality, sense, goal, limits, runs } = asked;
  if (kind === "sweep") return { kind, keys, quality, runs: hasRange() ? runs : "" };
  return { kind, keys, sense, goal, runs, constraints: limits.map(({ scalar, sign, bound }) => `${scalar}${sign}${bound}`) };
}

const hasRange = () => asked.keys.some(({ values }) => isRange(values));

// A range has colons outside brackets and quotes, which begin a value; as the server reads it.
function isRange(text) {
  let depth = 0, quote = "", isBegin = true;
  for (const letter of text) {
    if (quote) quote = letter === quote ? "" : quote;
    else if (isBegin && "\"'".includes(letter)) [quote, isBegin] = [letter, false];
    else {
      depth += "[{".includes(letter) - "]}".includes(letter);
      if (letter === ":" && depth === 0) return true;
      isBegin = (letter === "," && depth === 0) || (isBegin && !letter.trim());
    }
  }
  return false;
}

function keep() {
  try { sessionStorage.setItem(KEPT, JSON.stringify(asked)); } catch { /* storage is disabled */ }
}

function change(values) {
  Object.assign(asked, values);
  keep();
  drawForm();
}

function drawForm() {
  const focused = document.activeElement?.id, isSweep = asked.kind === "sweep";
  const switches = Object.entries(KINDS).map(([kind, text]) => make("button", {
    type: "button", id: `study-as-${kind}`, "aria-pressed": String(kind === asked.kind), textContent: text, onclick: () => change({ kind }),
  }));
  const parts = [
    make("div", { class: "switch", role: "group", "aria-label": "Kind of study" }, switches),
    make("p", { class: "description", textContent: ABOUT[asked.kind] }),
    make("ul", { class: "problems", "data-field": "" }),
    !isSweep && goalField(), ...asked.keys.map(keyRow),
    adder("study-add-key", "Add a key", asked.keys.length < MOST_KEYS && (() => change({ keys: [...asked.keys, { key: "", values: "" }] }))),
    ...(isSweep ? [] : [...asked.limits.map(limitRow), adder("study-add-limit", "Add a limit", () => change({ limits: [...asked.limits, { scalar: "peak_pressure", sign: "<=", bound: "" }] }))]),
    isSweep && qualityField(), runsField(),
    make("div", { class: "buttons" }, make("button", { type: "submit", class: "main", id: "study-go", textContent: "Study" })),
  ];
  place("study-form").replaceChildren(...parts.filter(Boolean));
  offerKeys();
  if (focused?.startsWith("study-")) place(focused)?.focus({ preventScroll: true });
}

const adder = (id, text, act) => act && make("button", { type: "button", class: "add", id, textContent: text, onclick: act });
const option = (value, textContent, selected) => make("option", { value, textContent, selected });

function field(id, label, controls, { about = "", at = "" } = {}) {
  return make("div", { class: "field" }, make("label", { htmlFor: id, textContent: label }),
    make("div", { class: "control" }, controls), about && make("p", { class: "description", textContent: about }),
    make("ul", { class: "problems", "data-field": at, id: `${id}-problems` }));
}

// Texts of quantities are read by the server, in the words of the command line.
function entry(id, value, about, set) {
  return make("input", {
    id, type: "text", value, spellcheck: false, ...about, "aria-describedby": `${id}-problems`,
    oninput: (event) => set(event.target.value),
  });
}

const remover = (what, act) => make("button", {
  type: "button", class: "quiet", textContent: "×", title: `Remove this ${what}`, "aria-label": `Remove this ${what}`, onclick: act,
});

function keyRow(row, index, { length }) {
  const id = `study-key-${index + 1}`, without = () => change({ keys: asked.keys.filter((each) => each !== row) });
  const select = make("select", { id, "aria-label": `Key ${index + 1}`, "data-key": index, onchange: () => { row.key = select.value; keep(); offerKeys(); } });
  const values = entry(`${id}-values`, row.values, { "aria-label": `Values of key ${index + 1}` }, (text) => { row.values = text; place("study-runs-field").hidden = isIdle(); });
  return field(id, length > 1 ? `Key ${index + 1}` : "Key", [select, values, length > 1 && remover("key", without)], { at: `keys[${index + 1}]`, about: " " });
}

function limitRow(row, index) {
  const id = `study-limit-${index + 1}`, without = () => change({ limits: asked.limits.filter((each) => each !== row) });
  const select = make("select", { id, onchange: () => { row.scalar = select.value; keep(); } }, scalarOptions(row.scalar));
  const sign = make("select", { class: "sign", "aria-label": "At most or at least", onchange: () => { row.sign = sign.value; keep(); } },
    option("<=", "≤", row.sign === "<="), option(">=", "≥", row.sign === ">="));
  const bound = entry(`${id}-bound`, row.bound, { "aria-label": `Value of limit ${index + 1}`, placeholder: "e.g. 1.2 MPa" }, (text) => { row.bound = text; });
  return field(id, "Limit", [select, sign, bound, remover("limit", without)], { at: `constraints[${index + 1}]`, about: index ? "" : "kept at all instants" });
}

function goalField() {
  const sense = make("select", { class: "sign", "aria-label": "Least or largest", onchange: () => { asked.sense = sense.value; keep(); } },
    Object.entries(SENSES).map(([value, text]) => option(value, text, value === asked.sense)));
  const goal = make("select", { id: "study-goal", onchange: () => { asked.goal = goal.value; keep(); } });
  return field("study-goal", "Result", [sense, goal], { at: "goal", about: "the worst value of the run, or one of the keys below, as the thinnest cover that keeps a limit" });
}

function scalarOptions(chosen) {
  const group = (label, isChief) => make("optgroup", { label },
    scalars.filter(({ chief }) => chief === isChief).map(({ name, label: text }) => option(name, text, name === chosen)));
  return [group("Chief results", true), group("Other results", false)];
}

function qualityField() {
  const select = make("select", { id: "study-quality", onchange: () => { asked.quality = select.value; keep(); } },
    option("full", "as in the case, with error bars", asked.quality === "full"),
    option("coarse", "coarse: fewer cells and steps", asked.quality === "coarse"));
  return field("study-quality", "Cells and steps", select);
}

const isIdle = () => asked.kind === "sweep" && !hasRange();

function runsField() {
  const [label, usual, about] = asked.kind === "sweep" ? ["Runs", "8", "spread over the ranges"] : ["Most runs", "60", ""];
  const box = field("study-runs", label, entry("study-runs", asked.runs, { placeholder: usual, inputMode: "numeric" }, (text) => { asked.runs = text; }), { at: "runs", about });
  box.id = "study-runs-field";
  box.hidden = isIdle();
  return box;
}

// The keys of the present case, in the sections of the form.
function offerKeys() {
  const left = asked.kind === "design" ? [...NEVER, ...NO_DESIGN] : NEVER;
  const found = leaves(wholeCase(), caseValues()).filter(({ path, node }) => !left.includes(path[0]) && !["lines", "mapping"].includes(node.kind));
  const known = new Map(found.map((each) => [dotted(each.path), each]));
  for (const select of place("study-form").querySelectorAll("select[data-key]")) {
    const row = asked.keys[select.dataset.key];
    select.replaceChildren(...keyOptions(known, row.key));
    select.value = row.key;
    describe(row.key, known.get(row.key), select);
  }
  const goal = place("study-goal");
  if (!goal) return;
  const own = asked.keys.map(({ key }) => key).filter(Boolean);
  const keys = own.length > 0 && make("optgroup", { label: "Keys that are changed" }, own.map((key) => option(key, wordsOf(key), key === asked.goal)));
  goal.replaceChildren(...scalarOptions(asked.goal), ...(keys ? [keys] : []));
  if (!goal.value) { goal.value = "peak_pressure"; asked.goal = goal.value; }
}

function keyOptions(known, chosen) {
  const groups = new Map();
  for (const each of known.values()) {
    const { path, value } = each;
    const label = value === undefined ? `${titleOf(path[0])}, not set` : path.length > 1 ? titleOf(path[0]) : "Case";
    groups.set(label, [...(groups.get(label) ?? []), each]);
  }
  const boxes = [...groups].sort(([a], [b]) => a.endsWith("not set") - b.endsWith("not set")).map(([label, entries]) => make("optgroup", { label },
    entries.map(({ path, value }) => option(dotted(path), textOf(path, value)))));
  const strange = chosen && !known.has(chosen) && option(chosen, `${chosen} (not in the case)`);
  return [option("", "choose a key…"), ...(strange ? [strange] : []), ...boxes];
}

function textOf(path, value) {
  const words = path.length > 1 ? path.slice(1) : path;
  const name = words.map((step) => (typeof step === "number" ? step + 1 : titleOf(step))).join(" ");
  return value === undefined ? name : `${name}: ${value}`;
}

const wordsOf = (key) => key.split(".").map(titleOf).join(", ");

// An example with the unit of the key, and its value in the case.
function describe(key, found, select) {
  const box = select.closest(".field"), values = box.querySelector("input");
  const { value, node } = found ?? {}, text = String(value ?? node?.examples[0] ?? "");
  const [, number, unit] = text.match(/^\s*(\d*\.?\d+(?:e[+-]?\d+)?)\s*(.*)$/i) ?? [];
  const sized = (factor) => `${Number((number * factor).toPrecision(3))} ${unit}`.trim();
  const options = node?.options ?? node?.named;
  values.placeholder = number === undefined ? (options ? `e.g. ${options.slice(0, 2).join(", ")}` : "")
    : asked.kind === "design" ? `e.g. ${sized(0.5)}:${sized(2)}` : `e.g. ${sized(0.5)}, ${sized(1)}, ${sized(2)}`;
  const units = node?.dimension ? unitsOf(node.dimension) : [];
  write(box.querySelector(".description"), [value !== undefined && `now ${value}`, units.length > 1 && `units: ${units.slice(0, 6).join(", ")}`].filter(Boolean).join("; "));
}

function showProblems(problems) {
  const form = place("study-form"), lists = [...form.querySelectorAll("[data-field]")];
  for (const list of lists) {
    list.replaceChildren();
    list.closest(".field")?.querySelectorAll("input, select").forEach((each) => each.removeAttribute("aria-invalid"));
  }
  for (const { path, message } of problems) {
    const list = lists.find(({ dataset }) => dataset.field === path) ?? lists[0];
    list.append(make("li", { textContent: message }));
    const box = list.closest(".field");
    (box?.querySelector("input") ?? [...(box?.querySelectorAll("select") ?? [])].at(-1))?.setAttribute("aria-invalid", "true");
  }
  const first = form.querySelector("[aria-invalid]");
  first?.focus({ preventScroll: true });
  (first ?? lists[0]).scrollIntoView({ block: "nearest" });
}
