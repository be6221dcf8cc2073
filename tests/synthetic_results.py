"""Results written down rather than computed, for tests of what is drawn from them."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from viscontact.results.accessor import ResultAccessor as ResultAccessor  # ds.viscontact
from viscontact.results.variables import SCALARS

FloatArray = NDArray[np.float64]

RADIUS = 0.01
SHEAR_MODULUS = 1e9
VISCOSITY = 1e11  # tau = 100 s
FORCE = 50.0
SERIES = {
    "type": "CreepSeries",
    "instant": 5.545e-10,
    "amplitudes": [6.17e-11, 8.38e-11],
    "times": [10.0, 133.87],
    "fluidity": 0.0,
}


def maxwell_sphere(
    times: Sequence[float] = (0.0, 10.0, 100.0, 300.0), cells: int = 64, fields: bool = True
) -> xr.Dataset:
    """Step load on a sphere against a Maxwell half-space, nu = 1/2, in closed form.

    Radius: a³ = 3 R W Phi / 8, Phi = (1 + t/tau) / (2G). Gap: Hertz's, at the radius a(t)
    (Johnson, Contact Mechanics, eq. 3.42). Pressure: hereditary integral by the trapezoidal rule.
    """
    time = np.asarray(times, dtype=np.float64)
    radius = np.array([_maxwell_radius(t) for t in time])
    half_width = 1.3 * radius.max()
    x = (2 * np.arange(cells) - (cells - 1)) * (half_width / cells)
    r = np.hypot(x[:, None], x[None, :])
    pressure = np.stack([maxwell_pressure(r, t) for t in time])
    gap = np.stack([_hertz_gap(r, a) for a in radius])
    case = {
        "title": "Sphere on a Maxwell half-space",
        "indenter": {"type": "Sphere", "radius": RADIUS},
        "material": {
            "type": "Material",
            "law": {"type": "Maxwell", "shear_modulus": SHEAR_MODULUS, "viscosity": VISCOSITY},
            "poisson_ratio": 0.5,
            "bulk_modulus": None,
        },
        "load": _steady(FORCE),
        "grid": {"type": "Grid", "shape": [cells, cells], "size": [2 * half_width] * 2},
        "times": time.tolist(),
    }
    return _results(time, x, x, pressure, gap, radius**2 / RADIUS, radius, case, fields)


def roller(
    times: Sequence[float] = (0.0, 1.0, 10.0, 100.0, 1000.0),
    shape: tuple[int, int] = (96, 32),
    tilt: float = 0.0,
    fields: bool = True,
) -> xr.Dataset:
    """A made-up field that looks like a crowned roller's: long, narrow, raised at its ends."""
    time = np.asarray(times, dtype=np.float64)
    growth = 1.4 - 0.4 * np.exp(-time / 50.0)
    x = (2 * np.arange(shape[0]) - (shape[0] - 1)) * (0.075 / shape[0])
    y = (2 * np.arange(shape[1]) - (shape[1] - 1)) * (0.75e-3 / shape[1])
    level = np.stack([_roller_level(x, y, g, tilt) for g in growth])
    end = 1 + 0.5 * (x / 0.055) ** 4 + tilt * x / 0.055
    pressure = np.sqrt(np.maximum(level, 0)) * (150e6 / growth**0.5)[:, None, None] * end[:, None]
    gap = 2e-6 * np.maximum(-level, 0) ** 1.5
    case = {
        "title": "Roller",
        "indenter": {
            "type": "Roller",
            "radius": 5e-3,
            "half_length": 9.565e-3,
            "crown_radius": 7.5,
        },
        "material": {"type": "Material", "law": SERIES, "poisson_ratio": 0.38},
        "load": _steady(1e4),
        "grid": {"type": "Grid", "shape": list(shape), "size": [0.15, 1.5e-3]},
        "times": time.tolist(),
    }
    approach = 1.67e-4 * growth**0.5
    results = _results(time, x, y, pressure, gap, approach, 0.055 * growth**0.2, case, fields)
    results["tilt_x"][:] = 1e-3 * tilt * growth**0.1
    return results


