// Values of other sections that go with a chosen kind, such as steps of a cell of way with a motion.

import { draft, setValue, valueAt } from "./draft.js";
import { INSTEAD, WITH } from "./hints.js";

// What was set, by its section and key: the value before and the new one.
const set = new Map();
// The values of another text are its own: none of them is put back.
draft.addEventListener("replaced", () => set.clear());
const isAlike = (one, other) => JSON.stringify(one) === JSON.stringify(other);

// Puts back what went with the earlier kind of a section, and sets what goes with the new one.
export function accompany(section, kind) {
  if (!(section in WITH)) return;
  for (const [key, { before, after }] of set.get(section) ?? []) if (isAlike(valueAt(key.split(".")), after)) setValue(key.split("."), before);
  set.set(section, new Map());
  for (const [key, value] of Object.entries(WITH[section][kind] ?? WITH[section][""] ?? {}))
    if (value?.inPlaceOf) exchange(section, key, value);
    else put(section, key, value);
}

function put(section, key, value) {
  const path = key.split("."), group = path.slice(0, -1), before = valueAt(path), after = value ?? undefined;
  const isGiven = value !== null && (INSTEAD[path.at(-1)] ?? []).some((other) => valueAt([...group, other]) !== undefined);
  if (isGiven || (group.length && valueAt(group) === undefined) || isAlike(before, after)) return;
  set.get(section).set(key, { before: structuredClone(before), after });
  setValue(path, after);
}

// A value in place of others, if one of them is set.
function exchange(section, key, { value, inPlaceOf, unless }) {
  if (unless && valueAt(unless.split(".")) !== undefined) return;
  const group = key.split(".").slice(0, -1), others = inPlaceOf.filter((other) => valueAt([...group, other]) !== undefined);
  if (!others.length) return;
  for (const other of others) put(section, [...group, other].join("."), null);
  put(section, key, value);
}
