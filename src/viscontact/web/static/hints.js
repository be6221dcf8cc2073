// Hints about keys that the schema does not give: order, names, and what a beginner may skip.
// What is not named here is shown like everything else.

// Where the page begins.
export const START = "roller-dogbone";

// Sections and keys that stand first, in this order; others follow in the order of the schema.
export const FIRST = [
  "title", "indenter", "material", "load", "time",
  "file", "points", "sentences", "force", "approach", "mean", "amplitude",
  "radius", "half_length", "shear_modulus", "youngs_modulus",
];

// Folded away until they are set, or something is wrong with them.
export const LATER = new Set([
  "indenter_material", "grid", "output", "tolerance",
  "rotation", "offset_x", "offset_y", "cross_section",
  "bulk_modulus", "measured_until", "thickness", "temperature", "shift",
  "mean_pressure", "tilt_x", "tilt_y", "eccentricity_y", "phase",
  "first", "periodic", "quantities", "columns", "set", "before", "beyond",
  "height_factor", "channel", "width", "flip", "crop", "missing", "resample", "filter", "cutoff",
]);

// Another key could stand for each of these, so the schema does not require them; one is needed.
export const FILLED = {
  shear_modulus: null, force: null, poisson_ratio: 0.35, mean: "20 kN", points: null, wavelength_x: null,
};
// What stands for it instead.
export const INSTEAD = {
  force: ["approach", "mean_pressure"], mean: ["approach"], shear_modulus: ["youngs_modulus"],
  poisson_ratio: ["bulk_modulus"], points: ["file", "sentences", "mean_pressure"], wavelength_x: ["wavelength_y"],
};

// What another shape had under these keys is left behind where the other key comes along: a punch is
// round or rectangular.
export const APART = { half_length: ["radius"], half_width: ["radius"] };

// Paths of files, which may be uploaded.
export const FILES = new Set(["file"]);

const NAMES = {
  poisson_ratio: "Poisson’s ratio", youngs_modulus: "Young’s modulus", wlf: "WLF",
  "iso-16281": "ISO 16281", "two-radii": "Two radii",
  indenter_material: "Indenter’s material",
};

// "half_length" is "Half length", unless it has a name of its own.
export function titleOf(key) {
  const words = String(key).replaceAll("_", " ").replaceAll("-", " ");
  return NAMES[key] ?? words.charAt(0).toUpperCase() + words.slice(1);
}
