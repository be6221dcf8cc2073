// Fit of a law to a force curve: its file, its instrument, and the figures made by the server.

import { changed, setValue } from "./draft.js";
import { definitions, make, place } from "./dom.js";
import { fileEntry } from "./fields.js";
import { plotly } from "./figures.js";
import { titleOf } from "./hints.js";
import { draw } from "./linked.js";
import { post, upload } from "./server.js";
import { isDark, onTheme } from "./theme.js";
import { chosenSystem } from "./units.js";

const LAWS = ["elastic", "maxwell", "zener", "burgers", "creep-series", "power-law", "power-law-with-instant"];
// Size of each tip: its name and an example.
const TIPS = { sphere: ["Radius", "5 um"], cone: ["Half angle", "70 deg"], pyramid: ["Angle from axis to face", "35 deg"], punch: ["Radius", "2 um"] };
const FIELDS = {
  file: ["File", "", "JPK curve or map (map.jpk-force-map#12 is its curve 12), or a table with time, position and deflection or force, or with time, approach and force"],
  tip: ["Tip", "", ""],
  size: ["Radius", "5 um", ""],
  spring_constant: ["Spring constant", "0.1 N/m", "of the cantilever; files of instruments state their own"],
  sensitivity: ["Sensitivity", "50 nm/V", "of a deflection in volts"],
  law: ["Law", "", ""],
  terms: ["Terms", "1", "of a creep series"],
  poisson_ratio: ["Poisson's ratio", "0.5", ""],
  bulk_modulus: ["Bulk modulus", "4 GPa", "in place of Poisson's ratio"],
};
let shown = null;

export function setUpFit() {
  const form = place("fit-form");
  form.append(...Object.keys(FIELDS).map(field), make("div", { class: "buttons" },
    make("button", { type: "submit", class: "main", id: "fit-go", textContent: "Fit" })));
  const size = form.querySelector('label[for="fit-size"]');
  input("tip").addEventListener("change", () => {
    [size.textContent, input("size").placeholder] = TIPS[input("tip").value];
  });
  form.addEventListener("submit", (event) => { event.preventDefault(); fit(); });
  place("fit-use").addEventListener("click", use);
  const box = place("fit");
  box.addEventListener("dragover", (event) => event.preventDefault());
  box.addEventListener("drop", (event) => { event.preventDefault(); take(event.dataTransfer.files[0]); });
  // The colours and units of the figures are made with them.
  onTheme(() => shown && fit());
  place("units").addEventListener("change", () => shown && fit());
}

// Takes a file that is on the server.
export function fitFile(name) {
  place("fit").open = true;
  input("file").value = name;
  place("fit").scrollIntoView({ behavior: "smooth" });
}

const input = (name) => place(`fit-${name}`);

function field(name) {
  const [label, example, about] = FIELDS[name], id = `fit-${name}`;
  const choices = { tip: Object.keys(TIPS), law: LAWS }[name];
  const control = choices
    ? make("select", { id }, choices.map((value) => make("option", { value, textContent: titleOf(value), selected: value === "zener" })))
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
  const asked = Object.fromEntries(Object.keys(FIELDS).map((name) => [name, input(name).value.trim()]));
  asked.terms = Number(asked.terms) || 1;
  const query = new URLSearchParams({ dark: isDark(), units: chosenSystem() });
  const button = place("fit-go");
  button.disabled = true;
  button.textContent = "Fitting…";
  try {
    const [found] = await Promise.all([post(`/api/fit?${query}`, asked), plotly()]);
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
  place("fit-notes").replaceChildren(...found.warnings.map((text) => make("p", { class: "note warm", textContent: text })));
  const head = ["Parameter", "Value", `${found.parameters[0].confidence} interval`];
  place("fit-parameters").replaceChildren(make("table", {},
    make("thead", {}, make("tr", {}, head.map((text) => make("th", { scope: "col", textContent: text })))),
    make("tbody", {}, found.parameters.map(({ name, value, interval }) => make("tr", {},
      make("th", { scope: "row", textContent: titleOf(name) }), make("td", { textContent: value }), make("td", { textContent: interval }))))));
  place("fit-residual").textContent = `Residual: ${found.residual}`;
  place("fit-contact-facts").hidden = !found.contact.length;
  place("fit-facts").replaceChildren(...definitions(found.contact));
  const boxes = found.figures.map(({ layout }) => make("div", { class: "panel" },
    make("h4", {}, make("b", { textContent: layout.meta.title }), make("span", { textContent: layout.meta.note })),
    make("div", { class: "plot" })));
  place("fit-figures").replaceChildren(...boxes);
  found.figures.forEach((figure, index) => draw(boxes[index].querySelector(".plot"), figure));
}

function use() {
  setValue(["material"], shown.material);
  changed("structure");
}
