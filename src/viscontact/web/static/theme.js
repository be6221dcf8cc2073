// Light or dark theme, from the system or chosen; colours for figures.

import { place } from "./dom.js";

const KEY = "viscontact.theme";
const system = window.matchMedia("(prefers-color-scheme: dark)");
const changes = new EventTarget();

export const onTheme = (act) => changes.addEventListener("change", act);
const chosen = () => document.documentElement.dataset.theme ?? "auto";
export const isDark = () => (chosen() === "auto" ? system.matches : chosen() === "dark");

export function setUpTheme() {
  const select = place("theme");
  try {
    select.value = localStorage.getItem(KEY) ?? "auto";
  } catch { /* storage is disabled */ }
  const apply = () => {
    document.documentElement.dataset.theme = select.value;
    changes.dispatchEvent(new Event("change"));
  };
  select.addEventListener("change", () => {
    try { localStorage.setItem(KEY, select.value); } catch { /* storage is disabled */ }
    apply();
  });
  system.addEventListener("change", apply);
  apply();
}
