"""Unknown keys and values of a case file: the nearest in meaning or in spelling, and refusals."""

from __future__ import annotations

import difflib

#: Words of other programs and of the field for a shape, law, kind or value.
_OTHER_VALUES = {
    **{"cylinder": "roller", "ball": "sphere", "crowned": "partial", "straight": "cylindrical"},
    **{"ring": "torus", "o-ring": "torus", "wave": "waviness", "wheel": "roller"},
    **{"prony": "relaxation-series", "generalized-maxwell": "relaxation-series"},
    **{"fractional": "fractional-zener", "spring-pot": "power-law", "csv": "table"},
    **{"abaqus": "card", "ansys": "card", "tabulated": "table"},
    **{"standard-linear-solid": "zener", "sls": "zener", "constant": "step"},
    **{"hooke": "elastic", "linear-elastic": "elastic", "kelvin-voigt": "zener"},
    **{"sine": "harmonic", "sinusoidal": "harmonic", "cyclic": "harmonic"},
    **{"points": "history", "sentences": "history", "file": "history"},
    **{"path": "travel", "oscillating": "reciprocating"},
    **{"logarithmic": "log", "logspace": "log", "linear": "uniform", "linspace": "uniform"},
    **{
        "hollow": "height-map",
        "surface": "height-map",
        "map": "height-map",
        "cuboid": "flat-punch",
    },
}

_UNIAXIAL = "with data: uniaxial"
_YOUNGS_MODULUS = {
    "youngs_modulus": _UNIAXIAL,
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
_FORCE = {"force": "", "mean": ""}
_APPROACH = {"approach": ""}

#: Other words for keys, and the keys meant, of which the first that a section has is suggested.
_SYNONYMS: tuple[tuple[str, dict[str, str]], ...] = (
    ("nu poisson poissons_ratio poisson's_ratio", {"poisson_ratio": ""}),
    ("e young youngs_modulus young_modulus modulus", _YOUNGS_MODULUS),
    ("elastic_modulus tensile_modulus e_modulus", _YOUNGS_MODULUS),
    ("g shear_modulus rigidity", _SHEAR_MODULUS),
    ("k compression_modulus", {"bulk_modulus": ""}),
    ("eta damping", {"viscosity": ""}),
    ("tau relaxation_time", {"times": "", "time": ""}),
    ("relaxation_times retardation_times", {"times": ""}),
    ("prony coefficients", {"moduli": "", "amplitudes": ""}),
    ("load normal_load normal_force weight f p", {"force": "", "mean": ""}),
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
    ("temp", {"temperature": ""}),
    ("duration total_time until t_end", {"end": "", "time": ""}),
    ("dt time_step increments n", {"steps": ""}),
    ("cells resolution nx ny", {"shape": ""}),
    ("domain extent", {"size": ""}),
    ("name description comment", {"title": ""}),
    ("body roller ball punch shape", {"indenter": ""}),
    ("sample half_space substrate law", {"material": ""}),
    ("times end", {"time": "", "end": ""}),
    ("mesh discretisation discretization", {"grid": ""}),
)
_MEANINGS = {word: meant for words, meant in _SYNONYMS for word in words.split()}

_FRICTION = "friction is not available: the contact transmits pressure only"
_ADHESION = "adhesion is not available: the bodies do not attract each other"
_PLASTICITY = "plasticity is not available: the materials are linear viscoelastic"
_HEAT = "heating is not available: the temperature is constant during a run"

#: Effects that are not modelled, by the words that ask for them.
_NOT_AVAILABLE = {
    **dict.fromkeys(("friction", "friction_coefficient", "mu", "cof", "traction"), _FRICTION),
    **dict.fromkeys(("adhesion", "work_of_adhesion", "surface_energy", "jkr", "dmt"), _ADHESION),
    **dict.fromkeys(("plasticity", "yield_stress", "yield_strength", "hardness"), _PLASTICITY),
    **dict.fromkeys(("heat", "thermal_expansion", "conductivity", "heat_flux"), _HEAT),
    "wear": "wear is not available: the shapes do not change",
    "damage": "damage is not available: the materials do not age or break",
    **dict.fromkeys(
        ("lubricant", "oil", "film_thickness", "lubrication"),
        "lubrication is not available: the contact is dry",
    ),
    **dict.fromkeys(
        ("density", "mass", "inertia"), "inertia is not available: loads change slowly"
    ),
    "anisotropy": "anisotropy is not available: the materials are isotropic",
}


def unknown_word(what: str, given: object, allowed: list[str]) -> str:
    """Message about an unknown key or value, with the nearest one and all that are allowed.

    >>> unknown_word("key", "nu", ["law", "poisson_ratio"])
    "unknown key; did you mean 'poisson_ratio'? Allowed: law, poisson_ratio"
    """
    word = _spelled(given)
    if what == "key" and word in _NOT_AVAILABLE:
        return f"{_NOT_AVAILABLE[word]}; see 'Limits' in the manual (trust/limits)"
    shown = "" if what == "key" else f" {str(given)[:40]!r}"
    return f"unknown {what}{shown}{_hint(what, given, allowed)} Allowed: {', '.join(allowed)}"


def _hint(what: str, given: object, allowed: list[str]) -> str:
    near = nearest_word(given, allowed)
    if what == "key":
        meant = _MEANINGS.get(_spelled(given), {})
        near = next((key for key in meant if key in allowed), near)
        remark = meant.get(near or "", "")
        return f"; did you mean {near!r}{f', {remark}' if remark else ''}?" if near else "."
    return f"; did you mean {near!r}?" if near else "."


def nearest_word(given: object, allowed: list[str]) -> str | None:
    """Nearest allowed word in meaning or in spelling, None if there is none."""
    known = _OTHER_VALUES.get(str(given).lower())
    if known in allowed:
        return known
    return next(iter(difflib.get_close_matches(str(given), allowed, n=1)), None)


def _spelled(given: object) -> str:
    return str(given).lower().replace("-", "_").replace(" ", "_")
