// Drawings of the shape, the material and the load, made by the server.

import { caseText, caseValues } from "./draft.js";
import { make, place } from "./dom.js";
import { post } from "./server.js";
import { isDark } from "./theme.js";

const KINDS = {
  indenter: { tab: "Shape", about: "Sections through the indenter and its plan, and the spectrum of a measured surface", section: "indenter" },
  material: { tab: "Material", about: "Creep compliance and relaxation modulus of the half-space, or fits to measured oscillations", section: "material" },
  load: { tab: "Load", about: "The load over time", section: "load" },
};
const BEFORE = "Drawing before the last change: the current values cannot be drawn.";
const narrow = window.matchMedia("(max-width: 860px)");
// On narrow pages the panels of a drawing are placed below each other.
const phone = window.matchMedia("(max-width: 640px)");
const boxes = {};
let request = null;
let shown = "indenter";
// Hidden drawings are made when they are shown.
const outdated = new Set();

export function setUpDrawings() {
  const tabs = Object.entries(KINDS).map(([kind, { tab }]) => make("button", {
    type: "button", role: "tab", id: `tab-${kind}`, "aria-controls": `drawing-${kind}`, textContent: tab,
    onclick: () => showDrawing(kind), onkeydown: (event) => walk(event, kind),
  }));
  place("drawing-tabs").append(...tabs);
  for (const [kind, { about }] of Object.entries(KINDS)) {
    const names = { id: `drawing-${kind}`, role: "tabpanel", "aria-labelledby": `tab-${kind}` };
    boxes[kind] = make("figure", { class: "drawing", ...names },
      make("div", { class: "pictures", "data-about": about }), make("p", { class: "description" }));
  }
  narrow.addEventListener("change", placeDrawings);
  place("form").addEventListener("focusin", (event) => {
    const section = event.target.closest("[data-section]")?.dataset.section;
    if (KINDS[section]) showDrawing(section);
  });
  for (const width of [narrow, phone]) width.addEventListener("change", () => draw());
  showDrawing("indenter");
  placeDrawings();
}

// On a narrow page each drawing is placed in its section, else they share one place.
export function placeDrawings() {
  for (const [kind, { section }] of Object.entries(KINDS)) {
    const slot = document.querySelector(`[data-slot="${section}"]`);
    (narrow.matches && slot ? slot : place("drawing")).append(boxes[kind]);
  }
}

function showDrawing(kind) {
  for (const each of Object.keys(KINDS)) {
    const tab = place(`tab-${each}`), chosen = each === kind;
    tab.setAttribute("aria-selected", String(chosen));
    tab.tabIndex = chosen ? 0 : -1;
    boxes[each].classList.toggle("chosen", chosen);
  }
  shown = kind;
  if (outdated.has(kind)) drawOne(kind, request?.signal);
}

function walk(event, kind) {
  const kinds = Object.keys(KINDS), step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
  if (!step) return;
  const next = kinds[(kinds.indexOf(kind) + step + kinds.length) % kinds.length];
  showDrawing(next);
  place(`tab-${next}`).focus();
}

export async function draw() {
  request?.abort();
  request = new AbortController();
  const { signal } = request;
  for (const kind of Object.keys(KINDS)) outdated.add(kind);
  const seen = narrow.matches ? Object.keys(KINDS) : [shown];
  await Promise.all(seen.map((kind) => drawOne(kind, signal)));
}

async function drawOne(kind, signal) {
  const pictures = boxes[kind].querySelector(".pictures"), note = boxes[kind].querySelector(".description");
  boxes[kind].setAttribute("aria-busy", "true");
  outdated.delete(kind);
  try {
    const query = { yaml: caseText(), what: kind, dark: isDark(), narrow: phone.matches };
    const drawn = await post("/api/drawing", query, signal);
    const before = [...pictures.querySelectorAll("img")].map((image) => image.src);
    pictures.replaceChildren(...drawn.flatMap(({ caption, svg }) =>
      [caption && make("p", { class: "description", textContent: caption }), svg && picture(svg, pictures.dataset.about)]
        .filter(Boolean)));
    before.forEach((address) => URL.revokeObjectURL(address));
    boxes[kind].classList.remove("stale");
    note.textContent = "";
  } catch (error) {
    if (error.name === "AbortError") {
      outdated.add(kind);
      return;
    }
    boxes[kind].classList.add("stale");
    note.textContent = pictures.firstChild ? BEFORE : missing(kind);
  }
  boxes[kind].removeAttribute("aria-busy");
}

function picture(svg, alt) {
  const src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  const image = make("img", { alt, src });
  // Letters about as large as those of the page.
  image.onload = () => {
    image.style.maxWidth = `${Math.round(1.12 * image.naturalWidth)}px`;
    image.style.minWidth = `${Math.round(0.72 * image.naturalWidth)}px`;
  };
  return make("div", { class: "scroll" }, image);
}

const missing = (kind) => (caseValues()[kind] ? "The values cannot be drawn yet." : "No values yet.");

// A drawing of the server with its caption.
export function drawing({ caption, svg }) {
  const src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  const image = make("img", { alt: caption, src, onload: () => URL.revokeObjectURL(src) });
  return make("figure", { class: "made" }, make("div", { class: "scroll" }, image), make("figcaption", { class: "faint", textContent: caption }));
}
