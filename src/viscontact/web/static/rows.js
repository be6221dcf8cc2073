// Lists as tables: terms of a series, points as pairs, single values.

import { changed, dotted, setValue, valueAt } from "./draft.js";
import { make } from "./dom.js";
import { entry } from "./fields.js";
import { titleOf } from "./hints.js";
import { startOf } from "./schema.js";

// Related lists: all required lists of single values in a group, row by row.
export function terms(path, keys) {
  const columns = keys.map(({ key, node }) => (
    { path: [...path, key], node: node.item, title: titleOf(key), description: node.description }));
  const count = Math.max(1, ...columns.map((column) => lengthOf(column.path)));
  const cells = (row) => columns.map(({ path: at, node, title }) => (
    { path: [...at, row], node, label: `${title}, term ${row + 1}` }));
  return table(path, columns, count, cells, {
    name: "term",
    add: () => columns.forEach((column) => setValue([...column.path, count], last(column))),
    drop: (row) => columns.forEach((column) => setValue(column.path, without(row, column.path))),
  });
}

// List of single values or of tuples under one key.
export function list(path, node) {
  const tuple = node.item.kind === "tuple" ? node.item.items : null;
  // Names of the columns where the description begins with them: [time, position] each.
  const named = node.description?.match(/^\[([a-z ,]+)\] each/)?.[1].split(", ").map(titleOf) ?? [];
  const columns = (tuple ?? [node.item]).map((item, index, { length }) => (
    { path, node: item, title: named.length === length ? named[index] : columnName(item, path) }));
  const count = lengthOf(path);
  const cells = (row) => columns.map((column, index) => ({
    path: tuple ? [...path, row, index] : [...path, row], node: column.node, label: `${column.title}, row ${row + 1}`,
  }));
  const before = () => structuredClone((valueAt(path) ?? []).at(-1));
  const box = table(path, columns, count, cells, {
    name: tuple ? "row" : "value",
    add: () => setValue([...path, count], before() ?? startOf(node.item)),
    drop: (row) => setValue(path, without(row, path)),
  });
  return make("div", { class: "field list", "data-path": dotted(path), "data-key": path.at(-1) },
    make("span", { class: "label", textContent: titleOf(path.at(-1)) }), box,
    node.description && make("p", { class: "description", textContent: node.description }),
    make("ul", { class: "problems" }));
}

const lengthOf = (path) => (Array.isArray(valueAt(path)) ? valueAt(path).length : 0);
const without = (row, path) => (valueAt(path) ?? []).filter((_, index) => index !== row);
const columnName = (item, path) => titleOf(item.dimension ? [item.dimension].flat().join(" or ") : path.at(-1));
const last = (column) => (valueAt(column.path) ?? []).at(-1) ?? startOf(column.node);

function table(path, columns, count, cells, { name, add, drop }) {
  const act = (what) => () => { what(); changed("structure"); };
  const head = make("tr", {}, columns.map((column) =>
    make("th", { scope: "col" }, column.title,
      column.description && make("small", { textContent: column.description }))),
    make("th", {}, make("span", { class: "hidden", textContent: "Remove" })));
  const rows = Array.from({ length: count }, (_, row) => {
    const inputs = cells(row).map((cell) => {
      const made = entry(cell.path, cell.node, { label: cell.label });
      return make("td", {}, pasting(made, row, columns, cells));
    });
    const button = make("button", {
      type: "button", class: "quiet", textContent: "×", title: `Remove this ${name}`,
      "aria-label": `Remove ${name} ${row + 1}`, onclick: act(() => drop(row)),
    });
    return make("tr", {}, inputs, make("td", {}, button));
  });
  const more = { type: "button", class: "add", "data-add": dotted(path), onclick: act(add) };
  return make("div", { class: "rows" },
    count > 0 && make("table", {}, make("thead", {}, head), make("tbody", {}, rows)),
    make("button", more, `Add a ${name}`));
}

// A block pasted from a spreadsheet fills the following rows; numbers without a unit get the unit
// of the cell that they replace.
function pasting(input, row, columns, cells) {
  input.addEventListener("paste", (event) => {
    const copied = event.clipboardData.getData("text/plain").trim();
    if (!/[\n\t]/.test(copied)) return;
    event.preventDefault();
    const column = cells(row).findIndex((cell) => input.dataset.path === dotted(cell.path));
    copied.split(/\r?\n/).forEach((line, down) => line.split(/\t|;/).forEach((word, across) => {
      const over = cells(row)[column + across], cell = cells(row + down)[column + across];
      if (cell) setValue(cell.path, withUnit(word.trim(), String(valueAt(over.path) ?? over.node.examples[0] ?? "")));
    }));
    changed("structure");
  });
  return input;
}

function withUnit(word, like) {
  const unit = like.replace(/^\s*[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?\s*/i, "");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(word) && unit ? `${word} ${unit}` : word;
}
