// Values of other sections that go with a chosen kind, such as steps of a cell of way with a motion.

import { setValue, valueAt } from "./draft.js";
import { INSTEAD, WITH } from "./hints.js";

// What was set, by its key: the value before and the new one.
const set = new Map();
const isAlike = (one, other) => JSON.stringify(one) === JSON.stringify(other);

// Puts back what went with the earlier kind of a section, and sets what goes with the new one.
export function accompany(section, kind) {
  if (!(section in WITH)) return;
  for (const [key, { before, after }] of set) if (isAlike(valueAt(key.split(".")), after)) setValue(key.split("."), before);
  set.clear();
  for (const [key, value] of Object.entries(WITH[section][kind] ?? {})) {
    const path = key.split("."), group = path.slice(0, -1), before = valueAt(path), after = value ?? undefined;
    const isGiven = (INSTEAD[path.at(-1)] ?? []).some((other) => valueAt([...group, other]) !== undefined);
    if (isGiven || valueAt(group) === undefined || isAlike(before, after)) continue;
    set.set(key, { before: structuredClone(before), after });
    setValue(path, after);
  }
}
