// The active run: its progress, buttons and messages; and the list of runs.

import { items, make, place, settled, write } from "./dom.js";
import { drawGrowing } from "./growing.js";
import { cancel, forget, hasResults, refer, resume, show, start, state, watch } from "./runs.js";
import { get } from "./server.js";
import { lasting } from "./units.js";

let spoken = "";

// `study` sends the study in the form, in place of one that has failed.
export function setUpProgress(complain, study) {
  place("cancel").addEventListener("click", () => cancel().catch(complain));
  place("resume").addEventListener("click", () => resume(state.active.id).catch(complain));
  place("again").addEventListener("click", () => {
    const { quality, study: isStudy } = state.active.status;
    (isStudy ? study() : start(quality)).catch(complain);
  });
}

export function drawProgress() {
  const active = state.active, status = active?.status, box = place("progress");
  box.hidden = !status || status.state === "done";
  if (!status) return;
  box.dataset.state = state.lost ? "lost" : status.state;
  const quality = status.study ? "Study" : status.quality === "coarse" ? "Coarse answer" : "Full run";
  write(place("progress-title"), `${quality}: ${status.label}`);
  const bar = place("progress-bar");
  if (status.part > 0 || status.over) bar.value = status.over ? 1 : status.part;
  else bar.removeAttribute("value");
  bar.hidden = status.over;
  write(place("progress-text"), state.lost ? "No connection to the server; trying again." : progressText(status));
  drawGrowing(status);
  place("cancel").hidden = status.over || state.lost;
  place("resume").hidden = !(status.over && status.resumable);
  write(place("resume"), onward(status));
  place("again").hidden = !status.over || status.state === "done" || status.resumable;
  const problems = (status.problems ?? []).map(({ path, message }) => [path, message].filter(Boolean).join(": "));
  place("progress-problems").replaceChildren(...items(problems.filter((text) => text !== status.message)));
  speak(status);
}

// Before its first step a run is started, not resumed.
const onward = (status) => (status.study || status.figures.length ? "Resume" : "Start");

function progressText(status) {
  if (status.over || status.stage === "waiting") return status.message;
  const parts = [stage(status)], left = status.seconds_left;
  if (status.reached) parts.push(status.reached);
  if (left !== null) parts.push(left < 1 ? "less than a second left" : `about ${lasting(left)} left`);
  return parts.join(" · ");
}

function stage({ stage: now, step, steps, axis, message, study }) {
  if (study) return message;
  if (now === "errors") return "error bars";
  if (!step) return "starting";
  const name = axis === "speed" ? "speed" : "step";
  return steps ? `${name} ${step} of ${steps}` : `${name} ${step}`;
}

// Screen readers get changes of state at once, and progress at intervals.
const speakSoon = settled((text) => write(place("spoken"), text), 4000);
function speak(status) {
  const news = `${status.state} ${status.id}`;
  if (news !== spoken) {
    spoken = news;
    const over = status.state === "done" ? "The answer is ready." : status.message;
    write(place("spoken"), status.over ? over : "The run has started.");
  } else if (!status.over && document.hasFocus()) speakSoon(progressText(status));
}

const isReference = (run) => state.reference?.id === run.id;

// `load` writes a case into the form; `complain` shows errors.
const buttonsFor = (run, { load, complain }) => [
  hasResults(run) && act("Show", "Show this answer", () => show(run.id, run.study ? run : null), complain),
  !run.over && act("Follow", "Follow this run", () => watch(run.id), complain),
  run.resumable && act(onward(run), "Continue this run", () => resume(run.id), complain),
  run.figures.length > 0 && act(isReference(run) ? "Drop reference" : "Reference", "Compare with this answer",
    () => refer(isReference(run) ? null : run.id), complain),
  act("Load case", "Write this run’s case into the form",
    async () => load((await get(`/api/runs/${run.id}/given`)).yaml, run.label), complain),
  act("Delete", "Delete this run and its files", () => forget(run.id), complain),
];

const act = (text, about, doIt, complain) => make("button", {
  type: "button", class: "small", textContent: text, title: about, onclick: () => doIt().catch(complain),
});

// All runs of the server, those of other tabs included; at first the latest ones only.
const FEW = 6;
let all = false;
export function drawList(acts) {
  const shown = all ? state.listed : state.listed.slice(0, FEW), more = state.listed.length - shown.length;
  const isShown = (run) => [state.shown?.id, state.study?.id].includes(run.id);
  const rows = shown.map((run) => make("li", { class: isShown(run) ? "current" : "" },
    make("div", { class: "run-name" }, make("b", { textContent: run.label }),
      run.study && make("span", { class: "chip", textContent: "study" }),
      make("span", { class: `chip ${run.quality}`, textContent: run.quality }),
      isShown(run) && make("span", { class: "chip", textContent: "shown" }),
      isReference(run) && make("span", { class: "chip warm", textContent: "reference" }),
      make("span", { class: "faint", textContent: `${run.state} · ${when(run.created)}` })),
    make("div", { class: "run-acts" }, buttonsFor(run, acts))));
  const showAll = () => { all = true; drawList(acts); };
  const button = make("button", { type: "button", class: "small", textContent: `Show ${more} more`, onclick: showAll });
  place("runs").replaceChildren(...rows, ...(more > 0 ? [make("li", {}, button)] : []));
  place("runs-chapter").hidden = rows.length === 0;
}

function when(created) {
  const then = new Date(created), today = then.toDateString() === new Date().toDateString();
  return then.toLocaleString([], today ? { timeStyle: "short" } : { dateStyle: "medium", timeStyle: "short" });
}
