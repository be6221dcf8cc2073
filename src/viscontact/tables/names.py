"""Names of the columns of measured tables, and the quantities they mean."""

from __future__ import annotations

import re
from typing import Literal

from viscontact.backend.lazy_dataclass import dataclass

Data = Literal["deviatoric", "shear", "uniaxial"]

#: Quantities of a table, and the dimension of their unit; None for those without a unit. Those of a
#: tangential load are read where they are expected: a rheometer's torque has units of its own.
QUANTITIES: dict[str, str | None] = {
    "time": "time",
    "angular_frequency": "angular frequency",
    "creep_compliance": "compliance",
    "creep_modulus": "pressure",
    "strain": None,
    "stress": "pressure",
    "relaxation_modulus": "pressure",
    "storage_modulus": "pressure",
    "loss_modulus": "pressure",
    "loss_tangent": None,
    "complex_modulus": "pressure",
    "phase_angle": "angle",
    "temperature": "temperature",
    "set": None,
    "shift_factor": None,
    "force": "force",
    "approach": "length",
    "position": "length",
    "deflection": "length",
    "signal": "voltage",
    "eccentricity_x": "length",
    "eccentricity_y": "length",
    "tilt_x": "angle",
    "tilt_y": "angle",
    "force_x": "force",
    "force_y": "force",
    "torque": "torque",
    "displacement_x": "length",
    "displacement_y": "length",
    "rotation": "angle",
    "x": "length",
    "y": "length",
    "r": "length",
    "drop": "length",
    "height": "length",
    "pressure": "pressure",
}


@dataclass(frozen=True)
class Meaning:
    """Meaning of a heading: quantity, kind of test, and base of the logarithm if it has one."""

    # The quantity is a key of `QUANTITIES`, ``"frequency"`` in hertz, or ``"modulus"``: the
    # relaxation modulus over time, ambiguous over frequency. A creep modulus is read as its
    # inverse.

    quantity: str
    data: Data | None = None
    logarithm: float | None = None


