// Fit of a law to a measurement: a force curve with its instrument, or tests of a material. The figures
// are made by the server.

import { changed, setValue } from "./draft.js";
import { definitions, items, make, place } from "./dom.js";
import { drawing } from "./drawings.js";
import { fileEntry } from "./fields.js";
import { plotly } from "./figures.js";
import { titleOf } from "./hints.js";
import { draw } from "./linked.js";
import { get, post, upload } from "./server.js";
import { isDark, onTheme } from "./theme.js";
import { chosenSystem } from "./units.js";

const LAWS = ["elastic", "maxwell", "zener", "burgers", "creep-series", "power-law", "power-law-with-instant"];
// Size of each tip: its name and an example.
const TIPS = { sphere: ["Radius", "5 um"], cone: ["Half angle", "70 deg"], pyramid: ["Angle from axis to face", "35 deg"], punch: ["Radius", "2 um"] };
const KINDS = { curve: "Force curve or indentation", adhesion: "Force curve of a sphere that sticks", material: "Tests of a material" };
const FILES = {
  curve: "JPK curve or map (map.jpk-force-map#12 is its curve 12), or a table with time, position and deflection or force, or with time, approach and force",
  adhesion: "approach and retraction of an elastic body: JPK curve, or a table with time, position and deflection or force",
  material: "creep, relaxation or oscillation (DMA), as a table; a column of temperatures makes sets, which are joined to a master curve",
};
// Of each field: label, example, description, and the kinds of measurement that it belongs to.
const FIELDS = {
  kind: ["Measurement", "", ""],
  file: ["File", "", FILES.curve],
  tip: ["Tip", "", "", "curve"],
  size: ["Radius", "5 um", "", "curve adhesion"],
  spring_constant: ["Spring constant", "0.1 N/m", "of the cantilever; files of instruments state their own", "curve adhesion"],
  sensitivity: ["Sensitivity", "50 nm/V", "of a deflection in volts", "curve adhesion"],
  law: ["Law", "", "", "curve"],
  data: ["Kind of test", "", "", "material"],
  reference: ["Reference", "23 degC", "temperature of the master curve; that of the set nearest to 20 °C if empty", "material"],
  shift: ["Shift", "", "in the law: the factors that are found, or a rule through them", "material"],
  vertical: ["Vertical shift", "", "of the moduli", "material"],
  terms: ["Terms", "1", "of a series; as many as the data need if empty", "curve material"],
  poisson_ratio: ["Poisson's ratio", "0.5", ""],
  bulk_modulus: ["Bulk modulus", "4 GPa", "in place of Poisson's ratio", "curve material"],
};
const CHOICES = {
  kind: KINDS, tip: named(Object.keys(TIPS)), law: named(LAWS),
  data: { "": "as the headings say", shear: "Shear (G, J)", uniaxial: "Uniaxial (E, D)", deviatoric: "Deviatoric (Φ)" },
  shift: { factors: "Factors", wlf: "WLF", arrhenius: "Arrhenius" },
  vertical: { "": "as the data need", none: "None", rubber: "Rubber, T/T_r", found: "Found" },
};
const ADDRESS = { curve: "/api/fit", adhesion: "/api/fit/adhesion", material: "/api/fit/material" };
// On narrow pages the panels of a drawing are placed below each other.
const phone = window.matchMedia("(max-width: 640px)");
let shown = null;

export function setUpFit() {
  const form = place("fit-form");
  form.append(...Object.keys(FIELDS).map(field), make("div", { class: "buttons" },
    make("button", { type: "submit", class: "main", id: "fit-go", textContent: "Fit" })));
  input("kind").addEventListener("change", () => showKind());
  input("file").addEventListener("input", () => recognise());
  showKind();
  input("tip").addEventListener("change", nameSize);
  form.addEventListener("submit", (event) => { event.preventDefault(); fit(); });
  place("fit-use").addEventListener("click", use);
  const box = place("fit");
  box.addEventListener("dragover", (event) => event.preventDefault());
  box.addEventListener("drop", (event) => { event.preventDefault(); take(event.dataTransfer.files[0]); });
  // The colours and units of the figures are made with them.
  onTheme(() => shown && fit());
  place("units").addEventListener("change", () => shown && fit());
}

// Takes a file that is on the server, for a kind of fit.
export function fitFile(name, kind) {
  place("fit").open = true;
  input("file").value = name;
  if (kind) showKind(kind);
  place("fit").scrollIntoView({ behavior: "smooth" });
}

const input = (name) => place(`fit-${name}`);
const isOf = (name, kind) => FIELDS[name][3]?.split(" ").includes(kind) ?? true;
function named(values) { return Object.fromEntries(values.map((value) => [value, titleOf(value)])); }

// Shows the fields of a kind of measurement.
function showKind(kind = input("kind").value) {
  input("kind").value = kind;
  for (const name of Object.keys(FIELDS)) input(name).closest(".field").hidden = !isOf(name, kind);
  input("file").closest(".field").querySelector(".description").textContent = FILES[kind];
  nameSize();
}

// The size is that of the tip, which is a sphere where its adhesion is fitted.
function nameSize() {
  const [label, example] = TIPS[input("kind").value === "adhesion" ? "sphere" : input("tip").value];
  place("fit-form").querySelector('label[for="fit-size"]').textContent = label;
  input("size").placeholder = `e.g. ${example}`;
}