#: An ellipse beside the centre, long in y: middle and first semi-axes along x and y [m], and the
#: largest pressure [Pa].
ELLIPSE_MIDDLE, ELLIPSE_AXES, ELLIPSE_PEAK = (0.13e-3, -0.21e-3), (0.2e-3, 0.5e-3), 2e6
ELLIPSE_TIMES = (0.0, 2.0, 5.0)
#: Cells along x and y, and their edges [m]: no two are equal.
ELLIPSE_CELLS, ELLIPSE_EDGES = (48, 54), (20e-6, 40e-6)


def ellipse_growth(t: float) -> float:
    """Semi-axes and largest pressure over the first ones: both as the cube root of the force."""
    return 1 + 0.1 * t


def ellipse_pressure(x: FloatArray, y: FloatArray, t: float) -> FloatArray:
    """Pressure of `ellipse` [Pa] at points [m]: p0 sqrt(1 - u² - v²) (Johnson 1985, eq. 3.58)."""
    growth = ellipse_growth(t)
    u, v = (
        (at - middle) / (growth * axis)
        for at, middle, axis in zip((x, y), ELLIPSE_MIDDLE, ELLIPSE_AXES, strict=True)
    )
    return np.asarray(ELLIPSE_PEAK * growth * np.sqrt(np.maximum(1 - u**2 - v**2, 0.0)))


def ellipse(*, transposed: bool = False) -> xr.Dataset:
    """Hertz's elliptic contact beside the centre under a growing force; x and y may be exchanged.

    The gap only has the form of Hertz's at the rim.
    """
    time = np.array(ELLIPSE_TIMES)
    x, y = (
        (2 * np.arange(count) - (count - 1)) * edge / 2
        for count, edge in zip(ELLIPSE_CELLS, ELLIPSE_EDGES, strict=True)
    )
    growth = np.array([ellipse_growth(t) for t in time])
    pressure = np.stack([ellipse_pressure(x[:, None], y[None, :], t) for t in time])
    u, v = (
        (at - middle) / axis
        for at, middle, axis in zip((x, y), ELLIPSE_MIDDLE, ELLIPSE_AXES, strict=True)
    )
    outside = (u[:, None] ** 2 + v[None, :] ** 2) / growth[:, None, None] ** 2 - 1
    gap = 1e-6 * np.maximum(outside, 0.0) ** 1.5
    semi_axes, middle, radii = ELLIPSE_AXES, ELLIPSE_MIDDLE, (0.02, 0.1)
    if transposed:
        x, y, pressure, gap = y, x, pressure.swapaxes(1, 2), gap.swapaxes(1, 2)
        semi_axes, middle, radii = semi_axes[::-1], middle[::-1], radii[::-1]
    area = np.pi * semi_axes[0] * semi_axes[1] * growth**2
    force = 2 / 3 * ELLIPSE_PEAK * growth * area
    case = {
        "title": "Ellipse beside the centre",
        "indenter": {"type": "Paraboloid", "radius_x": radii[0], "radius_y": radii[1]},
        "material": {
            "type": "Material",
            "law": {"type": "Elastic", "shear_modulus": 1e9},
            "poisson_ratio": 0.3,
            "bulk_modulus": None,
        },
        "load": _steady(0.0) | {"times": time.tolist(), "force": force.tolist()},
        "grid": {
            "type": "Grid",
            "shape": [x.size, y.size],
            "size": [float(at[1] - at[0]) * at.size for at in (x, y)],
        },
        "times": time.tolist(),
    }
    half_length = semi_axes[0] * growth
    results = _results(time, x, y, pressure, gap, 1e-6 * growth**2, half_length, case, True)
    exact = {
        "force": force,
        "eccentricity_x": 0 * time + middle[0],
        "eccentricity_y": 0 * time + middle[1],
        "contact_area": area,
        "contact_width": 2 * semi_axes[1] * growth,
        "peak_pressure": ELLIPSE_PEAK * growth,
        "mean_pressure": 2 / 3 * ELLIPSE_PEAK * growth,
    }
    for name, values in exact.items():
        results[name][:] = values
    further = {"residual": 1e-7, "time_error": 0.0, "work": 1e-3, "loss_per_cycle": np.nan}
    for name, value in {**further, "iterations": 9, "cells_across": 20, "outcome": 0}.items():
        results[name] = "time", np.full(time.size, value), {"units": "1"}
    return results


