// Light or dark, by the system's wish or one's own; colours for figures.

import { place } from "./dom.js";

const KEY = "viscontact.theme";
const system = window.matchMedia("(prefers-color-scheme: dark)");
const told = new EventTarget();

export const onTheme = (act) => told.addEventListener("change", act);
const chosen = () => document.documentElement.dataset.theme ?? "auto";
export const isDark = () => (chosen() === "auto" ? system.matches : chosen() === "dark");

export function setUpTheme() {
  const select = place("theme");
  try {
    select.value = localStorage.getItem(KEY) ?? "auto";
  } catch { /* a browser that keeps nothing */ }
  const apply = () => {
    document.documentElement.dataset.theme = select.value;
    told.dispatchEvent(new Event("change"));
  };
  select.addEventListener("change", () => {
    try { localStorage.setItem(KEY, select.value); } catch { /* likewise */ }
    apply();
  });
  system.addEventListener("change", apply);
  apply();
}

// A colour of the page's style as figures take it.
export function colour(name) {
  const probe = place("probe");
  probe.style.color = `var(--${name})`;
  return getComputedStyle(probe).color;
}

export const faded = (name, part) => colour(name).replace(/rgba?\(([^)]+)\)/, (_, parts) => {
  const [red, green, blue] = parts.split(/[ ,/]+/);
  return `rgba(${red}, ${green}, ${blue}, ${part})`;
});
