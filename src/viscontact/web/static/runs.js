// Runs on the server: start, follow, stop, and restore after a reload.

import { caseText } from "./draft.js";
import { connection, follow, get, post, remove } from "./server.js";

// Dispatches "active" (the followed run or study has changed), "shown", "reference", "study" (the one
// that is shown has changed) and "listed".
export const runs = new EventTarget();
export const state = { active: null, shown: null, reference: null, study: null, listed: [], lost: false };

let stop = () => {};
const notify = (what) => runs.dispatchEvent(new Event(what));

// The address of the page contains its runs, for a reload or another tab.
function remember() {
  const names = { run: state.active?.id, shown: state.shown?.id, ref: state.reference?.id, study: state.study?.id };
  const parts = Object.entries(names).filter(([, id]) => id).map(([name, id]) => `${name}=${id}`);
  history.replaceState(null, "", location.pathname + (parts.length ? `#${parts.join("&")}` : ""));
}

export async function findAgain() {
  const named = new URLSearchParams(location.hash.slice(1));
  const [active, shown, reference, study] = ["run", "shown", "ref", "study"].map((name) => named.get(name));
  const tries = [shown && show(shown), reference && refer(reference), study && show(study), active && watch(active), list()];
  await Promise.all(tries.filter(Boolean).map((each) => each.catch(() => {})));
}

export const start = (quality) => begin("/api/runs", { yaml: caseText(), quality });
export const startStudy = (requested) => begin("/api/studies", { yaml: caseText(), ...requested });

async function begin(path, requested) {
  const status = await post(path, requested);
  await watch(status.id, status);
}

// Follows a run from its current status.
export async function watch(id, known = null) {
  stop();
  state.lost = false;
  state.active = { id, status: known ?? (await get(`/api/runs/${id}`)) };
  remember();
  receive(state.active.status);
  if (!state.active?.status.over) connect(id);
  list();
}

function connect(id) {
  stop();
  stop = follow(id, receive, () => {
    state.lost = true;
    notify("active");
  });
}

async function receive(status) {
  if (state.active?.id !== status.id) return;
  const wasOver = state.active.status.over && state.active.status !== status;
  state.active.status = status;
  state.lost = false;
  notify("active");
  if (status.study) showStudy(status);
  if (status.stage === "errors" && !status.over) await showEarly(status);
  if (!status.over || wasOver) return;
  stop();
  if (hasResults(status)) await show(status.id, status).catch(() => {});
  list();
}

export const hasResults = (status) => status.study?.has_answer || status.figures.length > 0;

// All values are there before their error bars, which are added when they come. Without this, a
// long run would keep its answer back for a third of its time again.
const SOON = 0.4; // [s]
let early = null;
async function showEarly(status) {
  if (early === status.id || !(status.seconds_left > SOON)) return;
  early = status.id;
  await show(status.id, status).catch(() => {});
}

let latest = null;
export async function show(id, known = null) {
  const request = (latest = {}), status = known ?? (await get(`/api/runs/${id}`));
  if (request !== latest) return; // an answer that came late
  if (status.study) { showStudy(status); return; }
  const found = await loaded(id, status);
  if (request !== latest) return;
  state.shown = found;
  remember();
  notify("shown");
}

// The answer of a study grows with its runs.
function showStudy(status) {
  if (!status.study.has_answer && state.study?.id !== status.id) return;
  state.study = { id: status.id, status };
  remember();
  notify("study");
}

export async function refer(id) {
  state.reference = id === null ? null : await loaded(id);
  remember();
  notify("reference");
}

async function loaded(id, known = null) {
  const [status, given, data] = await Promise.all([
    known ?? get(`/api/runs/${id}`), get(`/api/runs/${id}/given`), get(`/api/runs/${id}/data`),
  ]);
  return { id, status, data, yaml: given.yaml };
}

export const cancel = async () => receive(await post(`/api/runs/${state.active.id}/cancel`));

export async function resume(id) {
  await watch(id, await post(`/api/runs/${id}/resume`));
}

export async function forget(id) {
  await remove(`/api/runs/${id}`);
  for (const role of ["active", "shown", "reference", "study"])
    if (state[role]?.id === id) {
      if (role === "active") stop();
      state[role] = null;
      notify(role);
    }
  remember();
  await list();
}

// Updates the list of all runs; without an answer the old list is kept.
export async function list() {
  try {
    state.listed = await get("/api/runs");
  } catch (error) {
    if (!error.problems) throw error;
  }
  notify("listed");
}

// Called when the server is back: follow the run again, or report that it is gone.
connection.addEventListener("back", async () => {
  list();
  const active = state.active;
  if (!active || active.status.over) return;
  try {
    await watch(active.id);
  } catch {
    const message = "The server no longer knows this run; start it again.";
    const failure = { over: true, state: "failed", message, problems: [], figures: [] };
    state.active = { ...active, status: { ...active.status, ...failure } };
    state.lost = false;
    notify("active");
  }
});
