// Entry point of the page: sets up all parts and connects their events.

import { check, checked, look, refuse, setUpChecking } from "./checking.js";
import {
  caseText, caseValues, changed, draft, isRead, keptText, renew, replaceText, setValue,
  useExampleTitles, valueAt,
} from "./draft.js";
import { make, place, settled } from "./dom.js";
import { draw, placeDrawings, setUpDrawings } from "./drawings.js";
import { setUpFigures } from "./figures.js";
import { fitFile, setUpFit } from "./fit.js";
import { drawForm, useMaterials } from "./form.js";
import { START } from "./hints.js";
import { goToProblem } from "./problems.js";
import { drawList, drawProgress, setUpProgress } from "./progress.js";
import { drawResults } from "./results.js";
import { findAgain, list, refer, runs, start, state } from "./runs.js";
import { setUpStudy, study } from "./study.js";
import { drawStudy } from "./study_answer.js";
import { useSchema } from "./schema.js";
import { connection, get, isAboutCase, upload } from "./server.js";
import { onTheme, setUpTheme } from "./theme.js";
import { systemNames, useSystem, useUnits } from "./units.js";

let examples = [];
// Whether the next answer was requested on this page, so that the page scrolls to it.
let arriving = false;
const narrow = window.matchMedia("(max-width: 860px)");

function complain(error) {
  if (error.name === "AbortError") return;
  if (!error.problems) throw error;
  notify(error.problems.map(({ path, message }) => [path, message].filter(Boolean).join(": ")).join("\n"));
}

// A line at the foot of the page, with an undo button where possible.
function notify(text, undo = null) {
  const close = () => place("notice").replaceChildren();
  place("notice").replaceChildren(make("p", {}, text,
    undo && make("button", { type: "button", class: "small", textContent: "Undo", onclick: () => { close(); undo(); } }),
    make("button", { type: "button", class: "small", textContent: "Close", onclick: close })));
  if (undo) setTimeout(close, 6000);
}

async function write(yaml, how) {
  try {
    await replaceText(yaml, how);
    await Promise.all([look(), draw()]);
  } catch (error) {
    refuse(error);
  }
}

async function load(yaml, name) {
  const back = caseText();
  await write(yaml);
  notify(`Loaded: ${name}.`, () => write(back));
}

// Opens a case with the files that it names, or takes files with data to where a case has them.
async function openFiles(files) {
  const texts = await Promise.all(files.map((each) => (/\.ya?ml$/i.test(each.name) ? each.text() : "")));
  // A law of its own is a file that a case names.
  const isCase = texts.map((text, index) => /\.ya?ml$/i.test(files[index].name) && (files.length === 1 || /^(indenter|load) *:/m.test(text)));
  const opened = files[isCase.indexOf(true)], others = files.filter((each) => each !== opened);
  const names = [];
  for (const each of others) names.push((await upload(each)).name);
  if (opened) { await load(await opened.text(), opened.name); return; }
  for (const name of names) {
    const { holds, path, section, fit } = await get(`/api/files/${encodeURIComponent(name)}/contents`);
    if (!section) { fitFile(name, fit); notify(`${name}: ${holds}, for the fit below.`); continue; }
    const back = caseText();
    // A material keeps what its table does not state.
    const { poisson_ratio: ratio } = valueAt(path) ?? {};
    setValue(path, path[0] === "material" && ratio !== undefined ? { ...section, poisson_ratio: ratio } : section);
    changed("structure");
    notify(`${name}: ${holds}, now the ${path[0]} of the case.`, () => write(back));
  }
}

function redrawForm() {
  drawForm(place("form"));
  placeDrawings();
}

function drawStale() {
  const shown = state.shown;
  const changed = shown && shown.yaml.trim() !== caseText().trim();
  place("stale").hidden = !changed;
  place("keep").hidden = !shown || state.reference?.id === shown.id;
  place("unkeep").hidden = !state.reference;
}

function drawButtons() {
  const refused = check.problems.length > 0;
  for (const name of ["coarse", "refine"]) place(name).setAttribute("aria-disabled", String(refused));
}

async function begin(quality) {
  if (check.problems.length) { goToProblem(place("form")); return; }
  try {
    await renew();
    await start(quality);
    arriving = true;
    if (!narrow.matches) place("answer").scrollIntoView({ behavior: "smooth", block: "start" });
  } catch (error) {
    if (isAboutCase(error)) refuse(error);
    complain(error);
  }
}

// On a narrow page the buttons are always visible.
function bringIntoSight() {
  const top = place("results").getBoundingClientRect().top;
  if (narrow.matches) place("results").scrollIntoView();
  else if (top > 0.4 * window.innerHeight) place("answer").scrollIntoView({ behavior: "smooth", block: "start" });
}