# Symbols are case-sensitive.
_SYMBOLS = {
    **dict.fromkeys(("t", "ξ"), Meaning("time")),
    "f": Meaning("frequency"),
    **dict.fromkeys(("ω", "w"), Meaning("angular_frequency")),
    **dict.fromkeys(("T", "ϑ", "θ", "Θ"), Meaning("temperature")),
    "J": Meaning("creep_compliance", "shear"),
    "D": Meaning("creep_compliance", "uniaxial"),
    **dict.fromkeys(("Φ", "φ"), Meaning("creep_compliance", "deviatoric")),
    "G": Meaning("modulus", "shear"),
    "E": Meaning("modulus", "uniaxial"),
    **dict.fromkeys(("E_c", "Ec", "E_tc", "Etc"), Meaning("creep_modulus", "uniaxial")),
    **dict.fromkeys(("G_c", "Gc"), Meaning("creep_modulus", "shear")),
    "ε": Meaning("strain", "uniaxial"),
    "γ": Meaning("strain", "shear"),
    "σ": Meaning("stress", "uniaxial"),
    "G'": Meaning("storage_modulus", "shear"),
    "E'": Meaning("storage_modulus", "uniaxial"),
    "G''": Meaning("loss_modulus", "shear"),
    "E''": Meaning("loss_modulus", "uniaxial"),
    **dict.fromkeys(("G*", "|G*|"), Meaning("complex_modulus", "shear")),
    **dict.fromkeys(("E*", "|E*|"), Meaning("complex_modulus", "uniaxial")),
    **dict.fromkeys(("F", "P"), Meaning("force")),
    **dict.fromkeys(("d", "h", "δ"), Meaning("approach")),
}
_WORDS = {
    **dict.fromkeys(
        ("time", "times", "zeit", "temps", "test_time", "running_time", "prüfzeit"),
        Meaning("time"),
    ),
    **dict.fromkeys(("frequency", "freq", "freq.", "frequenz"), Meaning("frequency")),
    **dict.fromkeys(
        ("angular_frequency", "ang._frequency", "angular_freq", "omega", "kreisfrequenz"),
        Meaning("angular_frequency"),
    ),
    **dict.fromkeys(
        ("temperature", "temp", "temp.", "temperatur", "température"), Meaning("temperature")
    ),
    **dict.fromkeys(
        ("creep_compliance", "compliance", "nachgiebigkeit"), Meaning("creep_compliance")
    ),
    "phi": Meaning("creep_compliance", "deviatoric"),
    **dict.fromkeys(("j_creep", "shear_compliance"), Meaning("creep_compliance", "shear")),
    **dict.fromkeys(("d_creep", "tensile_compliance"), Meaning("creep_compliance", "uniaxial")),
    **dict.fromkeys(
        ("creep_modulus", "tensile_creep_modulus", "flexural_creep_modulus", "kriechmodul"),
        Meaning("creep_modulus", "uniaxial"),
    ),
    "shear_creep_modulus": Meaning("creep_modulus", "shear"),
    **dict.fromkeys(
        ("strain", "creep_strain", "tensile_strain", "dehnung", "kriechdehnung", "epsilon"),
        Meaning("strain", "uniaxial"),
    ),
    "shear_strain": Meaning("strain", "shear"),
    **dict.fromkeys(
        ("stress", "tensile_stress", "spannung", "sigma"), Meaning("stress", "uniaxial")
    ),
    "shear_stress": Meaning("stress", "shear"),
    "relaxation_modulus": Meaning("relaxation_modulus"),
    "modulus": Meaning("modulus"),
    **dict.fromkeys(
        ("g_relax", "shear_relaxation_modulus"), Meaning("relaxation_modulus", "shear")
    ),
    **dict.fromkeys(
        ("e_relax", "tensile_relaxation_modulus"), Meaning("relaxation_modulus", "uniaxial")
    ),
    **dict.fromkeys(("storage_modulus", "speichermodul"), Meaning("storage_modulus")),
    **dict.fromkeys(("g_stor", "g_storage"), Meaning("storage_modulus", "shear")),
    **dict.fromkeys(("e_stor", "e_storage"), Meaning("storage_modulus", "uniaxial")),
    **dict.fromkeys(("loss_modulus", "verlustmodul"), Meaning("loss_modulus")),
    "g_loss": Meaning("loss_modulus", "shear"),
    "e_loss": Meaning("loss_modulus", "uniaxial"),
    **dict.fromkeys(
        ("loss_tangent", "loss_factor", "verlustfaktor", "tan_delta", "tandelta", "tan(delta)"),
        Meaning("loss_tangent"),
    ),
    **dict.fromkeys(
        ("complex_modulus", "absolute_modulus", "dynamic_modulus", "komplexer_modul"),
        Meaning("complex_modulus"),
    ),
    "complex_shear_modulus": Meaning("complex_modulus", "shear"),
    **dict.fromkeys(
        ("phase_angle", "phase_shift", "phase_shift_angle", "loss_angle", "delta", "phasenwinkel"),
        Meaning("phase_angle"),
    ),
    **dict.fromkeys(("tan_d", "tan_δ", "tanδ", "tan(δ)"), Meaning("loss_tangent")),
    **dict.fromkeys(("set", "sets"), Meaning("set")),
    **dict.fromkeys(("shift_factor", "at", "a_t"), Meaning("shift_factor")),
    **dict.fromkeys(
        ("log_at", "log_a_t", "log10_at", "log10_a_t", "log(at)", "log10(at)"),
        Meaning("shift_factor", logarithm=10.0),
    ),
    **dict.fromkeys(
        ("ln_at", "ln_a_t", "ln(at)"), Meaning("shift_factor", logarithm=2.718281828459045)
    ),
    **dict.fromkeys(
        ("force", "load", "kraft", "axial_force", "standard_force", "standardkraft"),
        Meaning("force"),
    ),
    **dict.fromkeys(
        ("approach", "depth", "indentation", "indentation_depth", "eindringtiefe"),
        Meaning("approach"),
    ),
    **dict.fromkeys(
        ("position", "piezo_position", "piezo", "z_position", "z_piezo", "z_sensor"),
        Meaning("position"),
    ),
    **dict.fromkeys(("deflection", "cantilever_deflection", "vdeflection"), Meaning("deflection")),
    **dict.fromkeys(("signal", "deflection_signal", "photodiode_signal"), Meaning("signal")),
    **{
        name: Meaning(name) for name in ("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")
    },
}  # fmt: skip

_LONGEST_NAME = 100
_PRIMES = str.maketrans({"’": "'", "′": "'", "‘": "'", "`": "'", "´": "'", "″": "''", '"': "''"})
# "E(t)" is E; the argument is redundant.
_ARGUMENT = re.compile(r"\s*\((?:t|f|ω|w|omega|time|t,\s*T)\)\s*$")


# "Storage modulus G'", "Speichermodul (G')": the symbol repeats the words.
_WITH_SYMBOL = re.compile(r"(?P<words>.+?)[\s,]+(?P<symbol>\S+)")


def meaning(name: str) -> Meaning | None:
    """Meaning of a column's name without its unit; None if it is unknown."""
    plain = _ARGUMENT.sub("", name.translate(_PRIMES).strip())
    found = _single(plain)
    if found is not None or len(plain) > _LONGEST_NAME:
        return found
    match = _WITH_SYMBOL.fullmatch(plain)
    if match is None:
        return None
    words, symbol = _single(match["words"]), _single(match["symbol"].strip("()[]"))
    if words is None or symbol is None or words.quantity != symbol.quantity:
        return None
    return symbol if words.data in (None, symbol.data) else None


def _single(plain: str) -> Meaning | None:
    """Meaning of a symbol or of words."""
    return _SYMBOLS.get(plain) or _WORDS.get(re.sub(r"[\s_-]+", "_", plain).lower())


def known_names() -> list[str]:
    """All known names, to suggest the nearest to a misspelt one."""
    return [*_WORDS]
