// Figures of a run, made by the server: pressure and sections, friction, histories, loops.

import { make, place } from "./dom.js";
import { draw, followColours, followScale, followSlider, show } from "./linked.js";
import { get } from "./server.js";
import { isDark } from "./theme.js";
import { chosenSystem } from "./units.js";

let loading = null;
let shownId = null;
let latest = null;

// The library is large, so it is loaded with the first result.
export function plotly() {
  loading ??= new Promise((ready, failed) => {
    const script = make("script", { src: "/static/plotly.min.js" });
    script.onload = ready;
    script.onerror = () => {
      loading = null;
      const message = "plotly.min.js cannot be loaded";
      // As of a request that the server does not answer.
      failed(Object.assign(new Error(message), { problems: [{ path: "", line: null, message }] }));
    };
    document.head.append(script);
  });
  return loading;
}

export function setUpFigures() {
  followSlider(place("instant-slider"), place("play"));
  followScale(place("time-scale"));
  followColours(place("map-scale"));
}

// Answers may come late: only those to the last request are drawn.
export function drawFigures(shown, reference) {
  const request = {};
  latest = request;
  request.drawn = drawAnswer(request, shown, reference);
  return request.drawn;
}

// The instant and the scale that are shown are kept for the same run.
async function drawAnswer(request, shown, reference) {
  const query = new URLSearchParams({ dark: isDark(), units: chosenSystem() });
  if (reference) query.set("reference", reference.id);
  const [figures] = await Promise.all([get(`/api/runs/${shown.id}/figures?${query}`), plotly()]);
  if (request !== latest) { await latest.drawn; return; }
  const isSame = shownId === shown.id;
  shownId = shown.id;
  drawSurface(figures, shown.data.axis.row, isSame);
  drawHistories(figures, shown.data.axis.name, isSame);
  place("loops-chapter").hidden = !figures.loops.length;
  drawPanels(place("loops"), figures.loops);
  place("loops-text").textContent = [...new Set(figures.loops.map(({ layout }) => layout.meta.note))].join(" ");
}

function drawSurface({ surface, start, remarks }, row, isSame) {
  place("map-chapter").hidden = !surface.length;
  // A figure takes the width of its place, which is none while that is hidden.
  for (const name of ["line-load", "section-x"])
    place(name).parentElement.hidden = !surface.some(({ layout }) => layout.meta.name === name);
  drawPlaced(surface, ["map", "section-x", "section-y", "line-load"], "surface-panels");
  if (!surface.length) return;
  const slider = place("instant-slider"), last = surface[0].frames.length - 1;
  const index = isSame && Number(slider.value) <= last ? slider.value : String(start);
  slider.max = String(last);
  slider.value = index;
  slider.setAttribute("aria-label", row.charAt(0).toUpperCase() + row.slice(1));
  place("map-controls").hidden = last < 1;
  place("map-remarks").textContent = remarks;
  show(index);
}

function drawHistories({ friction, histories, scale }, over, isSame) {
  // Nothing is drawn over a single speed; the table has its numbers.
  place("histories-chapter").hidden = !histories.length;
  place("friction-chapter").hidden = !friction.length;
  drawPlaced(friction, ["friction"], "friction-panels");
  place("histories-title").textContent = `Over ${over}`;
  drawPanels(place("histories"), histories);
  const button = place("time-scale"), { dataset } = button;
  button.hidden = !scale;
  if (!isSame) dataset.shown = scale ?? "linear";
  Object.assign(dataset, { linear: `Show linear ${over}`, log: `Show logarithmic ${over}` });
  button.textContent = dataset[dataset.shown === "log" ? "linear" : "log"];
  if (scale) show(dataset.shown);
}

// Figures that have a place of their name, and panels for the others.
function drawPlaced(figures, names, others) {
  drawPanels(place(others), figures.filter(({ layout }) => !names.includes(layout.meta.name)));
  for (const name of names) {
    const figure = figures.find(({ layout }) => layout.meta.name === name);
    if (figure) draw(place(name), figure); else clear(place(name));
  }
}

// A panel for each figure, in their order; those that are there are drawn again.
function drawPanels(parent, figures) {
  const before = new Map([...parent.children].map((panel) => [panel.dataset.panel, panel]));
  for (const figure of figures) {
    const { name } = figure.layout.meta, key = name.replace("history-", "");
    const panel = before.get(key) ?? make("div", { class: "panel", "data-panel": key },
      make("h4", {}, make("b", { "data-title": name }), make("span", parent.id === "histories" ? { "data-note": name } : {})),
      make("div", { class: "plot" }));
    before.delete(key);
    parent.append(panel);
    draw(panel.querySelector(".plot"), figure);
  }
  for (const panel of before.values()) { clear(panel.querySelector(".plot")); panel.remove(); }
}

function clear(box) {
  if (box.figure) window.Plotly.purge(box);
  box.figure = null;
}
