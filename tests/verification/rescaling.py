"""The same problem in other units: every number times its own powers of three factors."""

from dataclasses import dataclass, fields, is_dataclass, replace

import numpy as np

#: Exponents of length, modulus and time of the arguments' fields. A force is a modulus times
#: an area, a viscosity a modulus times a time.
DIMENSIONS = {
    **dict.fromkeys(("radius", "radius_x", "radius_y", "half_length", "half_width"), (1, 0, 0)),
    **dict.fromkeys(("crown_radius", "x", "y", "height", "approach", "size"), (1, 0, 0)),
    **dict.fromkeys(("eccentricity_x", "eccentricity_y"), (1, 0, 0)),
    **dict.fromkeys(("shear_modulus", "delayed_modulus", "equilibrium_modulus"), (0, 1, 0)),
    **dict.fromkeys(("equilibrium", "moduli", "modulus", "bulk_modulus"), (0, 1, 0)),
    **dict.fromkeys(("viscosity", "delayed_viscosity"), (0, 1, 1)),
    **dict.fromkeys(("compliance", "instant", "amplitudes"), (0, -1, 0)),
    "fluidity": (0, -1, -1),
    **dict.fromkeys(("times", "time", "reference_time", "period"), (0, 0, 1)),
    "force": (2, 1, 0),
    **dict.fromkeys(("half_angle", "exponent", "second_exponent", "poisson_ratio"), (0, 0, 0)),
    **dict.fromkeys(("tilt_x", "tilt_y", "phase", "cycles", "shape"), (0, 0, 0)),
    # Of states.
    "pressure": (0, 1, 0),
    **dict.fromkeys(("gap", "displacement", "contact_length", "contact_width"), (1, 0, 0)),
    "contact_area": (2, 0, 0),
    **dict.fromkeys(("peak_pressure", "mean_pressure"), (0, 1, 0)),
    **dict.fromkeys(("work", "loss_per_cycle"), (3, 1, 0)),
    **dict.fromkeys(("time_error", "iterations", "residual", "cells_across"), (0, 0, 0)),
}


@dataclass(frozen=True)
class Units:
    """How large the units of length, modulus and time are."""

    length: float = 1.0
    modulus: float = 1.0
    time: float = 1.0

    def of(self, dimension):
        bases = (self.length, self.modulus, self.time)
        return float(np.prod([base**power for base, power in zip(bases, dimension, strict=True)]))


def rescaled(given, units):
    """An argument with every number times its unit, the objects within it likewise."""
    if is_dataclass(given):
        return type(given)(**{f.name: _part(given, f.name, units) for f in fields(given) if f.init})
    if isinstance(given, tuple):
        return tuple(rescaled(part, units) for part in given)
    return given


def _part(given, name, units):
    value = getattr(given, name)
    if name in ("mean", "amplitude"):  # of what swings
        return value * units.of(DIMENSIONS[given.control])
    if value is None or isinstance(value, str) or name not in DIMENSIONS:
        return rescaled(value, units)
    unit = units.of(DIMENSIONS[name])
    if isinstance(value, tuple):
        return value if unit == 1 else tuple(part * unit for part in value)
    return value if unit == 1 else value * unit


def rescaled_problem(problem, units):
    names = ("indenter", "material", "load", "grid", "indenter_material")
    parts = {name: rescaled(getattr(problem, name), units) for name in names}
    return replace(problem, times=problem.times * units.of(DIMENSIONS["times"]), **parts)


def in_units(state, units):
    """What a state says, by its units: numbers that no choice of units can change."""
    return {
        name: np.asarray(getattr(state, name)) / units.of(DIMENSIONS[name])
        for name in (f.name for f in fields(state))
        if name in DIMENSIONS
    }
