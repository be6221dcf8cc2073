// Check after each change: text, problems, estimate and drawings.

import { correctChoice } from "./choosing.js";
import { caseText, draft, writeText } from "./draft.js";
import { definitions, items, place, settled, write } from "./dom.js";
import { draw } from "./drawings.js";
import { clearProblems, showProblems } from "./problems.js";
import { post } from "./server.js";
import { lasting } from "./units.js";

// Delay after a change [ms].
const PAUSE = 350;
let request = null;
export const check = { problems: [], full: null, busy: false };
export const checked = new EventTarget();

export function setUpChecking() {
  const soon = settled(async () => {
    try {
      if (await writeText()) await Promise.all([look(), draw()]);
    } catch (error) {
      refuse(error);
    }
  }, PAUSE);
  draft.addEventListener("values", () => {
    request?.abort(); // its answer would be about an earlier case
    update({ busy: true });
    soon();
  });
}

export async function look() {
  request?.abort();
  request = new AbortController();
  update({ busy: true });
  try {
    const full = await post("/api/check", { yaml: caseText() }, request.signal);
    clearProblems(place("form"));
    update({ problems: [], full, busy: false });
  } catch (error) {
    if (!correctChoice(error.problems ?? [])) refuse(error);
  }
}

export function refuse(error) {
  if (error.name === "AbortError") return;
  if (!error.problems) throw error;
  showProblems(place("form"), error.problems);
  update({ problems: error.problems, full: null, busy: false });
}

function update(values) {
  Object.assign(check, values);
  drawCheck();
  checked.dispatchEvent(new Event("change"));
}

function drawCheck() {
  const { problems, full } = check, count = problems.length;
  place("estimate").setAttribute("aria-busy", String(check.busy));
  place("to-problem").hidden = count === 0;
  write(place("to-problem"), count === 1 ? "One problem: show it" : `${count} problems: show the first`);
  write(place("estimate-text"), full ? estimate(full) : count ? "" : "Checking the case…");
  write(place("refine-time"), full ? (full.seconds < 1 ? "< 1 s" : lasting(full.seconds)) : "");
  place("expected").hidden = count > 0;
  if (!full) return;
  const rows = [...(full.needs ?? []), ...(full.expectations ?? [])];
  place("expected-rows").replaceChildren(...definitions(rows));
  place("expected-warnings").replaceChildren(...items([...(full.warnings ?? []), ...(full.notes ?? [])]));
  place("warned").hidden = !full.warnings?.length;
  write(place("warned"), full.warnings?.length === 1 ? "1 warning" : `${full.warnings?.length} warnings`);
}

function estimate({ cells, steps, speeds, memory }) {
  const course = speeds ? `${speeds} ${speeds > 1 ? "speeds" : "speed"}` : steps ? `${steps} steps` : "steps as needed";
  const parts = [`${cells.join(" × ")} cells`, course];
  if (memory) parts.push(memory < 1e9 ? `${Math.round(memory / 1e6)} MB` : `${(memory / 1e9).toFixed(1)} GB`);
  return parts.join(" · ");
}
