// Hints about keys that the schema does not contain: order, names, and less common keys.
// Keys not listed here are shown by default.

// Example that the page starts with.
export const START = "roller-dogbone";

// Sections and keys that come first, in this order; others follow in the order of the schema.
export const FIRST = [
  "title", "indenter", "thickness", "material", "load", "time",
  "file", "points", "sentences", "force", "line_load", "approach", "mean", "amplitude",
  "radius", "half_length", "shear_modulus", "youngs_modulus",
];

// Keys that are folded until they are set or have a problem.
export const LATER = new Set([
  "indenter_material", "rolling", "grid", "output", "report", "allowable", "leakage", "tolerance",
  "rotation", "offset_x", "offset_y", "cross_section",
  "bulk_modulus", "measured_until", "thickness", "temperature", "shift", "ageing", "warning",
  "mean_pressure", "tilt_x", "tilt_y", "eccentricity_y", "phase",
  "first", "periodic", "centre", "quantities", "largest_cell", "columns", "start", "set", "before", "beyond",
  "height_factor", "channel", "width", "flip", "crop", "missing", "resample", "filter", "cutoff",
]);

// Keys with alternatives, so that the schema does not require them, although one of them is needed.
export const FILLED = {
  shear_modulus: null, force: null, poisson_ratio: 0.35, mean: "20 kN", points: null, wavelength_x: null,
};
// The alternatives.
export const INSTEAD = {
  force: ["approach", "mean_pressure", "line_load"], mean: ["approach", "line_load"], shear_modulus: ["youngs_modulus"],
  poisson_ratio: ["bulk_modulus"], points: ["file", "sentences", "mean_pressure"], wavelength_x: ["wavelength_y"],
  tilt_y: ["tilt_y", "eccentricity_y"],
};

// Keys that exclude each other: values of one are dropped when the other is set, as for a punch that
// is round or rectangular.
export const APART = { half_length: ["radius"], half_width: ["radius"] };

// Values that go with a kind of a section, by the kind: set where the kind is chosen, and put back
// where it is left out. A null leaves the key out. A body on an axle does not tilt, and steps of a
// cell of way are exact in place. Steady motion has no time. A cylinder without end has an automatic
// grid, and what presses it is a force per length, in place of a force.
const ON_AXLE = { "load.tilt_y": 0 };
const BY_CELLS = { "time.spacing": "cells", "time.steps": null, "time.first": null, "time.tolerance": null };
const PER_LENGTH = {
  grid: null, "load.line_load": { value: "40 N/mm", inPlaceOf: ["force", "approach", "mean"] },
  "load.eccentricity_x": null, "load.tilt_x": null,
};
const AS_FORCE = { "load.force": { value: "10 N", inPlaceOf: ["line_load"], unless: "grid.periodic" } };
// Those of the empty name go with all other kinds.
export const WITH = {
  indenter: { cylinder: PER_LENGTH, "": AS_FORCE },
  motion: {
    travel: { ...ON_AXLE, ...BY_CELLS }, reciprocating: { ...ON_AXLE, ...BY_CELLS },
    steady: { ...ON_AXLE, time: null, "output.fields": null },
  },
};

// Keys of files, which can be uploaded.
export const FILES = new Set(["file"]);

const NAMES = {
  poisson_ratio: "Poisson’s ratio", youngs_modulus: "Young’s modulus", wlf: "WLF",
  "iso-16281": "ISO 16281", "two-radii": "Two radii",
  indenter_material: "Indenter’s material", x: "x", y: "y",
};

// Title of a key: "half_length" becomes "Half length", unless it is listed above.
export function titleOf(key) {
  const words = String(key).replaceAll("_", " ").replaceAll("-", " ");
  return NAMES[key] ?? words.charAt(0).toUpperCase() + words.slice(1);
}
