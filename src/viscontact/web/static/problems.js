// What is wrong with the case, beside the very field, in the server's words.

import { place, make } from "./dom.js";

let marked = [];

export function clearProblems(form) {
  for (const list of form.querySelectorAll(".problems")) list.replaceChildren();
  for (const control of marked) control.removeAttribute("aria-invalid");
  marked = [];
  place("other-problems").replaceChildren();
}

// Shows each problem where its key is, or where the nearest key above it is.
export function showProblems(form, problems) {
  clearProblems(form);
  for (const problem of problems) {
    const found = nearest(form, problem.path);
    const list = found?.box.querySelector(":scope > .problems") ?? found?.box.closest(":has(> .problems)")?.querySelector(":scope > .problems");
    const rest = found ? problem.path.slice(found.path.length).replace(/^\./, "") : problem.path;
    const which = rest || (list && !found.box.contains(list) ? problem.path.split(".").pop() : "");
    const said = [problem.line && !found ? `line ${problem.line}` : "", which, problem.message].filter(Boolean).join(": ");
    (list ?? place("other-problems")).append(make("li", { textContent: said }));
    if (found) mark(found, rest);
  }
}

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

// Brings the first problem into sight, and the focus to it.
export function goToProblem(form) {
  const control = form.querySelector("[aria-invalid]");
  const place = control ?? form.querySelector(".problems li") ?? document.querySelector("#other-problems li");
  place?.scrollIntoView({ block: "center", behavior: "smooth" });
  control?.focus({ preventScroll: true });
}
