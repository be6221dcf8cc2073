// The form: sections, groups and variants of the schema.

import { chosen } from "./choosing.js";
import { caseValues, changed, dotted, rewrite, setValue, valueAt } from "./draft.js";
import { make } from "./dom.js";
import { field, idOf } from "./fields.js";
import { accompany } from "./company.js";
import { LATER, titleOf } from "./hints.js";
import { list, terms } from "./rows.js";
import { keysOf, startOf, startOfVariant, wholeCase } from "./schema.js";

// Values of variants that are not chosen now, to be restored when they are chosen again.
const left = new Map();
// Folds that the user opened stay open.
const opened = new Set();
let materials = new Map();

export function useMaterials(known) {
  materials = new Map(known.map((each) => [each.name, each]));
}

// Redraws the form; the focus is kept.
export function drawForm(box) {
  const focused = document.activeElement?.id, scrolled = box.scrollTop;
  const keys = keysOf(wholeCase(), { requiredFirst: false });
  const main = keys.filter(({ key }) => !LATER.has(key)), later = keys.filter(({ key }) => LATER.has(key));
  const parts = main.map((each) => (isSection(each.node) ? section(each) : part([each.key], each)));
  box.replaceChildren(...parts, ...later.map(foldedSection));
  if (focused) document.getElementById(focused)?.focus({ preventScroll: true });
  box.scrollTop = scrolled;
}

const isSection = (node) => node.kind === "group" || node.kind === "variants";

function section({ key, node, required }) {
  return make("section", { class: "part", "data-path": key, "data-section": key, "aria-labelledby": `head-${key}` },
    make("h2", { id: `head-${key}`, textContent: titleOf(key) }, make("small", { textContent: node.description })),
    body([key], node, required),
    make("div", { class: "slot", "data-slot": key }),
    make("ul", { class: "problems" }));
}

function foldedSection({ key, node, required }) {
  const description = isSection(node) && make("small", { textContent: node.description });
  const inside = isSection(node) ? body([key], node, required) : part([key], { key, node, required });
  return fold(key, caseValues()[key] !== undefined, "part", [make("h2", {}, titleOf(key), description)], [
    make("div", { "data-path": isSection(node) ? key : null, "data-section": key },
      inside, make("ul", { class: "problems" })),
  ]);
}

function fold(name, open, style, heading, inside) {
  const box = make("details", {
    class: style, open: open || opened.has(name),
    ontoggle: () => (box.open ? opened.add(name) : opened.delete(name)),
  }, make("summary", {}, heading), inside);
  return box;
}

function body(path, node, required) {
  if (node.kind === "variants") return node.sum ? sum(path, node) : variants(path, node, required);
  return group(path, node);
}

function part(path, { node, required }) {
  if (node.kind === "variants" || node.kind === "group") return nested(path, node, required);
  if (node.kind === "list") return node.item.kind === "group" ? sections(path, node) : list(path, node);
  return field(path, node, required);
}

function nested(path, node, required) {
  const key = path.at(-1), names = { "aria-label": titleOf(key), "data-path": dotted(path), "data-key": key };
  return make("div", { class: "nested", role: "group", ...names },
    node.kind === "group" && make("span", { class: "label", textContent: titleOf(key) }),
    node.kind === "group" && node.description && make("p", { class: "description", textContent: node.description }),
    body(path, node, required), make("ul", { class: "problems" }));
}

// A list of groups, such as layers.
function sections(path, node) {
  const value = valueAt(path) ?? [], one = titleOf(path.at(-1)).replace(/s$/, "").toLowerCase();
  const change = (entries) => () => { setValue(path, entries); changed("structure"); };
  const parts = value.map((_, index) => make("div", { class: "summand", "data-path": dotted([...path, index]) },
    make("span", { class: "label", textContent: `${titleOf(one)} ${index + 1} of ${value.length}` }),
    group([...path, index], node.item), make("ul", { class: "problems" }),
    value.length > 1 && adder(`Remove this ${one}`, change(value.filter((_, each) => each !== index)))));
  return make("div", { class: "nested", "data-path": dotted(path), "data-key": path.at(-1) },
    make("p", { class: "description", textContent: node.description }), parts,
    adder(`Add a ${one}`, () => change([...value, startOf(node.item)])()), make("ul", { class: "problems" }));
}

// The keys of a group: related lists as one table, less common keys folded unless they are set.
function group(path, node) {
  const keys = keysOf(node), given = valueAt(path) ?? {};
  const isPlainList = (each) => each.kind === "list" && each.item.kind !== "tuple";
  const together = keys.filter(({ node: each, required }) => required && isPlainList(each));
  const tabled = together.length > 1 ? together : [];
  const shown = keys.filter((each) => !tabled.includes(each));
  const later = shown.filter(({ key, required }) => !required && LATER.has(key) && given[key] === undefined);
  const first = shown.filter((each) => !later.includes(each));
  const draw = (each) => (each.other ? spelt(path, each) : part([...path, each.key], each));
  const ahead = first.filter((each) => each.required && each.node.kind !== "choice");
  const behind = first.filter((each) => !ahead.includes(each));
  const names = later.map(({ key }) => titleOf(key).toLowerCase()).join(", ");
  return make("div", { class: "group" },
    ahead.map(draw),
    tabled.length > 0 && terms(path, tabled),
    behind.map(draw),
    later.length > 0 && fold(`${dotted(path)} more`, false, "more",
      [make("span", { textContent: `More: ${names}` })], later.map(draw)));
}

