// What goes along with a choice, found out by trying: a choice is to give a case that can be run.

import { changed, dotted, setValue, valueAt } from "./draft.js";

// The group that a choice was made in, as it was then, and what it would be without what was before.
let last = null;
// Values that do not go with what is chosen, by their keys, for when they do again.
const aside = new Map();

// After a choice in the group at `path`; `anew` is the group without what was carried over.
export function chosen(path, anew = null) {
  last = { path, anew, text: JSON.stringify(valueAt(path)) };
}

// Before one: what was put aside is tried again.
export function putBack(path) {
  for (const [name, { group, key, value }] of [...aside]) {
    if (group !== dotted(path)) continue;
    aside.delete(name);
    if (valueAt([...path, key]) === undefined) setValue([...path, key], value);
  }
}

// Does what can be done about a choice that is refused, and returns whether there was anything:
// keys that are to be left out are put aside; else, where what was there before does not go with
// what the choice begins with, such as a ball's radius with the spacing of dimples, all begins anew.
export function mended(problems) {
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
