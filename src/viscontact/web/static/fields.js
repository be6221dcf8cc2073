// Fields for single values: text with a unit, number, choice, switch.

import { chosen, putBack } from "./choosing.js";
import { changed, dotted, setValue, valueAt } from "./draft.js";
import { make } from "./dom.js";
import { FILES, titleOf } from "./hints.js";
import { unitsOf } from "./schema.js";
import { get, upload } from "./server.js";

export const idOf = (path) => `field-${dotted(path)}`;

// A field: label, control, description and room for problems.
export function field(path, node, required) {
  const key = path.at(-1), id = idOf(path);
  const description = [node.description, hint(node)].filter(Boolean).join(" · ");
  const control = make("div", { class: "control" }, controlFor(path, node, required));
  const label = make("label", { htmlFor: id, textContent: titleOf(key) });
  return make("div", { class: `field ${node.kind}`, "data-path": dotted(path), "data-key": key },
    label, control,
    description && make("p", {
      class: isPlain(node) ? "hidden" : "description", id: `${id}-description`, textContent: description,
    }),
    make("ul", { class: "problems", id: `${id}-problems` }));
}

// A description that adds nothing to label and example is for screen readers only.
const isPlain = (node) => /^an? [a-z ]+ with its unit, (any|zero or more|more than zero)$/.test(node.description);

// Hint about allowed values, where the description does not give them.
function hint(node) {
  const hints = [];
  if (node.kind === "number") hints.push(range(node));
  if (node.words?.length) hints.push(`or ${node.words.map((word) => `“${word}”`).join(", ")}`);
  if (node.many && node.kind !== "axes") hints.push("several with commas between");
  const usual = node.default;
  if (usual !== null && usual !== undefined && !["", true, false].includes(usual) && typeof usual !== "object")
    hints.push(`${asText(usual)} if empty`);
  return hints.filter(Boolean).join("; ");
}

function range({ whole, least, most, above, below }) {
  const low = least !== undefined ? `from ${asText(least)}` : above !== undefined ? `above ${above}` : "";
  const high = most !== undefined ? `to ${most}` : below !== undefined ? `below ${below}` : "";
  const bounds = [low, high].filter(Boolean).join(" ");
  return [whole ? "whole number" : bounds ? "" : "number", bounds].filter(Boolean).join(" ");
}

function controlFor(path, node, required) {
  if (node.kind === "choice") return choice(path, node, required);
  if (node.kind === "switch") return toggle(path, node);
  if (node.kind === "axes") return axes(path, node);
  if (node.kind === "set") return choices(path, node);
  if (node.kind === "tuple") return node.items.map((item, index) => entry([...path, index], item, {
    label: `${titleOf(path.at(-1))}, ${index + 1} of ${node.items.length}`, example: node.examples[0]?.[index],
  }));
  if (node.kind === "lines") return lines(path);
  if (node.kind === "mapping") return mapping(path);
  return entry(path, node, { required });
}

// A text field. `label` is needed where there is no visible one.
export function entry(path, node, { label = null, required = true, example = node.examples?.[0] } = {}) {
  const id = idOf(path), key = path.at(-1);
  const input = make("input", {
    id, type: "text", autocomplete: "off", spellcheck: false, autocapitalize: "off",
    value: asText(valueAt(path)), placeholder: placeholder(required, asText(example)),
    "aria-label": label, "aria-describedby": label ? null : `${id}-description ${id}-problems`,
    "data-path": label ? dotted(path) : null, inputMode: node.kind === "number" ? "decimal" : "text",
    oninput: () => setValue(path, asValue(input.value, node)),
  });
  if (FILES.has(key)) return fileEntry(path, input);
  if (node.kind === "text" && node.dimension) suggestUnits(input, node);
  else if (node.words?.length) suggest(input, node.words);
  return input;
}

const placeholder = (required, example) =>
  [required ? "" : "optional", example && `e.g. ${example}`].filter(Boolean).join(", ");

function asText(value) {
  if (value === undefined || value === null) return "";
  if (typeof value === "number" && value !== 0 && Math.abs(value) < 1e-3) return value.toExponential();
  if (Array.isArray(value)) return value.map(asText).join(", ");
  if (typeof value !== "object") return String(value);
  return `{${Object.entries(value).map(([key, each]) => `${key}: ${asText(each)}`).join(", ")}}`;
}

// Numbers as numbers where the schema asks for them; other values as typed.
function asValue(typed, node) {
  const text = typed.trim();
  if (node.mapped && /^\{.*\}$/.test(text)) return asMapping(text);
  const plain = text !== "" && /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text);
  if ((node.kind === "number" || node.numeric) && plain) return Number(text);
  if (node.many && text.includes(",")) return text.split(",").map((part) => part.trim());
  if (node.many && text && !node.words.includes(text) && node.words.length) return [text];
  return text;
}

// Keys with values, as in {from: 1 mm/s, to: 1 m/s, count: 7}.
function asMapping(text) {
  const pairs = text.slice(1, -1).split(",").map((part) => part.split(":").map((word) => word.trim()));
  const value = (word) => (/^\d+$/.test(word) ? Number(word) : word);
  return Object.fromEntries(pairs.filter(([key]) => key).map(([key, word = ""]) => [key, value(word)]));
}

function suggest(input, options) {
  const list = make("datalist", { id: `${input.id}-options` }, options.map((value) => make("option", { value })));
  input.setAttribute("list", list.id);
  queueMicrotask(() => input.after(list));
  return list;
}