def maxwell_pressure(r: FloatArray, t: float) -> FloatArray:
    """Pressure [Pa] at r [m] and t [s]: 8G/(pi R) [s(t) - int exp((t'-t)/tau) s(t') dt' / tau]."""
    tau = VISCOSITY / SHEAR_MODULUS
    past = np.linspace(0.0, t, 400)
    a = np.array([_maxwell_radius(instant) for instant in past])
    s = np.sqrt(np.maximum(a**2 - r[..., None] ** 2, 0.0))
    memory = np.trapezoid(np.exp((past - t) / tau) * s, past, axis=-1) / tau
    return 8 * SHEAR_MODULUS / (np.pi * RADIUS) * (s[..., -1] - memory)


def _maxwell_radius(t: float) -> float:
    compliance = (1 + t * SHEAR_MODULUS / VISCOSITY) / (2 * SHEAR_MODULUS)
    return float(np.cbrt(3 * RADIUS * FORCE * compliance / 8))


def _hertz_gap(r: FloatArray, a: float) -> FloatArray:
    far = np.maximum(r, a)
    dip = (2 * a**2 - far**2) * np.arcsin(a / far) + a * np.sqrt(far**2 - a**2)
    return far**2 / (2 * RADIUS) + dip / (np.pi * RADIUS) - a**2 / RADIUS


def _roller_level(x: FloatArray, y: FloatArray, growth: float, tilt: float) -> FloatArray:
    ends = 1 - ((x - tilt * 6e-3) / (0.055 * growth**0.2)) ** 6
    width = 4.2e-4 * growth**0.5 * (1 + 0.3 * (x / 0.055) ** 4 + tilt * 0.5 * x / 0.055)
    return ends[:, None] - (y[None, :] / width[:, None]) ** 2


def _steady(force: float) -> dict[str, Any]:
    return {
        "type": "ForceHistory",
        "times": [0.0],
        "force": [force],
        "eccentricity_x": 0.0,
        "eccentricity_y": 0.0,
        "tilt_x": None,
        "tilt_y": None,
    }


#: Force along x of `gripping_sphere` at 0, 1, 2, ... s over what friction carries; coefficient of
#: friction, stick radius over that of the contact at the largest force, and heat of a cycle [J].
SHAKEN, GRIP = (0.0, 0.0, 0.488, 0.0, -0.488, 0.0, 0.488, 0.0, -0.488), 0.3
STICK, CYCLE_HEAT = 0.8, 4e-6


