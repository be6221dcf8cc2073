// Curves of an active run, made by the server as far as the run has come.

import { make, place } from "./dom.js";
import { plotly } from "./figures.js";
import { draw } from "./linked.js";
import { get } from "./server.js";
import { isDark } from "./theme.js";
import { chosenSystem } from "./units.js";

// Time between two requests [ms]; a run may complete hundreds of steps a second.
const PAUSE = 400;
let shown = null;
let requested = 0;

export function drawGrowing(status) {
  if (shown?.id !== status.id) shown = { id: status.id, step: -1, busy: false };
  const box = place("growing");
  box.hidden = status.over || !status.figures.length;
  if (box.hidden) { empty(box); shown = null; return; }
  if (!shown.busy && status.step > shown.step) request(shown, status);
}

async function request(run, status) {
  run.busy = true;
  await new Promise((ready) => setTimeout(ready, Math.max(0, requested + PAUSE - Date.now())));
  requested = Date.now();
  try {
    const query = new URLSearchParams({ dark: isDark(), units: chosenSystem() });
    const [found] = await Promise.all([get(`/api/runs/${run.id}/growing?${query}`), plotly()]);
    run.step = found.count - (status.axis === "time" ? 1 : 0);
    if (shown === run) show(found);
  } catch (error) {
    if (!error.problems) throw error; // the next event repeats the request
  } finally {
    run.busy = false;
  }
}

function show({ reached, texts, figures }) {
  const box = place("growing"), names = Object.keys(figures);
  const isFirst = !box.firstChild;
  if (names.some((name) => !box.querySelector(`[data-growing="${name}"]`))) {
    empty(box);
    box.append(make("p", { class: "faint" }), ...names.map((name) => make("figure", { "data-growing": name },
      make("figcaption", {}, make("span"), " ", make("b")), make("div", { class: "plot" }))));
  }
  // The numbers are those of the last line read, which may be behind the step of the status.
  box.querySelector("p").textContent = `Values at ${reached}`;
  for (const name of names) {
    const panel = box.querySelector(`[data-growing="${name}"]`);
    panel.querySelector("span").textContent = figures[name].layout.meta.title;
    panel.querySelector("b").textContent = texts[name] ?? "";
    // Small curves have no room for axes.
    if (panel.clientWidth < 160) {
      const { layout } = figures[name];
      for (const axis of [layout.xaxis, layout.yaxis]) axis.visible = false;
      layout.margin = { l: 2, r: 2, t: 4, b: 4 };
    }
    draw(panel.querySelector(".plot"), figures[name]);
  }
  if (isFirst) place("progress").scrollIntoView({ block: "nearest" });
}

function empty(box) {
  for (const plot of box.querySelectorAll(".plot")) if (plot.figure) window.Plotly.purge(plot);
  box.replaceChildren();
}
