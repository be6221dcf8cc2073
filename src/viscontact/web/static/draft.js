// The current case: as values for the form, and as the YAML text that is run.

import { post } from "./server.js";

export const draft = new EventTarget();
let values = {};
let text = "";
// Number of the latest request; answers to earlier ones are ignored.
let latest = 0;
// Whether the values agree with the text; false while the text is not valid.
let read = false;
// Number of changes of the values, and of those that the text has; fewer after a failed request.
let changes = 0;
let written = 0;

// Origin of the title: "own" was typed, "given" belongs to an unchanged example, "made" is derived
// from the case and changes with it.
let naming = "made";
let suggested = "";
let shipped = new Set();

export function useExampleTitles(titles) {
  shipped = new Set(titles);
}

// A tab keeps its case when it is reloaded; a new tab starts with the latest case.
const KEY = "viscontact.case";

export const caseValues = () => values;
export const caseText = () => text;
export const isRead = () => read;

// Keys and positions as in messages: material.times[1].
export const dotted = (path) =>
  path.map((key) => (typeof key === "number" ? `[${key + 1}]` : `.${key}`)).join("").replace(/^\./, "");

export const valueAt = (path) => path.reduce((part, key) => part?.[key], values);

const isEmpty = (value) =>
  value === undefined || value === null || value === "" ||
  (typeof value === "object" && Object.keys(value).length === 0);

// Sets a value; empty values and empty mappings are removed.
export function setValue(path, value) {
  if (path.length === 1 && path[0] === "title") naming = isEmpty(value) ? "made" : "own";
  else if (naming === "given") naming = "made";
  put(values, path, value);
  changes += 1;
  changed("values");
}

// Rewrites a value without changing its meaning: not a change of the case.
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

// Replaces the whole text, or takes over the `edited` one; the server reads its values.
export async function replaceText(yaml, { edited = false } = {}) {
  const request = ++latest, before = values.title;
  text = yaml;
  read = false;
  written = changes;
  keep();
  draft.dispatchEvent(new Event("text"));
  const found = await post("/api/case", { yaml });
  if (request !== latest) return;
  values = found.case;
  suggested = found.suggested_title;
  const isKept = edited && naming !== "own" && values.title === before;
  if (isEmpty(values.title) || values.title === suggested || isKept) naming = "made";
  else naming = shipped.has(values.title) ? "given" : "own";
  read = true;
  draft.dispatchEvent(new Event("replaced"));
}

// Writes the text of the values.
export async function writeText() {
  const request = ++latest, upTo = changes;
  const titled = naming !== "made";
  const found = await post("/api/yaml", { case: values, yaml: text, titled });
  if (request !== latest) return false;
  written = upTo;
  text = found.yaml;
  suggested = found.suggested_title;
  if (!titled) {
    values.title = suggested;
    draft.dispatchEvent(new Event("titled"));
  }
  keep();
  draft.dispatchEvent(new Event("text"));
  return true;
}

// The text may lack values that were typed while the server did not answer, and a case that was edited
// as text may still have its earlier title.
export async function renew() {
  if (read && (written < changes || (naming === "made" && values.title !== suggested))) await writeText();
}

export function changed(what) {
  draft.dispatchEvent(new Event(what));
}

function keep() {
  try {
    sessionStorage.setItem(KEY, text);
    localStorage.setItem(KEY, text);
  } catch { /* storage is disabled */ }
}

export function keptText() {
  try {
    return sessionStorage.getItem(KEY) ?? localStorage.getItem(KEY);
  } catch {
    return null;
  }
}
