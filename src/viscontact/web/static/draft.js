// The case that is being written: as values for the form, and as the YAML text that is run.

import { post } from "./server.js";

export const draft = new EventTarget();
let values = {};
let text = "";
let asked = 0;
// Whether the values are those of the text; not while that cannot be read.
let read = false;

// Whose the title is: "own" was typed, "given" came with an example that nobody has changed yet,
// "made" follows from the case, and changes with it.
let naming = "made";
let suggested = "";
let shipped = new Set();

export function useExampleTitles(titles) {
  shipped = new Set(titles);
}

// A tab keeps its own case over a reload; a new tab begins with the one written last.
const KEY = "viscontact.case";

export const caseValues = () => values;
export const caseText = () => text;
export const isRead = () => read;

// Keys and positions as people write them: material.times[1].
export const dotted = (path) =>
  path.map((key) => (typeof key === "number" ? `[${key + 1}]` : `.${key}`)).join("").replace(/^\./, "");

export const valueAt = (path) => path.reduce((part, key) => part?.[key], values);

const isEmpty = (value) =>
  value === undefined || value === null || value === "" ||
  (typeof value === "object" && Object.keys(value).length === 0);

// Sets a value; an empty one is left out, and so is a mapping that holds nothing any more.
export function setValue(path, value) {
  if (path.length === 1 && path[0] === "title") naming = isEmpty(value) ? "made" : "own";
  else if (naming === "given") naming = "made";
  put(values, path, value);
  changed("values");
}

// Writes a value in another way that means the same: no change of the case.
export function rewrite(path, value) {
  put(values, path, value);
}

function put(part, [key, ...rest], value) {
  if (rest.length) {
    if (part[key] === null || typeof part[key] !== "object") part[key] = typeof rest[0] === "number" ? [] : {};
    put(part[key], rest, value);
    value = part[key];
  }
  if (isEmpty(value) && !Array.isArray(part)) delete part[key];
  else part[key] = value ?? "";
}

// A whole case from elsewhere, as text, or the present one `edited` as such; its values are read
// by the server.
export async function replaceText(yaml, { edited = false } = {}) {
  const turn = ++asked, before = values.title;
  text = yaml;
  read = false;
  keep();
  draft.dispatchEvent(new Event("text"));
  const found = await post("/api/case", { yaml });
  if (turn !== asked) return;
  values = found.case;
  suggested = found.suggested_title;
  const isKept = edited && naming !== "own" && values.title === before;
  if (isEmpty(values.title) || values.title === suggested || isKept) naming = "made";
  else naming = shipped.has(values.title) ? "given" : "own";
  read = true;
  draft.dispatchEvent(new Event("replaced"));
}

// The text that the values amount to. A later change makes an earlier answer void.
export async function writeText() {
  const turn = ++asked;
  const titled = naming !== "made";
  const written = await post("/api/yaml", { case: values, yaml: text, titled });
  if (turn !== asked) return false;
  text = written.yaml;
  suggested = written.suggested_title;
  if (!titled) {
    values.title = suggested;
    draft.dispatchEvent(new Event("titled"));
  }
  keep();
  draft.dispatchEvent(new Event("text"));
  return true;
}

// A case that was edited as text may still have the title that it had before.
export async function renew() {
  if (read && naming === "made" && values.title !== suggested) await writeText();
}

export function changed(what) {
  draft.dispatchEvent(new Event(what));
}

function keep() {
  try {
    sessionStorage.setItem(KEY, text);
    localStorage.setItem(KEY, text);
  } catch { /* a browser that keeps nothing */ }
}

export function keptText() {
  try {
    return sessionStorage.getItem(KEY) ?? localStorage.getItem(KEY);
  } catch {
    return null;
  }
}
