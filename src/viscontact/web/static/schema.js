// Parts of the JSON schema as one of a few kinds that the form can draw.

import { APART, FILLED, FIRST, INSTEAD } from "./hints.js";

let root = { properties: {}, $defs: {} };

export function useSchema(schema) {
  root = schema;
}

export const wholeCase = () => understand(root);
export const unitsOf = (dimension) =>
  [dimension].flat().flatMap((each) => root["x-units"]?.[each] ?? []);

// A part with its reference resolved; keys beside the reference have priority.
function resolved(part) {
  if (!part.$ref) return part;
  const { $ref, ...beside } = part;
  return { ...resolved(root.$defs[$ref.split("/").pop()]), ...beside };
}

// All alternatives of a part, nested unions flattened.
function alternatives(part) {
  const union = part.anyOf ?? part.oneOf;
  // The server spells out what is written in short.
  return union ? union.filter((each) => !each["x-shorthand"]).flatMap((each) => alternatives(resolved(each))) : [part];
}

const about = (part) => ({
  description: part.description ?? "", default: part.default, examples: part.examples ?? [],
});

// The kind of a part: constant, choice, switch, axes (a switch, or one for x and y each), number, text, group, mapping, tuple, list,
// variants or lines; text by default.
function understand(given) {
  const part = resolved(given);
  const all = alternatives(part);
  const some = all.filter((each) => each.type !== "null");
  const optional = some.length < all.length;
  const single = some.length === 1;
  const kind = single ? one(some[0]) : several(some);
  const words = about(part), inner = single ? about(some[0]) : { examples: some.flatMap((each) => each.examples ?? []) };
  return {
    ...kind, optional, default: words.default,
    description: words.description || inner.description || "",
    examples: words.examples.length ? words.examples : inner.examples,
  };
}

function one(part) {
  if ("const" in part) return { kind: "constant", value: part.const };
  if (part.enum) return { kind: "choice", options: part.enum };
  if (part.type === "boolean") return { kind: "switch" };
  if (part.type === "number" || part.type === "integer") return number(part);
  if (part.type === "array") return array(part);
  if (part.properties) return group(part);
  if (part.type === "object") return { kind: "mapping" };
  return { kind: "text", dimension: part["x-dimension"] ?? null, sign: part["x-sign"] ?? "" };
}

const number = (part) => ({
  kind: "number", whole: part.type === "integer",
  least: part.minimum, most: part.maximum, above: part.exclusiveMinimum, below: part.exclusiveMaximum,
});

function array(part) {
  if (part.prefixItems) return { kind: "tuple", items: part.prefixItems.map(understand) };
  const item = understand(part.items ?? {});
  return { kind: item.kind === "choice" ? "set" : "list", item };
}

// A group without the aliases of its keys, but diameters, which are typed in place of radii. One of a
// key and its aliases is required under allOf.
function group(part) {
  const own = Object.entries(part.properties).filter(([, each]) => !each["x-alias-of"]);
  const diameters = Object.entries(part.properties).filter(([key, each]) => each["x-alias-of"] && key.endsWith("diameter"));
  const others = Object.fromEntries(diameters.map(([key, each]) => [each["x-alias-of"], [key, each]]));
  const choices = (part.allOf ?? []).map((rule) => rule.oneOf ?? rule.anyOf ?? []);
  const required = [...(part.required ?? []), ...choices.flatMap((choice) => choice[0]?.required ?? [])];
  return { kind: "group", properties: Object.fromEntries(own), others, required };
}

// The key whose constant identifies one of several groups.
function tagOf(groups) {
  const names = Object.keys(groups[0].properties);
  return names.find((name) => groups.every((each) => "const" in (each.properties[name] ?? {})));
}

const isSwitch = (node) => node.kind === "switch";

function several(parts) {
  const groups = parts.filter((each) => each.properties);
  if (groups.length && tagOf(groups)) return variants(parts, groups);
  const kinds = parts.map(one), words = kinds.flatMap((each) => each.options ?? each.value ?? []);
  const texts = kinds.filter((each) => each.kind === "text");
  const lists = kinds.filter((each) => ["list", "tuple"].includes(each.kind));
  if (lists[0]?.kind === "list" && texts.length && !texts[0].dimension) return { kind: "lines" };
  if (kinds.some(isSwitch) && lists[0]?.item && isSwitch(lists[0].item)) return { kind: "switch" };
  if (kinds.some(isSwitch) && lists[0]?.items?.every(isSwitch)) return { kind: "axes", many: true };
  const inner = texts[0] ?? lists[0]?.item ?? lists[0]?.items?.[0];
  const numeric = kinds.some((each) => each.kind === "number");
  const dimension = inner?.dimension ?? null;
  return { kind: "text", words, numeric, many: lists.length > 0, mapped: groups.length > 0, dimension };
}

