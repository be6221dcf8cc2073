// Problems of the case, shown beside their fields.

import { place, make } from "./dom.js";

let marked = [];

export function clearProblems(form) {
  for (const list of form.querySelectorAll(".problems")) list.replaceChildren();
  for (const control of marked) control.removeAttribute("aria-invalid");
  marked = [];
  place("other-problems").replaceChildren();
  place("text-problems").replaceChildren();
}

// Shows each problem at its key, or at the nearest key above it.
export function showProblems(form, problems) {
  clearProblems(form);
  for (const problem of problems) {
    const found = nearest(form, problem.path);
    const list = found && roomIn(found.box.closest(":has(> .problems)"));
    const rest = found ? problem.path.slice(found.path.length).replace(/^\./, "") : problem.path;
    const which = rest || (list && !found.box.contains(list) ? problem.path.split(".").pop() : "");
    const line = problem.line ? `line ${problem.line}` : "";
    (list ?? place("other-problems")).append(problemItem(found ? "" : line, which, problem.message));
    place("text-problems").append(problemItem(line, problem.path, problem.message));
    if (found) mark(found, rest);
  }
}

const roomIn = (box) => box?.querySelector(":scope > .problems");
const problemItem = (...parts) => make("li", { textContent: parts.filter(Boolean).join(": ") });

function nearest(form, path) {
  for (let rest = path; rest; rest = rest.replace(/(\.?[^.[\]]+|\[\d+\])$/, "")) {
    const box = form.querySelector(`[data-path="${CSS.escape(rest)}"]`);
    if (box) return { box, path: rest };
  }
  return null;
}

function mark({ box }, rest) {
  for (let fold = box.closest("details"); fold; fold = fold.parentElement.closest("details")) fold.open = true;
  const control = box.matches("input") ? box : rest ? null : box.querySelector("input, select, textarea");
  if (!control) return;
  control.setAttribute("aria-invalid", "true");
  marked.push(control);
}

// Scrolls to the first problem and focuses its field.
export function goToProblem(form) {
  const control = form.querySelector("[aria-invalid]");
  const first = control ?? form.querySelector(".problems li") ?? place("other-problems").firstChild;
  first?.scrollIntoView({ block: "center", behavior: "smooth" });
  control?.focus({ preventScroll: true });
}
