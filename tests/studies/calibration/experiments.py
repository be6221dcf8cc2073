"""Synthetic experiments with known values, by exact solutions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import viscontact as vc
from viscontact import reference

Array = NDArray[np.float64]

RADIUS = 5e-3
ZENER = {"shear_modulus": 2e6, "delayed_modulus": 1e6, "viscosity": 1e6}
#: The case starts elsewhere.
BALL = """
indenter: {shape: sphere, radius: 5 mm}
material: {law: zener, shear_modulus: 4 MPa, delayed_modulus: 2 MPa, viscosity: 1 MPa s,
  poisson_ratio: 0.5}
load: {kind: step, force: 0.5 N}
time: {end: 4 s, steps: 20}
grid: {shape: [48, 48], size: [3.2 mm, 3.2 mm]}
"""
ELASTIC_BALL = """
indenter: {shape: sphere, radius: 5 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.1 N}
time: {end: 1 s, steps: 1}
grid: {shape: [40, 40], size: [1.4 mm, 1.4 mm]}
"""
OF_ZENER = {
    "material.shear_modulus": ("0.5 MPa", "20 MPa", "log"),
    "material.delayed_modulus": ("0.2 MPa", "10 MPa", "log"),
    "material.viscosity": ("0.1 MPa s", "20 MPa s", "log"),
}
MODULUS = {"material.shear_modulus": ("0.5 MPa", "9 MPa", "log")}


def written(folder: Path, text: str) -> Path:
    """Write a case to a folder."""
    path = folder / "ball.yaml"
    path.write_text(text)
    return path


def triangle(duration: float, rows: int = 21, peak: float = 0.5) -> tuple[Array, Array]:
    """Times [s] and force [N] of loading and unloading."""
    times = np.linspace(0.0, duration, rows)
    return times, peak * (1 - np.abs(2 * times / duration - 1))


def pressed_ball(times: Array, force: Array) -> Array:
    """Approach of the ball on Zener's body (Ting 1966) [m]."""
    material = vc.Material(vc.Zener(**ZENER), poisson_ratio=0.5)
    contact = reference.press_axisymmetric(
        reference.SphereProfile(RADIUS),
        times,
        creep_compliance=material.contact_compliance(),
        elements=400,
        force=force,
    )
    return np.asarray(contact.approach, dtype=np.float64)


def hertz_depth(force: Array, shear_modulus: float = 2e6) -> Array:
    """Approach of the ball on an incompressible elastic body (Hertz 1881) [m]."""
    return np.asarray((3 * force / (16 * shear_modulus * np.sqrt(RADIUS))) ** (2 / 3))


def noise(seed: int, values: Array, part: float = 0.01) -> Array:
    """Normal scatter of a part of the largest value."""
    scatter = np.random.default_rng(seed).standard_normal(values.size)
    return np.asarray(part * np.abs(values).max() * scatter)
