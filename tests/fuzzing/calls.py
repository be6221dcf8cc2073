"""Calls of the Python interface with arguments of every kind, good ones among them."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
from hypothesis import strategies as st

import viscontact as vc
from fuzzing import junk

SPHERE = vc.Sphere(0.01)
GEL = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5)
PUSH = vc.step(1.0)
GRID = vc.Grid((16, 16), (6e-3, 6e-3))

_NUMBERS: tuple[Any, ...] = (
    *(0, 1, 2, -1, 0.5, -0.0, 1.5, 3, 16, 1e-3, 1e-9, 1e9, 1e-300, 1e300, 5e-324, 1e-30, 1e30),
    *(float("nan"), float("inf"), float("-inf"), 10**25, 10**400, -(10**400), 2**63, 1e308),
    *(np.float32(0.1), np.float16(2.0), np.longdouble(1.0), np.int8(3), np.uint64(2**63)),
    *(np.float64("nan"), np.datetime64("2026-01-01"), np.timedelta64(1, "s"), np.bool_(True)),
    *(True, False, None, 1j, np.complex128(1), np.array(1.0), np.array([1.0]), np.ma.masked),
)
_OTHERS: tuple[Any, ...] = (
    *("", "1", "1 mm", "all", "none", "x" * 1000, b"1", b"", "\ud7ff", "slope", "uniaxial"),
    *((), [], {}, set(), object(), int, float, print, Ellipsis, NotImplemented, range(3), slice(1)),
    *([1.0], [1.0, 2.0], (0.0, 1.0), [0, 1, 1], [1, 0], [[1, 2], [3]], [None], ["a"], [[]], [1j]),
    *([float("nan")] * 2, [0.0, float("inf")], [10**400, 1], np.zeros(3), np.zeros((2, 2))),
    *(np.array(["a"]), np.array([None, 1.0], dtype=object), np.array([1, 2 + 1j]), np.zeros(0)),
    *(np.ma.masked_array([1.0, 2.0], [True, False]), np.array([1.0, np.nan]), np.array([True])),
    *(
        np.array("2026-01-01", dtype="datetime64[s]"),
        np.rec.array([(1.0, 2)]),
        {"x": 1},
        {1.0, 2.0},
    ),
    *(
        SPHERE,
        GEL,
        PUSH,
        GRID,
        vc.Elastic(1e6),
        vc.adaptive_times(1.0, 1e-2),
        vc.uniform_times(1, 3),
    ),
    *([0, 1e-300], [0, 1e300], np.linspace(0, 1, 5), np.geomspace(1e-3, 1, 5), memoryview(b"ab")),
    *((10**6, 10**6), (4, 4), (16, 16.0), (1e9, 1e9), (6e-3, 6e-3), iter([1.0, 2.0]), lambda: 1),
)


def _arguments() -> st.SearchStrategy[Any]:
    return st.one_of(
        junk.one_of(_NUMBERS),
        junk.one_of(_NUMBERS),
        junk.one_of(_OTHERS),
        st.floats(),
        st.floats(1e-6, 10.0),
        st.lists(st.floats(0, 10), max_size=4),
        st.lists(st.floats(0, 10), max_size=4).map(sorted),
    )


#: What is called, with arguments that are taken.
CALLS: tuple[tuple[Callable[..., Any], dict[str, Any]], ...] = (
    (vc.Sphere, {"radius": 0.01}),
    (vc.Paraboloid, {"radius_x": 0.01, "radius_y": 0.02}),
    (vc.Cone, {"half_angle": 1.4}),
    (vc.FlatPunch, {"half_length": 1.0, "half_width": 1.0}),
    (vc.Roller, {"radius": 5e-3, "half_length": 0.01, "crown_radius": 0.075}),
    (vc.Elastic, {"shear_modulus": 1e6}),
    (vc.Maxwell, {"shear_modulus": 1e6, "viscosity": 1e6}),
    (vc.Zener, {"shear_modulus": 1e6, "delayed_modulus": 1e6, "viscosity": 1e6}),
    (
        vc.Burgers,
        {"shear_modulus": 1e6, "viscosity": 1e6, "delayed_modulus": 1e6, "delayed_viscosity": 1e6},
    ),
    (vc.CreepSeries, {"instant": 1e-6, "amplitudes": [1e-6], "times": [1.0], "fluidity": 0.0}),
    (vc.CreepSeries.from_shear, {"instant": 1e-6, "amplitudes": [1e-6], "times": [1.0]}),
    (
        vc.CreepSeries.from_uniaxial,
        {"instant": 1e-6, "amplitudes": [1e-6], "times": [1.0], "poisson_ratio": 0.4},
    ),
    (
        vc.CreepSeries.from_uniaxial,
        {"instant": 1e-6, "amplitudes": [1e-6], "times": [1.0], "bulk_modulus": 4e9},
    ),
    (vc.RelaxationSeries, {"equilibrium": 1e6, "moduli": [1e6], "times": [1.0]}),
    (vc.PowerLaw, {"compliance": 1e-6, "exponent": 0.3, "reference_time": 1.0, "instant": 1e-7}),
    (vc.TabulatedCreep, {"times": [0.0, 1.0, 10.0], "compliance": [1e-6, 2e-6, 3e-6]}),
    (vc.TabulatedRelaxation, {"times": [0.0, 1.0, 10.0], "modulus": [3e6, 2e6, 1e6]}),
    (vc.Material, {"law": vc.Elastic(1e6), "poisson_ratio": 0.4}),
    (vc.Material, {"law": vc.Zener(1e6, 1e6, 1e6), "bulk_modulus": 4e9}),
    (vc.ForceHistory, {"times": [0.0, 1.0], "force": [0.0, 1.0], "eccentricity_x": 0.0}),
    (vc.ForceHistory, {"times": [0.0, 1.0], "force": [0.0, 1.0], "tilt_x": 0.0, "tilt_y": None}),
    (vc.ApproachHistory, {"times": [0.0, 1.0], "approach": [0.0, 1e-5], "tilt_x": 0.0}),
    (vc.step, {"force": 1.0, "eccentricity_x": 0.0, "tilt_y": None}),
    (vc.step, {"approach": 1e-6}),
    (vc.ramp, {"force": 1.0, "duration": 1.0}),
    (vc.triangle, {"force": 1.0, "rise": 1.0, "fall": 1.0}),
    (vc.harmonic, {"mean": 2.0, "amplitude": 1.0, "period": 1.0, "cycles": 2, "phase": 0.0}),
    (vc.Grid, {"shape": (16, 16), "size": (6e-3, 6e-3)}),
    (vc.uniform_times, {"end": 1.0, "n": 4}),
    (vc.log_times, {"first": 0.1, "end": 1.0, "n": 4}),
    (vc.adaptive_times, {"end": 1.0, "tolerance": 1e-2}),
    (vc.auto_grid, {"indenter": SPHERE, "material": GEL, "load": PUSH, "tolerance": 0.1}),
    (vc.Zener(1e6, 1e6, 1e6), {"t": 1.0}),
    (vc.TabulatedCreep([0.0, 1.0, 9.0], [1e-6, 2e-6, 3e-6]), {"t": 1.0}),
    (vc.PowerLaw(1e-6, 0.3, 1.0).relaxation, {"t": 1.0}),
    (SPHERE.gap, {"x": [0.0], "y": [0.0]}),
    (vc.triangle(1.0, 1.0).level_at, {"times": [0.0, 1.0]}),
    (vc.Maxwell(1e6, 1e6).slowed, {"factor": 2.0}),
    *(
        (
            call,
            {
                **{"indenter": SPHERE, "material": GEL, "load": PUSH, "grid": GRID},
                **{"times": [0.0, 1.0], "indenter_material": None, "tolerance": 1e-6},
                **{"fields": "none", "threads": 1, "progress": None},
            },
        )
        for call in (vc.simulate, lambda *args, **named: next(vc.march(*args, **named)))
    ),
)


@st.composite
def calls(draw: Any) -> tuple[Callable[[], Any], str]:
    """Return a call that is ready to be made, and how it reads."""
    called, good = draw(junk.one_of(CALLS))
    given = dict(good)
    for _ in range(draw(st.sampled_from((0, 1, 1, 1, 1, 2, 3)))):
        name = draw(st.sampled_from(sorted(good)))
        what = draw(st.integers(0, 9))
        if what == 0:
            given.pop(name, None)
        elif what == 1:
            given[name] = object()
        elif what == 2:
            given["no_such_argument"] = 1
        else:
            given[name] = draw(_arguments())
    name = getattr(called, "__qualname__", repr(called))
    return (lambda: called(**given)), f"{name}({', '.join(itertools.islice(given, 99))})"


# --- measured surfaces ------------------------------------------------------------------------

_KINDS = ("f2", "f4", "f8", "g", "i1", "u8", "i4", "c16", "?", "O", "U3", "S2", "M8[s]", "m8[s]")


@st.composite
def height_maps(draw: Any) -> tuple[Callable[[], Any], str]:
    """Return a run on a surface that is to be made first, good or bad, and its text."""
    nx, ny = (draw(junk.one_of((0, 1, 2, 9, 9, 9, 33, 33, 33))) for _ in range(2))
    random = np.random.default_rng(draw(st.integers(0, 2**32)))
    scale = draw(junk.one_of((1e-6, 1e-6, 1e-6, 1e-9, 1e-5, 1.0, 1e3, 1e-320, 1e150, 1e308, 0.0)))
    lines = [_mesh(draw, nx), _mesh(draw, ny)]
    across = np.linspace(-4e-3, 4e-3, nx)[:, None], np.linspace(-4e-3, 4e-3, ny)
    bowl: Any = -(across[0] ** 2 + across[1] ** 2) / 0.02
    height: Any = bowl + random.normal(size=(nx, ny)) * scale
    if height.size and draw(st.integers(0, 2)) == 0:
        height.flat[draw(st.integers(0, height.size - 1))] = draw(
            junk.one_of((np.nan, np.inf, -np.inf, 1e308, -1e308, 5e-324))
        )
    if draw(st.integers(0, 3)) == 0:
        height = _cast(height, draw(st.sampled_from(_KINDS)))
    if draw(st.integers(0, 9)) == 0:
        height = draw(junk.one_of((height.T, height.ravel(), height[..., None], height.tolist())))
    if draw(st.integers(0, 9)) == 0:
        height = np.ma.masked_array(height, random.random(np.shape(height)) < 0.3)
    if draw(st.integers(0, 14)) == 0:
        height = draw(_arguments())
    return (lambda: _pressed(lines[0], lines[1], height)), f"{nx} x {ny} heights"


def _pressed(x: Any, y: Any, height: Any) -> None:
    """Make the surface, and press it a little."""
    surface = vc.HeightMap(x, y, height)
    vc.simulate(surface, GEL, PUSH, GRID, [0.0], fields="none")


def _mesh(draw: Any, count: int) -> Any:
    even = np.linspace(-4e-3, 4e-3, count)
    return draw(
        junk.one_of(
            (
                *((even,) * 12),
                *(even[::-1], even.tolist(), even.astype("f2"), even.astype("f4"), even * 1e300),
                *(even.astype("g"), np.round(even, 3), even * 0, even[:, None], even[1:], even + 1),
                *(
                    even * 1e-310,
                    even.astype("c16"),
                    even.astype("O"),
                    even.astype("U9"),
                    None,
                    "x",
                ),
                *(np.append(even, np.nan), np.ma.masked_less(even, 0), list(map(str, even)), 3),
            )
        )
    )


def _cast(values: Any, kind: str) -> Any:
    with np.errstate(all="ignore"):
        return np.nan_to_num(values).astype("i8" if kind[:1] in "Mm" else "f8").astype(kind)
