"""Unknown keys and values of a case file: the nearest in meaning or in spelling, and refusals."""

from __future__ import annotations

import difflib

#: Words of other programs and of the field for a shape, law, kind or value.
_OTHER_VALUES = {
    **{"roll": "cylinder", "ball": "sphere", "crowned": "partial", "straight": "cylindrical"},
    **{"ring": "torus", "o-ring": "torus", "wave": "waviness", "wheel": "roller"},
    **{"prony": "relaxation-series", "generalized-maxwell": "relaxation-series"},
    **{"fractional": "fractional-zener", "spring-pot": "power-law", "csv": "table"},
    **{"abaqus": "card", "ansys": "card", "ls-dyna": "card", "tabulated": "table"},
    **{"standard-linear-solid": "zener", "sls": "zener", "constant": "step"},
    **{"hooke": "elastic", "linear-elastic": "elastic", "kelvin-voigt": "zener"},
    **{"sine": "harmonic", "sinusoidal": "harmonic", "cyclic": "harmonic"},
    **{"points": "history", "sentences": "history", "file": "history"},
    **{"path": "travel", "oscillating": "reciprocating"},
    **{"rolling": "steady", "sliding": "steady", "constant-speed": "steady"},
    **{"logarithmic": "log", "logspace": "log", "linear": "uniform", "linspace": "uniform"},
    **{"log": "logarithmic", "e": "uniaxial", "tension": "uniaxial", "tensile": "uniaxial"},
    **{"creep-modulus": "uniaxial", "creep_modulus": "uniaxial", "g": "shear", "torsion": "shear"},
    **{
        "hollow": "height-map",
        "surface": "height-map",
        "map": "height-map",
        "cuboid": "flat-punch",
    },
}

_UNIAXIAL = "with data: uniaxial"
_YOUNGS_MODULUS = {
    "youngs_modulus": "",
    "effective_modulus": "",
    "equilibrium": f"and moduli, {_UNIAXIAL}",
    "instant": f"its inverse 1/E, {_UNIAXIAL}",
    "compliance": f"its inverse 1/E, {_UNIAXIAL}",
}
_SHEAR_MODULUS = {
    "shear_modulus": "",
    "equilibrium": "and moduli, with data: shear",
    "instant": "its inverse 1/G, with data: shear",
    "compliance": "its inverse 1/G, with data: shear",
}
_POISSON = {"poisson_ratio": ""}
#: Moduli just after a step and long after it: of a series the sum of all, and the equilibrium.
_INITIAL_MODULUS = {
    "youngs_modulus": "",
    "moduli": f"[E_1, E_2, ...], which add up to E0 with equilibrium, {_UNIAXIAL}",
    "instant": f"its inverse 1/E0, {_UNIAXIAL}",
}
_INITIAL_SHEAR_MODULUS = {
    "shear_modulus": "",
    "moduli": "[G_1, G_2, ...], which add up to G0 with equilibrium, with data: shear",
    "instant": "its inverse 1/G0, with data: shear",
}
_FINAL_MODULUS = {
    "equilibrium": _UNIAXIAL,
    "equilibrium_modulus": "",
    "delayed_modulus": "beside youngs_modulus, with 1/E_inf = 1/youngs_modulus + 1/delayed_modulus",
}
_FINAL_SHEAR_MODULUS = {
    "equilibrium": "with data: shear",
    "equilibrium_modulus": "",
    "delayed_modulus": "beside shear_modulus, with 1/G_inf = 1/shear_modulus + 1/delayed_modulus",
}
_FORCE = {"force": "", "mean": ""}
_APPROACH = {"approach": ""}

#: Other words for keys, and the keys meant, of which the first that a section has is suggested.
_SYNONYMS: tuple[tuple[str, dict[str, str]], ...] = (
    ("nu poisson poissons_ratio poisson's_ratio", {"poisson_ratio": ""}),
    ("e young youngs_modulus young_modulus modulus", _YOUNGS_MODULUS),
    ("elastic_modulus tensile_modulus e_modulus", _YOUNGS_MODULUS),
    ("g shear_modulus rigidity", _SHEAR_MODULUS),
    ("e0 e_0 initial_modulus", _INITIAL_MODULUS),
    ("g0 g_0", _INITIAL_SHEAR_MODULUS),
    ("einf e_inf e_infinity long_term_modulus", _FINAL_MODULUS),
    ("ginf g_inf g_infinity", _FINAL_SHEAR_MODULUS),
    ("stiffness stiffness_factor modulus_factor factor scaling", {"scale": ""}),
    ("yield_strength yield yield_point proof_stress", {"yield_stress": ""}),
    ("endurance_limit fatigue fatigue_strength", {"fatigue_limit": ""}),
    ("k compression_modulus", {"bulk_modulus": ""}),
    ("eta damping", {"viscosity": ""}),
    ("tau relaxation_time", {"times": "", "time": ""}),
    ("relaxation_times retardation_times", {"times": ""}),
    ("prony coefficients", {"moduli": "", "amplitudes": ""}),
    ("creep_modulus tan_delta loss_factor storage_modulus dma", {"file": "with law: table"}),
    ("creep_compliance relaxation_modulus isochronous data_file", {"file": "with law: table"}),
    ("load normal_load normal_force weight preload f p", {"force": "", "mean": ""}),
    ("moment torque", {"eccentricity_x": "or eccentricity_y, moment divided by force"}),
    ("force", {"mean": ""}),
    ("depth indentation displacement penetration", {"approach": ""}),
    ("r curvature_radius", {"radius": "", "radius_x": "and radius_y"}),
    ("d dia", {"diameter": ""}),
    ("l total_length width face_width", {"length": "", "half_length": ""}),
    ("crown crowning end_radius", {"crown_radius": "", "profile": ""}),
    ("tilt skew inclination", {"misalignment": "", "tilt_x": "or tilt_y"}),
    ("eccentricity offset", {"eccentricity_x": "", "offset_x": ""}),
    ("freq hz", {"frequency": ""}),
    ("velocity v", {"speed": ""}),
    ("speed", {"points": ""}),
    ("temp t ambient temperatures", {"temperature": ""}),
    ("aging struik", {"ageing": ""}),
    ("duration total_time until t_end", {"end": "", "time": ""}),
    ("dt time_step increments n", {"steps": ""}),
    ("cells resolution nx ny", {"shape": ""}),
    ("domain extent", {"size": ""}),
    ("name description comment", {"title": ""}),
    ("body roller ball punch shape", {"indenter": ""}),
    ("core substrate backing", {"base": "", "material": ""}),
    ("sample half_space law", {"material": ""}),
    ("layer coating cover covering lining tyre tire film", {"layers": "under material"}),
    ("times end", {"time": "", "end": ""}),
    ("mesh discretisation discretization", {"grid": ""}),
)
_MEANINGS = {word: meant for words, meant in _SYNONYMS for word in words.split()}