function setUpCase() {
  const select = place("examples");
  select.append(...examples.map(({ name, title }) => make("option", { value: name, textContent: title })));
  select.addEventListener("change", () => {
    const { yaml, title } = examples.find(({ name }) => name === select.value);
    select.value = "";
    load(yaml, title);
  });
  const file = place("open-file");
  place("open").addEventListener("click", () => file.click());
  file.addEventListener("change", () => {
    const chosen = [...file.files];
    file.value = "";
    openFiles(chosen).catch(complain);
  });
  place("save").addEventListener("click", () => {
    const address = URL.createObjectURL(new Blob([caseText()], { type: "application/yaml" }));
    make("a", { href: address, download: "case.yaml" }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  });
  const text = place("yaml");
  text.addEventListener("input", settled(() => write(text.value, { edited: true }), 500));
  draft.addEventListener("text", () => {
    if (document.activeElement !== text) text.value = caseText();
    drawStale();
  });
  draft.addEventListener("titled", showTitle);
  place("form").addEventListener("focusout", (event) => {
    if (event.target.id === "field-title") setTimeout(showTitle);
  });
  for (const mode of ["form", "text"]) place(`as-${mode}`).addEventListener("click", () => choose(mode));
}

// Shows a title derived from the case, unless the field has the focus.
function showTitle() {
  const input = place("field-title"), title = caseValues().title ?? "";
  if (input && input !== document.activeElement && input.value !== title) input.value = title;
}

function choose(mode) {
  if (mode === "form" && !isRead()) {
    notify("The form is shown when the YAML is valid.");
    return;
  }
  for (const each of ["form", "text"]) place(`as-${each}`).setAttribute("aria-pressed", String(each === mode));
  place("form").hidden = mode !== "form";
  place("text").hidden = mode !== "text";
  place("yaml").value = caseText();
}

// Removes the grid: an automatic one suits any shape, a roller's grid does not suit a ball.
function withoutGrid(yaml) {
  return yaml.replace(/^grid:.*\n(?:[ #].*\n)*/m, "");
}

function setUpUnits() {
  const select = place("units"), key = "viscontact.units";
  select.append(...systemNames().map(([value, textContent]) => make("option", { value, textContent })));
  try { select.value = localStorage.getItem(key) ?? "auto"; } catch { /* storage is disabled */ }
  if (!select.value) select.value = "auto";
  useSystem(select.value);
  select.addEventListener("change", () => {
    try { localStorage.setItem(key, select.value); } catch { /* storage is disabled */ }
    useSystem(select.value);
    drawResults();
    drawStudy(load).catch(complain);
  });
}

function setUpRuns() {
  place("coarse").addEventListener("click", () => begin("coarse"));
  place("refine").addEventListener("click", () => begin("full"));
  place("to-problem").addEventListener("click", () => { choose("form"); goToProblem(place("form")); });
  place("keep").addEventListener("click", () => refer(state.shown.id).catch(complain));
  place("unkeep").addEventListener("click", () => refer(null));
  document.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) begin(event.shiftKey ? "full" : "coarse");
  });
  const redraw = () => { drawStale(); drawList({ load, complain }); return drawResults(); };
  runs.addEventListener("active", drawProgress);
  runs.addEventListener("shown", () => {
    redraw();
    if (arriving && state.shown?.id === state.active?.id) bringIntoSight();
    arriving = false;
  });
  runs.addEventListener("reference", redraw);
  runs.addEventListener("listed", () => drawList({ load, complain }));
  runs.addEventListener("study", () => { drawList({ load, complain }); drawStudy(load).catch(complain); });
  checked.addEventListener("change", drawButtons);
  window.addEventListener("focus", () => list());
  onTheme(() => { draw(); drawResults(); drawStudy(load).catch(complain); });
}

function setUpConnection() {
  const notices = { gone: "offline", locked: "locked" };
  const only = (how) => { for (const [each, id] of Object.entries(notices)) place(id).hidden = each !== how; };
  for (const how of Object.keys(notices)) connection.addEventListener(how, () => only(how));
  connection.addEventListener("back", () => {
    only("");
    renew().then(() => Promise.all([look(), draw()])).catch(refuse);
  });
}

async function open() {
  // The browser has a cookie now: the token is not kept in its history and bookmarks.
  if (location.search) history.replaceState(null, "", location.pathname + location.hash);
  setUpConnection();
  document.body.addEventListener("refused", ({ detail }) => complain(detail));
  const answers = ["schema", "examples", "materials", "units", "scalars"].map((name) => get(`/api/${name}`));
  const [schema, shipped, materials, units, scalars] = await Promise.all(answers);
  examples = shipped;
  useSchema(schema);
  useExampleTitles(examples.map(({ title }) => title));
  useMaterials(materials);
  useUnits(units);
  setUpTheme();
  setUpUnits();
  setUpFigures();
  setUpDrawings();
  setUpCase();
  setUpChecking();
  setUpFit();
  setUpStudy(scalars, complain);
  setUpProgress(complain, study);
  setUpRuns();
  draft.addEventListener("replaced", redrawForm);
  draft.addEventListener("structure", redrawForm);
  const first = examples.find(({ name }) => name === START) ?? examples[0];
  await Promise.all([write(keptText() ?? withoutGrid(first.yaml)), findAgain()]);
  if (!isRead()) choose("text");
  document.documentElement.dataset.ready = "yes";
}

open().catch((error) => {
  if (error.status !== 401) place("offline").hidden = false;
  if (!error.problems) throw error;
  connection.addEventListener("back", () => location.reload());
});
