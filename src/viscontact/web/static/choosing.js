// Keeps a case valid after a choice: values that the server refuses are set aside or replaced.

import { changed, dotted, setValue, valueAt } from "./draft.js";

// The group of the latest choice, its values then, and its values without the earlier ones.
let last = null;
// Values that do not suit the choice, by their keys, to be restored later.
const aside = new Map();

// Called after a choice in the group at `path`; `anew` is the group without earlier values.
export function chosen(path, anew = null) {
  last = { path, anew, text: JSON.stringify(valueAt(path)) };
}

// Called before a choice: values that were set aside are tried again.
export function putBack(path) {
  for (const [name, { group, key, value }] of aside) {
    if (group !== dotted(path)) continue;
    aside.delete(name);
    if (valueAt([...path, key]) === undefined) setValue([...path, key], value);
  }
}

// Corrects a refused choice where possible, and returns whether it did. Keys that must be left out
// are set aside; else, where earlier values do not suit the choice (such as a ball's radius with the
// spacing of dimples), the group starts without them.
export function correctChoice(problems) {
  const { path, anew, text } = last ?? {};
  last = null;
  if (!path || JSON.stringify(valueAt(path)) !== text) return false;
  const group = dotted(path), within = problems.filter((each) => each.path.startsWith(`${group}.`));
  const loose = within.filter(({ message }) => message.endsWith("leave it out"))
    .map((each) => each.path.slice(group.length + 1)).filter((key) => valueAt([...path, key]) !== undefined);
  for (const key of loose) {
    aside.set(`${group}.${key}`, { group, key, value: valueAt([...path, key]) });
    setValue([...path, key], undefined);
  }
  if (loose.length) chosen(path);
  else if (anew && within.length && JSON.stringify(anew) !== text) setValue(path, anew);
  else return false;
  changed("structure");
  return true;
}