// A radius, or the diameter in its place.
function spelt(path, each) {
  const { key, node } = each.other, name = `${dotted([...path, key])} in use`;
  const isOther = valueAt([...path, key]) !== undefined || (opened.has(name) && valueAt([...path, each.key]) === undefined);
  const [now, then] = isOther ? [each.other, each] : [each, each.other];
  const exchange = () => {
    const text = valueAt([...path, now.key]);
    setValue([...path, now.key], undefined);
    setValue([...path, then.key], scaled(text, isOther ? 0.5 : 2));
    if (isOther) opened.delete(name); else opened.add(name);
    changed("structure");
  };
  const box = field([...path, now.key], isOther ? node : each.node, each.required);
  box.querySelector(".control").append(make("button", {
    type: "button", class: "small", textContent: `as ${titleOf(then.key).toLowerCase().replace("counter ", "")}`,
    "aria-label": `Write the ${titleOf(now.key).toLowerCase()} as a ${titleOf(then.key).toLowerCase()}`, onclick: exchange,
  }));
  return box;
}

// A quantity times a factor, with its unit; a text that is none, such as "12,5 mm", as it is.
function scaled(text, factor) {
  const [, number, unit] = String(text ?? "").match(/^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)(?!\s*[\d.,+-])\s*(.*)$/i) ?? [];
  return number === undefined ? text : `${Number((factor * number).toPrecision(12))} ${unit}`.trim();
}

// One shape, or a sum of shapes.
function sum(path, node) {
  const value = valueAt(path), several = Array.isArray(value);
  const count = several ? value.length : 1;
  const add = () => {
    const before = several ? value : [value ?? startOf(node)];
    setValue(path, [...before, startOfVariant(node, node.options.keys().next().value, {})]);
    changed("structure");
  };
  const drop = (index) => () => {
    const rest = value.filter((_, each) => each !== index);
    setValue(path, rest.length === 1 ? rest[0] : rest);
    changed("structure");
  };
  const parts = Array.from({ length: count }, (_, index) => {
    const at = several ? [...path, index] : path;
    return make("div", { class: several ? "summand" : "", "data-path": several ? dotted(at) : null },
      variants(at, node, true, several ? `, ${index + 1} of ${count}` : ""), several && make("ul", { class: "problems" }),
      several && adder("Remove this shape", drop(index)));
  });
  return [...parts, adder("Add a shape to the sum", add)];
}

const adder = (text, act) => make("button", { type: "button", class: "add", textContent: text, onclick: act });

// A choice between groups of keys, or names of whole groups.
function variants(path, node, required, which = "") {
  // A variant given by its name only needs a place for its keys.
  if (keysOf(node.options.get(valueAt(path)) ?? { properties: {} }).length) rewrite(path, { [node.tag]: valueAt(path) });
  const value = valueAt(path), chosen = value !== null && typeof value === "object" ? value[node.tag] : value;
  const select = make("select", {
    id: idOf([...path, node.tag]), onchange: () => choose(path, node, select.value),
  }, variantOptions(node, chosen, required));
  const option = node.options.get(chosen);
  const description = option?.description ?? sourceOf(chosen) ?? node.description;
  const label = path.length > 1 && typeof path.at(-1) === "string" ? titleOf(path.at(-1)) : titleOf(node.tag) + which;
  return [
    make("div", { class: "field variant", "data-path": dotted([...path, node.tag]), "data-key": node.tag },
      make("label", { htmlFor: select.id, textContent: label }), make("div", { class: "control" }, select),
      make("p", { class: "description", textContent: description }), make("ul", { class: "problems" })),
    option && group(path, option),
  ];
}

function variantOptions(node, chosen, required) {
  const option = (name, text) => make("option", { value: name, textContent: text, selected: name === (chosen ?? "") });
  const named = node.named.map((name) => option(name, materials.get(name)?.title ?? titleOf(name)));
  const tagged = [...node.options.keys()].map((name) => option(name, titleOf(name)));
  const known = chosen === undefined || node.named.includes(chosen) || node.options.has(chosen);
  const grouped = (label, options) => make("optgroup", { label }, options);
  return [
    !required && option("", "none"),
    required && chosen === undefined && option("", "choose…"),
    !known && option(chosen, String(chosen)),
    named.length ? [grouped("Library", named), grouped("By its numbers", tagged)] : tagged,
  ];
}

function sourceOf(name) {
  const known = materials.get(name);
  return known && [known.temperature, known.source].filter(Boolean).join(" · ");
}

function choose(path, node, name) {
  const before = valueAt(path), place = dotted(path);
  if (before?.[node.tag]) left.set(`${place} ${before[node.tag]}`, before);
  if (name === "" || node.named.includes(name)) setValue(path, name);
  else {
    const old = left.get(`${place} ${name}`) ?? {};
    const now = typeof before === "object" ? { ...old, ...before } : old;
    if (path.length > 1) leaveBeside(path, node, name);
    setValue(path, startOfVariant(node, name, now));
    chosen(path, startOfVariant(node, name, {}));
  }
  accompany(place, name);
  changed("structure");
}

// A key that only some choices have, such as a roller's crown radius, is dropped for the others.
function leaveBeside(path, node, name) {
  const around = path.slice(0, -1), here = node.options.get(name).properties;
  for (const key of Object.keys(valueAt(around) ?? {})) {
    const isShared = [...node.options.values()].some(({ properties }) => key in properties);
    if (isShared && !(key in here)) setValue([...around, key], undefined);
  }
}
