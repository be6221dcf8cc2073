// Shows figures that are made in Python. Their frames are the places of a slider, or scales of an axis.

const place = (id) => document.getElementById(id);
const boxes = () => document.querySelectorAll(".plot");
// Scrolling with a finger must not zoom the figures.
const byFinger = () => window.matchMedia("(pointer: coarse)").matches || window.innerWidth < 640;

const config = ({ name }) => ({
  responsive: true, displaylogo: false, displayModeBar: name === "map" && !byFinger() ? "hover" : false,
  doubleClick: "reset", modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
  toImageButtonOptions: { format: "svg" },
});

// Maps come in steps of their largest magnitude, two bytes each, signed with tension; 0 is no value.
function unpacked({ bdata, dtype, shape, step }) {
  const bytes = Uint8Array.from(atob(bdata), (letter) => letter.charCodeAt(0));
  const parts = new DataView(bytes.buffer), [rows, columns] = shape.split(",").map(Number);
  const read = dtype === "i2" ? "getInt16" : "getUint16";
  const value = (index) => parts[read](2 * index, true) * step || NaN;
  return Array.from({ length: rows }, (_, row) => Float32Array.from({ length: columns }, (__, column) => value(row * columns + column)));
}

// Draws a figure in a box; one in true shape has the height for its width.
export function draw(box, figure) {
  box.figure = figure;
  const { data, layout } = figure, { meta } = layout, { ratio, around, most } = meta;
  for (const trace of data) if (trace.z?.step) trace.z = unpacked(trace.z);
  if (ratio) {
    const height = Math.max((box.clientWidth - 80) * ratio + around, around + 60);
    box.style.height = `${Math.round(Math.min(height, most))}px`;
  }
  for (const part of ["title", "note"])
    for (const element of document.querySelectorAll(`[data-${part}="${meta.name}"]`))
      element.textContent = meta[part] ?? "";
  // A copy, as Plotly changes the ranges of axes in true shape.
  const dragmode = byFinger() ? false : "zoom";
  return window.Plotly.react(box, data, structuredClone({ ...layout, dragmode }), config(meta));
}

// Colours of the map go over the values of all its frames, or over those of the one shown.
let scale = "all";
function coloured({ data, layout: { meta } }) {
  if (meta.limits) [data[0].zmin, data[0].zmax] = meta.limits[scale];
}

// Shows a frame in all figures that have it.
export function show(name) {
  for (const box of boxes()) {
    const frame = box.figure?.frames?.find((each) => each.name === name);
    if (!frame) continue;
    const { data, layout } = box.figure;
    frame.data.forEach((part, index) => Object.assign(data[frame.traces[index]], part));
    Object.assign(layout, frame.layout);
    coloured(box.figure);
    draw(box, box.figure);
  }
}

// A slider over the frames "0", "1" and so on, and a button that plays them.
export function followSlider(slider, button) {
  let clock = null;
  const pause = () => { clearInterval(clock); clock = null; button.textContent = "Play"; };
  const go = (index) => {
    slider.value = String(index);
    show(slider.value);
    slider.setAttribute("aria-valuetext", place("map").figure.layout.meta.title);
  };
  const step = () => (Number(slider.value) < Number(slider.max) ? go(Number(slider.value) + 1) : pause());
  slider.addEventListener("input", () => go(slider.value));
  slider.addEventListener("pointerdown", pause);
  button.addEventListener("click", () => {
    if (clock !== null) { pause(); return; }
    if (slider.value === slider.max) go(0);
    button.textContent = "Stop";
    clock = setInterval(step, 800);
  });
}

// A button that shows the frame "log" or "linear"; it has the words for both.
export function followScale(button) {
  const other = () => (button.dataset.shown === "log" ? "linear" : "log");
  button.addEventListener("click", () => {
    button.dataset.shown = other();
    show(button.dataset.shown);
    button.textContent = button.dataset[other()];
  });
}

// A button that gives each frame of the map colours of its own, or all the same; it has the words for both.
export function followColours(button) {
  const tell = () => { button.textContent = button.dataset[scale === "all" ? "each" : "all"]; };
  button.addEventListener("click", () => {
    scale = scale === "all" ? "each" : "all";
    tell();
    const { figure } = place("map");
    coloured(figure);
    draw(place("map"), figure);
  });
  tell();
}

// The height of a figure in true shape depends on the width, which changes with the window.
let settling = null;
window.addEventListener("resize", () => {
  clearTimeout(settling);
  settling = setTimeout(() => boxes().forEach((box) => box.figure?.layout.meta.ratio && draw(box, box.figure)), 150);
});

// Draws the figures of a page in their boxes, which have their names; the text is shown first.
export function open(figures) {
  if (byFinger()) place("zoom-hint")?.remove();
  if (place("slider")) followSlider(place("slider"), place("play"));
  if (place("time-scale")) followScale(place("time-scale"));
  if (place("map-scale")) followColours(place("map-scale"));
  const drawNext = () => {
    const figure = figures.shift();
    if (!figure) { document.documentElement.dataset.drawn = "yes"; return; }
    draw(place(figure.layout.meta.name), figure);
    setTimeout(drawNext);
  };
  requestAnimationFrame(() => setTimeout(drawNext));
}