// The kind of an uploaded file, by what it holds; none of a name that is being typed.
async function recognise() {
  const name = input("file").value.trim(), known = await get("/api/files").catch(() => []);
  if (!known.some((each) => each.name === name)) return;
  const { fit: kind } = await get(`/api/files/${encodeURIComponent(name)}/contents`).catch(() => ({}));
  // A curve may be one of a sphere that sticks, which its columns do not tell.
  const fits = kind === "curve" && input("kind").value === "adhesion";
  if (kind && !fits && input("file").value.trim() === name) showKind(kind);
}

function field(name) {
  const [label, example, about] = FIELDS[name], id = `fit-${name}`, choices = CHOICES[name];
  const control = choices
    ? make("select", { id }, Object.entries(choices).map(([value, textContent]) => make("option", { value, textContent, selected: value === "zener" })))
    : make("input", { id, type: "text", spellcheck: false, placeholder: example && `e.g. ${example}`, "aria-describedby": `${id}-problems` });
  return make("div", { class: "field" }, make("label", { htmlFor: id, textContent: label }),
    make("div", { class: "control" }, name === "file" ? fileEntry([], control) : control),
    about && make("p", { class: "description", textContent: about }),
    make("ul", { class: "problems", id: `${id}-problems` }));
}

async function take(file) {
  if (!file) return;
  try {
    input("file").value = (await upload(file)).name;
    complain([]);
    await recognise();
  } catch (error) {
    complain(error.problems ?? [{ message: String(error) }]);
  }
}

function complain(problems) {
  for (const name of Object.keys(FIELDS)) {
    const own = problems.filter(({ path }) => path === name);
    place(`fit-${name}-problems`).replaceChildren(...own.map(({ message }) => make("li", { textContent: message })));
    input(name).setAttribute("aria-invalid", String(own.length > 0));
  }
  const others = problems.filter(({ path }) => !(path in FIELDS));
  place("fit-problems").replaceChildren(...others.map(({ message }) => make("li", { textContent: message })));
}

async function fit() {
  const kind = input("kind").value, names = Object.keys(FIELDS).filter((name) => name !== "kind" && isOf(name, kind));
  const asked = Object.fromEntries(names.map((name) => [name, input(name).value.trim()]));
  if (kind === "curve") asked.terms = Number(asked.terms) || 1;
  const query = new URLSearchParams({ dark: isDark(), ...(kind === "curve" ? { units: chosenSystem() } : { narrow: phone.matches }) });
  const button = place("fit-go");
  button.disabled = true;
  button.textContent = "Fitting…";
  try {
    const [found] = await Promise.all([post(`${ADDRESS[kind]}?${query}`, asked), plotly()]);
    complain([]);
    show(found);
  } catch (error) {
    if (!error.problems) throw error;
    shown = null;
    place("fit-result").hidden = true;
    complain(error.problems);
  } finally {
    button.disabled = false;
    button.textContent = "Fit";
  }
}

function show(found) {
  shown = found;
  place("fit-result").hidden = false;
  place("fit-use").textContent = found.adhesion ? "Use as material and adhesion" : "Use as the material";
  place("fit-notes").replaceChildren(...found.warnings.map((text) => make("p", { class: "note warm", textContent: text })));
  const { confidence } = found.parameters[0], head = ["Parameter", "Value", ...(confidence ? [`${confidence} interval`] : [])];
  place("fit-parameters").replaceChildren(table(head, found.parameters.map(({ name, value, interval }) => [titleOf(name), value, ...(confidence ? [interval] : [])])));
  showShifts(found.shifts);
  place("fit-residual").textContent = `Residual: ${found.residual}`;
  place("fit-contact-facts").hidden = !found.contact.length;
  place("fit-facts").replaceChildren(...definitions(found.contact));
  const boxes = found.figures.map(({ layout }) => make("div", { class: "panel" },
    make("h4", {}, make("b", { textContent: layout.meta.title }), make("span", { textContent: layout.meta.note })),
    make("div", { class: "plot" })));
  place("fit-figures").replaceChildren(...boxes);
  found.figures.forEach((figure, index) => draw(boxes[index].querySelector(".plot"), figure));
  place("fit-drawings").replaceChildren(...(found.drawings ?? []).map(drawing));
}

function table(head, rows) {
  return make("table", {},
    make("thead", {}, make("tr", {}, head.map((text) => make("th", { scope: "col", textContent: text })))),
    make("tbody", {}, rows.map(([first, ...others]) => make("tr", {},
      make("th", { scope: "row", textContent: first }), others.map((textContent) => make("td", { textContent }))))));
}

function showShifts(shifts) {
  place("fit-shifts").hidden = !shifts;
  if (!shifts) return;
  place("fit-shifts-title").textContent = shifts.title;
  place("fit-shift-table").replaceChildren(table(shifts.head, shifts.rows));
  place("fit-shift-notes").replaceChildren(...items(shifts.notes));
}

function use() {
  setValue(["material"], shown.material);
  if (shown.adhesion) setValue(["adhesion"], shown.adhesion);
  changed("structure");
}