def gripping_sphere(cells: int = 64, fields: bool = True) -> xr.Dataset:
    """The sphere at its first contact, pulled to and fro along x: Cattaneo, Mindlin, Deresiewicz.

    Tractions are those of nu = 0: virgin ones μ (p(a) - c/a p(c)) with c³ = a³ (1 - Q/(μ W)), and
    after a reversal twice those of half the change. The heat grows evenly.
    """
    levels = np.array(SHAKEN)
    results = maxwell_sphere([0.0] * levels.size, cells, fields)
    times, radius = np.arange(levels.size, dtype=float), _maxwell_radius(0.0)
    results["time"] = ("time", times, {"units": "s"})
    limit, ring = GRIP * FORCE, 1 - STICK**2
    zeros = np.zeros(levels.size)
    scalars = {
        "tangential_force_x": limit * levels,
        "tangential_force_y": zeros,
        "torque": zeros,
        "tangential_displacement_x": 2e-6 * levels,
        "tangential_displacement_y": zeros,
        "rotation": zeros,
        "stick_area": np.pi * radius**2 * (1 - ring * (levels != 0)),
        "slip_fraction": ring * (levels != 0),
        "friction_heat": CYCLE_HEAT / 4 * times,
        "friction_power": zeros + CYCLE_HEAT / 4,
    }
    for name, values in scalars.items():
        results[name] = ("time", values, SCALARS[name].attributes)
    pull = {"times": times.tolist(), "force_x": (limit * levels).tolist()}
    case = json.loads(results.attrs["case"]) | {
        "friction": {"type": "Friction", "coefficient": GRIP, "wear": 3e-15},
        "tangential": {"type": "TangentialHistory", **pull},
    }
    results.attrs["case"] = json.dumps(case)
    if fields:
        _add_slip(results, levels, radius)
    return results


def _add_slip(results: xr.Dataset, levels: FloatArray, radius: float) -> None:
    """Add tractions, slip and work of `gripping_sphere`."""
    x = results["x"].values
    r = np.hypot(x[:, None], x[None, :])
    peak = 1.5 * FORCE / (np.pi * radius**2)

    def virgin(level: float) -> FloatArray:
        edges = (radius, radius * (1 - abs(level)) ** (1 / 3))
        inner = [np.sqrt(np.maximum(edge**2 - r**2, 0.0)) for edge in edges]
        return np.asarray(np.sign(level) * GRIP * peak / radius * (inner[0] - inner[1]))

    last, found = 0.0, []
    for level in levels:
        last = level if abs(level) == np.abs(levels).max() else last
        found.append(virgin(last) - 2 * virgin((last - level) / 2))
    traction, inside = np.stack(found), r < radius
    slips = inside & (r > STICK * radius) & (levels != 0)[:, None, None]
    slip = 1e-6 * slips * (r / radius - STICK) * np.sign(levels)[:, None, None]
    dims = ("time", "x", "y")
    results["traction_x"], results["traction_y"] = (dims, traction), (dims, 0 * traction)
    results["slip_x"], results["slip_y"] = (dims, slip), (dims, 0 * slip)
    results["slip_state"] = (dims, np.where(slips, 2, 1 * inside).astype(np.int8))
    results["friction_work"] = (dims, np.abs(slip) * 1e6)


def _results(
    time: FloatArray,
    x: FloatArray,
    y: FloatArray,
    pressure: FloatArray,
    gap: FloatArray,
    approach: FloatArray,
    half_length: FloatArray,
    case: dict[str, Any],
    fields: bool,
) -> xr.Dataset:
    inside = pressure > 0
    cell = (x[1] - x[0]) * (y[1] - y[0])
    area = inside.sum((1, 2)) * cell
    force = np.full_like(time, case["load"]["force"][0])
    zeros = np.zeros_like(time)
    scalars = {
        "force": force,
        "eccentricity_x": zeros,
        "eccentricity_y": zeros,
        "approach": approach,
        "tilt_x": zeros.copy(),
        "tilt_y": zeros.copy(),
        "contact_area": area,
        "contact_length": 2 * half_length,
        "contact_width": area / (2 * half_length),
        "peak_pressure": pressure.max((1, 2)),
        "mean_pressure": force / area,
    }
    data = {name: ("time", value, SCALARS[name].attributes) for name, value in scalars.items()}
    results = xr.Dataset(
        data,
        coords={"time": ("time", time, {"units": "s"}), "x": x, "y": y},
        attrs={"version": "0", "case": json.dumps(case), "warnings": "", "tolerance": 1e-6},
    )
    if fields:
        results["pressure"] = (("time", "x", "y"), pressure)
        results["gap"] = (("time", "x", "y"), gap)
        results["displacement"] = (("time", "x", "y"), 0 * gap)
    return results