// The typed number with each usual unit.
function suggestUnits(input, node) {
  const list = suggest(input, []);
  const offer = () => {
    const number = input.value.match(/^\s*[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/i)?.[0].trim();
    const offered = number ? unitsOf(node.dimension).map((unit) => `${number} ${unit}`) : [];
    list.replaceChildren(...[...offered, ...(node.words ?? [])].map((value) => make("option", { value })));
  };
  input.addEventListener("focus", offer);
  input.addEventListener("input", offer);
}

function choice(path, node, required) {
  const value = valueAt(path), usual = node.default ?? "";
  const option = (each, text, selected) => make("option", { value: each, textContent: text, selected });
  const options = node.options.map((each) => option(each, titleOf(each), each === (value ?? usual)));
  const none = !required && !node.options.includes(usual) && option("", "—", value === undefined);
  const strange = value !== undefined && !node.options.includes(value) && option(value, String(value), true);
  const select = make("select", {
    id: idOf(path), "aria-describedby": `${idOf(path)}-description ${idOf(path)}-problems`,
    onchange: () => {
      const group = path.slice(0, -1);
      putBack(group);
      setValue(path, select.value === usual && !required ? undefined : select.value);
      chosen(group);
      changed("structure");
    },
  }, none, strange, options);
  return select;
}

function toggle(path, node) {
  if (node.optional && node.default === null) return decision(path);
  const usual = node.default ?? false, given = valueAt(path);
  // One for each entry of a list, such as the layers.
  if (Array.isArray(given)) return given.map((checked, index) => make("input", {
    type: "checkbox", checked, "aria-label": `${titleOf(path.at(-1))}, ${index + 1} of ${given.length}`,
    onchange: (event) => setValue([...path, index], event.target.checked),
  }));
  const box = make("input", {
    id: idOf(path), type: "checkbox", checked: valueAt(path) ?? usual, "aria-describedby": `${idOf(path)}-description`,
    onchange: () => setValue(path, box.checked === usual ? undefined : box.checked),
  });
  return box;
}

// A switch that is neither on nor off when left out.
function decision(path) {
  const value = valueAt(path);
  const option = (name, text, given) => make("option", { value: name, textContent: text, selected: value === given });
  const select = make("select", {
    id: idOf(path), "aria-describedby": `${idOf(path)}-description ${idOf(path)}-problems`,
    onchange: () => setValue(path, { yes: true, no: false }[select.value]),
  }, option("", "—", undefined), option("yes", "yes", true), option("no", "no", false));
  return select;
}

// Switches of x and y: true or false where both agree, else a pair.
function axes(path, node) {
  const given = valueAt(path) ?? node.default ?? false;
  const write = () => {
    const on = boxes.map((box) => box.checked);
    const value = on[0] === on[1] ? on[0] : on;
    setValue(path, value === (node.default ?? false) ? undefined : value);
  };
  const boxes = ["x", "y"].map((axis, index) => make("input", {
    type: "checkbox", value: axis, checked: (Array.isArray(given) ? given[index] : given) === true, onchange: write,
  }));
  return group(path, boxes, (box) => `along ${box.value}`);
}

// Boxes with their labels.
function group(path, boxes, label) {
  return make("div", { class: "boxes", role: "group", "aria-label": titleOf(path.at(-1)), id: idOf(path), tabIndex: -1 },
    boxes.map((box) => make("label", {}, box, ` ${label(box)}`)));
}

function choices(path, node) {
  const write = () => {
    const chosen = boxes.filter((box) => box.checked).map((box) => box.value);
    setValue(path, chosen);
  };
  const given = [valueAt(path) ?? []].flat();
  const boxes = node.item.options.map((value) =>
    make("input", { type: "checkbox", value, checked: given.includes(value), onchange: write }));
  return group(path, boxes, (box) => titleOf(box.value));
}

function lines(path) {
  const given = [valueAt(path) ?? []].flat();
  const area = make("textarea", {
    id: idOf(path), rows: Math.max(3, given.length + 1), value: given.join("\n"), spellcheck: false,
    oninput: () => setValue(path, area.value.split("\n").map((line) => line.trim()).filter(Boolean)),
  });
  return area;
}

function mapping(path) {
  const given = valueAt(path) ?? {};
  const read = (text) => {
    const found = text.split("\n").map((line) => line.match(/^\s*([^:]+):\s*(.*)$/)).filter(Boolean);
    return Object.fromEntries(found.map(([, key, value]) => [key.trim(), value.trim() || null]));
  };
  const area = make("textarea", {
    id: idOf(path), rows: 2, spellcheck: false, placeholder: "name: value",
    value: Object.entries(given).map(([key, value]) => `${key}: ${value ?? ""}`).join("\n"),
    oninput: () => setValue(path, read(area.value)),
  });
  return area;
}

export function fileEntry(path, input) {
  const list = suggest(input, []);
  input.addEventListener("focus", async () => {
    const files = await get("/api/files").catch(() => []);
    list.replaceChildren(...files.map((file) => make("option", { value: file.name })));
  });
  const chosen = make("input", { type: "file", class: "hidden", tabIndex: -1, "aria-label": "File to upload" });
  chosen.addEventListener("change", async () => {
    const file = chosen.files[0];
    if (!file) return;
    chosen.value = "";
    try {
      input.value = (await upload(file)).name;
      input.dispatchEvent(new Event("input"));
    } catch (detail) {
      input.dispatchEvent(new CustomEvent("refused", { bubbles: true, detail }));
    }
  });
  const button = make("button", { type: "button", textContent: "Upload…", onclick: () => chosen.click() });
  return make("div", { class: "file" }, input, button, chosen);
}