function variants(parts, groups) {
  const tag = tagOf(groups);
  const named = parts.filter((each) => each.enum).flatMap((each) => each.enum);
  const unique = new Map(groups.map((each) => [each.properties[tag].const, understand(each)]));
  const sum = parts.some((each) => each.type === "array");
  return { kind: "variants", tag, named: named.filter((name) => !unique.has(name)), options: unique, sum };
}

// The keys of a group in the order of the form, with the kind of each.
export function keysOf(node, { requiredFirst = true } = {}) {
  const rank = (key) => (FIRST.includes(key) ? FIRST.indexOf(key) : FIRST.length);
  return Object.entries(node.properties)
    .map(([key, part]) => ({ key, node: understand(part), required: node.required.includes(key), other: otherOf(node, key) }))
    .filter((each) => each.node.kind !== "constant")
    .sort((a, b) => (requiredFirst ? b.required - a.required : 0) || rank(a.key) - rank(b.key));
}

// The other spelling of a key, such as a diameter of a radius.
function otherOf(node, key) {
  const [name, part] = node.others?.[key] ?? [];
  return name && { key: name, node: understand(part) };
}

// Keys with a single value under a part of a case, with the path, the kind and the value of each:
// those that are set, and quantities and numbers that may be.
export function leaves(node, value, path = []) {
  const inside = (each, entry, ...steps) => leaves(each, entry, [...path, ...steps]);
  if (node.kind === "group" && (value !== undefined || !path.length)) return keysOf(node).flatMap(({ key, node: each, other }) =>
    (other && value?.[other.key] !== undefined ? inside(other.node, value[other.key], other.key) : inside(each, value?.[key], key)));
  if (node.kind === "list" && Array.isArray(value)) return value.flatMap((entry, index) => inside(node.item, entry, index));
  if (node.kind === "variants" && Array.isArray(value)) return value.flatMap((entry, index) => inside({ ...node, sum: false }, entry, index));
  if (node.kind === "variants" && value !== null && typeof value === "object") {
    const option = node.options.get(value[node.tag]);
    return option ? leaves(option, value, path) : [];
  }
  const isSet = value !== undefined && value !== null && typeof value !== "object";
  const isOpen = value === undefined && (node.kind === "number" || (node.kind === "text" && node.dimension !== null));
  return isSet || isOpen ? [{ path, node, value }] : [];
}

// Initial value of a required key.
export function startOf(node) {
  if (node.default !== undefined && node.default !== null && node.kind !== "text") return node.default;
  if (node.examples.length) return node.examples[0];
  if (node.kind === "choice") return node.options[0];
  if (node.kind === "number") return node.least ?? 0.5;
  if (node.kind === "tuple") return node.items.map(startOf);
  if (node.kind === "list") return [startOf(node.item)];
  if (node.kind === "variants") return startOfVariant(node, node.options.keys().next().value, {});
  if (node.kind === "group") return startOfGroup(node, {});
  return "";
}

// Initial values of a variant; values under the same keys are kept.
export function startOfVariant(node, tag, before) {
  return { [node.tag]: tag, ...startOfGroup(node.options.get(tag), before) };
}

function startOfGroup(node, before) {
  const values = {};
  for (const { key, node: child, required, other } of keysOf(node)) {
    const old = before[key];
    if (other && before[other.key] !== undefined) { values[other.key] = before[other.key]; continue; }
    const isApart = !required && (APART[key] ?? []).some((other) => other in values);
    if (old !== undefined && fits(child, old) && !isApart) values[key] = old;
    else if (required) values[key] = startOf(child);
    else if (key in FILLED && !isReplaced(key, node, before)) values[key] = FILLED[key] ?? startOf(child);
  }
  return values;
}

// No force is added beside an approach.
const isReplaced = (key, node, before) =>
  (INSTEAD[key] ?? []).some((other) => other in before && other in node.properties);

function fits(node, value) {
  if (node.kind === "choice") return node.options.includes(value);
  if (node.kind === "list" || node.kind === "tuple") return Array.isArray(value);
  if (node.kind === "variants" || node.kind === "group") return typeof value === "object";
  return typeof value !== "object" || node.many;
}
