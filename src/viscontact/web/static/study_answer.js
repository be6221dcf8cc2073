// Answer of a study: its figures, the table of its runs, and its files.

import { make, place, write } from "./dom.js";
import { drawing } from "./drawings.js";
import { plotly } from "./figures.js";
import { draw } from "./linked.js";
import { state } from "./runs.js";
import { get } from "./server.js";
import { isDark } from "./theme.js";
import { chosenSystem } from "./units.js";

const DOWNLOADS = [["table.csv", "Table (CSV)", true], ["report.html", "Report (HTML)", true], ["report.html?view=1", "Open the report", false]];

let latest = null;
let drawn = "";

// Draws the study that is shown again when more of its runs are finished. `load` writes a case into
// the form.
export async function drawStudy(load) {
  const shown = state.study;
  place("study-result").hidden = !shown;
  if (!shown) { drawn = ""; return; }
  const { id, status } = shown, query = new URLSearchParams({ dark: isDark(), units: chosenSystem() });
  write(place("study-title"), status.label);
  const what = `${id} ${status.step} ${status.over} ${query}`;
  if (!status.study.has_answer || what === drawn || what === latest) return;
  latest = what;
  try {
    const [answer] = await Promise.all([get(`/api/studies/${id}?${query}`), plotly()]);
    if (latest !== what) return;
    drawn = what;
    drawAnswer(id, status, answer, load);
    document.documentElement.dataset.studied = status.over ? id : "";
  } finally {
    if (latest === what) latest = null;
  }
}

function drawAnswer(id, status, answer, load) {
  write(place("study-headline"), answer.headline);
  place("study-notes").replaceChildren(...notes(status, answer.notes));
  drawPanels(answer.figures);
  place("study-drawings").replaceChildren(...answer.drawings.map(drawing));
  write(place("study-caption"), answer.caption);
  place("study-table").replaceChildren(table(id, status, answer, load));
  place("study-downloads").replaceChildren(...DOWNLOADS.map(([name, text, saved]) => make("a", {
    class: "button", href: `/api/studies/${id}/${name}`, textContent: text, ...(saved ? { download: "" } : { target: "_blank", rel: "noopener" }),
  })));
}

function notes(status, texts) {
  const state = status.state === "done" ? [] : [make("p", { class: "note", textContent: status.over ? status.message : `So far: ${status.message}` })];
  return [...state, ...texts.map((text) => make("p", { class: "note warm", textContent: text }))];
}

function drawPanels(figures) {
  const parent = place("study-figures");
  for (const plot of parent.querySelectorAll(".plot")) if (plot.figure) window.Plotly.purge(plot);
  const boxes = figures.map(({ layout }) => make("div", { class: "panel" },
    make("h4", {}, make("b", { textContent: layout.meta.title }), make("span", { textContent: layout.meta.note })), make("div", { class: "plot" })));
  parent.replaceChildren(...boxes);
  figures.forEach((figure, index) => draw(boxes[index].querySelector(".plot"), figure));
}

function table(id, status, { table: { head, rows, numbers }, best }, load) {
  const isNumber = (column) => (numbers.includes(column) ? "number" : "");
  const cells = (row) => row.slice(1).map((text, index) => make("td", { class: isNumber(index + 1), "data-head": head[index + 1], textContent: text }));
  const body = rows.map((row, number) => make("tr", { class: number === best ? "best" : "" },
    make("th", { scope: "row" }, `${row[0]} `, opener(id, status, number, load), number === best && make("span", { class: "chip warm", textContent: "best" })),
    cells(row)));
  return make("table", {},
    make("thead", {}, make("tr", {}, head.map((text, column) => make("th", { scope: "col", class: isNumber(column), textContent: text })))),
    make("tbody", {}, body));
}

function opener(id, status, number, load) {
  const name = `run ${number} of ${status.label}`;
  const open = async () => load((await get(`/api/studies/${id}/runs/${number}/given`)).yaml, name);
  return make("button", {
    type: "button", class: "small", textContent: "Open", title: "Write this run’s case into the form", "aria-label": `Open the case of run ${number} in the form`,
    onclick: (event) => open().catch((detail) => event.target.dispatchEvent(new CustomEvent("refused", { bubbles: true, detail }))),
  });
}