_PLASTICITY = "plasticity is not available: the materials are linear viscoelastic"
_HARDNESS = (
    "write 'shore_a: 70' or 'shore_d: 45' in a material: the stiffness of a rubber is estimated "
    "from it, with a wide range. A hardness does not determine how a material creeps: for that "
    "give a law beside it, which is scaled, see 'Bring your creep data' in the manual "
    "(howto/creep-data)"
)
_FRICTION = (
    "friction is a section at the top of the case: write 'friction: {coefficient: 0.3}', and the "
    "load along the surface as 'tangential: {kind: step, force_x: 1.5 N}'"
)
_ADHESION = (
    "adhesion is a section at the top of the case: write 'adhesion: {work: 50 mJ/m2, range: 2 nm}'"
)
_HEAT = (
    "heat is not computed during a run: give the temperature of the bodies, constant or over time, "
    "by temperature: at the top of the case"
)

#: Effects that are not modelled, by the words that ask for them.
_NOT_AVAILABLE = {
    **dict.fromkeys(("plasticity", "hardening"), _PLASTICITY),
    **dict.fromkeys(("heat", "thermal_expansion", "conductivity", "heat_flux"), _HEAT),
    "wear": "wear is not available: the shapes do not change",
    "damage": "damage is not available: the materials do not break",
    **dict.fromkeys(
        ("lubricant", "oil", "film_thickness", "lubrication"),
        "lubrication is not available: the contact is dry",
    ),
    **dict.fromkeys(
        ("density", "mass", "inertia"), "inertia is not available: loads change slowly"
    ),
    "anisotropy": "anisotropy is not available: the materials are isotropic",
}


#: Measures that no key takes, with what to give instead.
_INSTEAD = {
    **dict.fromkeys(("hardness", "shore", "shore_hardness", "irhd", "durometer"), _HARDNESS),
    **dict.fromkeys(("friction", "friction_coefficient", "mu", "cof", "traction"), _FRICTION),
    **dict.fromkeys(("adhesion", "work_of_adhesion", "surface_energy", "jkr", "dmt"), _ADHESION),
}


def unknown_word(what: str, given: object, allowed: list[str]) -> str:
    """Message about an unknown key or value, with the nearest one and all that are allowed."""
    word = _spelling(given)
    if what == "key" and word in _NOT_AVAILABLE:
        return f"{_NOT_AVAILABLE[word]}; see 'Limits' in the manual (trust/limits)"
    if what == "key" and word in _INSTEAD:
        return _INSTEAD[word]
    shown = "" if what == "key" else f" {str(given)[:40]!r}"
    return f"unknown {what}{shown}{_hint(what, given, allowed)} Allowed: {', '.join(allowed)}"


def _hint(what: str, given: object, allowed: list[str]) -> str:
    if what != "key" or not meanings(given):
        near = nearest_word(given, allowed)
        return f"; did you mean {near!r}?" if near else "."
    # A key that is known to mean another one is not compared by its spelling.
    key = next((each for each in meanings(given) if each in allowed), None)
    remark = "" if key is None else meanings(given)[key]
    return f"; did you mean {key!r}{f', {remark}' if remark else ''}?" if key else "."


def meanings(given: object) -> dict[str, str]:
    """Keys that another word for a key may mean, the likeliest first, with a remark on each."""
    return _MEANINGS.get(_spelling(given), {})


def nearest_word(given: object, allowed: list[str]) -> str | None:
    """Nearest allowed word in meaning or in spelling, None if there is none."""
    known = _OTHER_VALUES.get(str(given).lower())
    if known in allowed:
        return known
    return next(iter(difflib.get_close_matches(str(given), allowed, n=1)), None)


def _spelling(given: object) -> str:
    return str(given).lower().replace("-", "_").replace(" ", "_")
