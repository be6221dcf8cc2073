"""Public callables that take arrays, each in a call that works, with its arguments in SI units."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np

import synthetic_results
import viscontact as vc
from rolling_curves import rolling_curve
from viscontact import indenters, laws, loads, plot, reference, surfaces
from viscontact.units.numbers import unit_of

#: Annotations of arguments that hold several numbers.
ARRAY = re.compile(
    r"ArrayLike|Sequence\[float\]|tuple\[float, float[,\]]|\bFloats\b(?!\])|Mapping\[str, Floats\]"
)

#: Classes that users do not make, and parts of exact solutions that are called with floats.
#: `read_surface` gives its spacing to `Surface`; runs call the methods named here.
MADE_BY_THE_PACKAGE = (
    *("read_surface", "times_at_cells", "largest_at"),
    *("Animation", "AxisymmetricContact", "CaseFit", "ContactState", "LayerContact"),
    *("PowerSpectrum", "Table", "TingTriangle", "TingHump"),
    *("ConeProfile", "PunchProfile", "SphereProfile"),
)

#: Units of arguments by their names, where no field states them.
UNITS = {
    **dict.fromkeys(("x", "y", "r", "drop", "depths", "spacing", "cell", "size", "contact"), "m"),
    **dict.fromkeys(("heights", "position", "deflection", "approach", "profile"), "m"),
    **dict.fromkeys(("distance", "depth", "places"), "m"),
    **dict.fromkeys(("force", "forces"), "N"),
    **dict.fromkeys(("compliance", "amplitudes"), "1/Pa"),
    **dict.fromkeys(("modulus", "moduli", "storage", "loss", "pressure"), "Pa"),
    **{
        "speed": "m/s",
        "speeds": "m/s",
        "creepage": "1",
        "temperature": "K",
        "angular_frequency": "rad/s",
    },
}

BALL, RUBBER = vc.Sphere(0.01), vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5)
RUN = {"indenter": BALL, "material": RUBBER, "grid": vc.Grid((16, 16), (2.4e-3, 2.4e-3))}
ROWS = np.arange(1.0, 25.0).tolist()
CREEP = {"times": [1.0, 2.0, 4.0, 8.0], "compliance": [1e-9, 2e-9, 3e-9, 4e-9]}
RELAXED = {"times": [1.0, 2.0, 4.0, 8.0], "modulus": [4e6, 3e6, 2e6, 1e6]}
HEATED = {
    **{"data": "shear", "temperature": [293.0, 293.0, 303.0, 303.0]},
    "shift": vc.Arrhenius(293.15, 80e3),
}
CREEP_SERIES = {"instant": 1e-9, "times": [1.0, 2.0], "amplitudes": [1e-9, 2e-9]}
PRONY = {"equilibrium": 1e6, "times": [1.0, 2.0], "moduli": [1e6, 2e6]}
MAP, LINE, DROPS = [[0.0, 1e-6], [0.0, 2e-6]], [0.0, 1e-3, 2e-3], [0.0, 1e-6, 2e-6]
FORCES = {"times": [0.0, 1.0, 2.0], "force": [0.0, 1.0, 2.0]}
APPROACHES = {"times": [0.0, 1.0, 2.0], "approach": DROPS}
TILTS = {"tilt_x": [1e-4, 2e-4, 3e-4], "tilt_y": [1e-4, 2e-4, 3e-4]}
PLACES = {"eccentricity_x": LINE, "eccentricity_y": LINE}
SPHERE = reference.SphereProfile(0.01)
WAVES = surfaces.Surface(1e-6 * np.cos(np.arange(16) * np.pi / 8) * np.ones((16, 1)), 1e-5)
RECTANGLE = {"pressure": 1e6, "half_length": 1e-3, "half_width": 2e-3}
SERIES = {"radius": 1e-3, **CREEP_SERIES}


def _soft(t: Any) -> Any:
    return 1e-9 * (2.0 - np.exp(-t))


#: Arguments of functions and classes, in one call or several.
CALLS: dict[str, tuple[dict[str, Any], ...]] = {
    "ApproachHistory": ({**APPROACHES, **TILTS},),
    "AutomaticGrid": ({"largest_cell": (1e-3, 2e-3)},),
    "ContactRecord": ({"times": ROWS, "force": ROWS, "approach": ROWS},),
    "CreepSeries": (CREEP_SERIES,),
    "ForceCurve": (
        {**dict.fromkeys(("times", "position", "deflection"), ROWS), "spring_constant": 1},
    ),
    "ForceHistory": ({**FORCES, **TILTS}, {**FORCES, **PLACES}),
    "Grid": ({"shape": (4, 4), "size": (1e-3, 2e-3), "centre": (1e-3, 2e-3)},),
    "HeightMap": ({"x": LINE[:2], "y": LINE[:2], "height": MAP},),
    "IndentationRecord": (
        {"indenter": BALL, **dict.fromkeys(("times", "approach", "force"), ROWS)},
    ),
    "Isotherm": (
        {"temperature": 300.0, "points": [1.0, 2.0], "measured": {"modulus": [2e6, 1e6]}},
    ),
    "MixedHistory": (
        {
            **{"times": [0.0, 1.0, 2.0], "controls": ["force", "force"]},
            **{"begins": [0.0, 1.0], "ends": [1.0, 2.0]},
        },
    ),
    "RelaxationSeries": (PRONY,),
    "Revolved": ({"r": LINE, "drops": DROPS},),
    "Roller": ({"radius": 5e-3, "half_length": 2e-3, "profile": [[0.0, 0.0], [2e-3, 1e-6]]},),
    "Surface": ({"heights": MAP, "spacing": (1e-3, 2e-3)},),
    "Swept": ({"y": LINE, "drops": DROPS},),
    "TabulatedCreep": (CREEP,),
    "MeasuredRange": ({"temperatures": [290.0, 300.0]},),
    "TabulatedProfile": ({"x": LINE, "drops": DROPS},),
    "TabulatedRelaxation": (RELAXED,),
    "TabulatedShift": (
        {"temperatures": [290.0, 300.0], "factors": [3.0, 1.0], "vertical": [0.9, 1.0]},
    ),
    "TangentialHistory": (
        {
            **{"times": [0.0, 1.0, 2.0], "force_x": LINE, "force_y": LINE, "torque": LINE},
        },
        {
            **{"times": [0.0, 1.0, 2.0], "displacement_x": LINE, "displacement_y": LINE},
            **{"rotation": LINE},
        },
    ),
    "TemperatureHistory": ({"times": [0.0, 1.0, 2.0], "temperature": [290.0, 300.0, 310.0]},),
    "Travel": ({"times": [0.0, 1.0, 2.0], "x": LINE, "y": LINE},),
    "clustered_times": ({"corners": [0.0, 1.0], "count": 4},),
    "cropped": (
        {"surface": surfaces.Surface(np.zeros((9, 9)), 1e-3), "x": (1e-3, 5e-3), "y": (1e-3, 5e-3)},
    ),
    "creep_curve": ({"law": RUBBER.law, "times": [1.0, 2.0]},),
    "draw_indenter": (
        {
            **{"indenter": BALL, "size": (1e-3, 2e-3), "contact": (0.0, 0.0, 1e-4, 2e-4)},
            "ends": [-1e-4, 2e-4],
        },
    ),
    "fit_creep": ({**CREEP, "data": "shear"}, {**CREEP, **HEATED}),
    "fit_each": (
        {
            "fit": partial(vc.fit_indentation, law="elastic", poisson_ratio=0.5),
            "curves": {"a": vc.IndentationRecord(BALL, *(3 * [np.array(ROWS) / 1e6]))},
            "places": {"a": [1e-6, 2e-6]},
        },
    ),
    "fit_dynamic": (
        {
            **{"angular_frequency": [1.0, 2.0, 4.0], "data": "shear"},
            **{"storage": [1e6, 2e6, 3e6], "loss": [1e6, 1e6, 1e6]},
        },
    ),
    "fit_relaxation": ({**RELAXED, "data": "shear"}, {**RELAXED, **HEATED}),
    "march": ({**RUN, "load": vc.ramp(0.1, 1.0), "times": [0.0, 1.0], "fields": [1.0]},),
    "material_curves": ({"law": RUBBER.law, "times": (1.0, 9.0), "measured": (1.0, 9.0)},),
    "persson_area": ({"surface": WAVES, "material": RUBBER, "pressure": [1e4, 2e4], "time": 1.0},),
    "persson_sliding": (
        {"surface": WAVES, "material": RUBBER, "pressure": 1e4, "speed": [1e-3, 1e-2]},
    ),
    "point_load": ({"force": 1.0, "contact_modulus": 1e9, "distance": LINE[1:]},),
    "press_axisymmetric": tuple(
        {
            **load,
            "profile": reference.SphereProfile(0.01),
            "creep_compliance": _soft,
            "elements": 20,
        }
        for load in (FORCES, APPROACHES)
    ),
    "punch_harmonic_start": (
        {**SERIES, "t": [0.0, 1.0], "mean": 2.0, "amplitude": 1.0, "angular_frequency": 1.0},
    ),
    "punch_staircase": (
        {
            **{"t": [0.0, 1.0], "jump_times": [0.0, 1.0], "forces": [1.0, 2.0]},
            **{"radius": 1e-3, "creep_compliance": _soft},
        },
    ),
    "rectangle_displacement": ({**RECTANGLE, "contact_modulus": 1e9, "x": LINE, "y": LINE},),
    "circle_displacement": (
        {"pressure": 1e6, "radius": 1e-3, "contact_modulus": 1e9, "r": [0.0, 1e-3, 2e-3, 3e-3]},
    ),
    "hertz_displacement": (
        {"peak_pressure": 1e6, "radius": 1e-3, "contact_modulus": 1e9, "r": [0.0, 1e-3, 2e-3]},
    ),
    "rectangle_stress": ({**RECTANGLE, "x": LINE, "y": LINE, "depth": [*LINE[1:], 4e-3]},),
    "resampled": ({"surface": surfaces.Surface(np.zeros((9, 9)), 1e-3), "cell": (2e-3, 3e-3)},),
    "series_complex_compliance": ({**CREEP_SERIES, "angular_frequency": 1.0},),
    "simulate": (
        {**RUN, "load": vc.ramp(0.1, 1.0), "times": [0.0, 1.0], "fields": [1.0], "errors": False},
    ),
    "steady": (
        {
            **{**RUN, "grid": vc.Grid((24, 24), (2.4e-3, 2.4e-3)), "errors": False},
            **{"load": vc.step(0.1, tilt_y=0.0), "speed": [1e-3], "fields": [1e-3]},
        },
        {
            **{**RUN, "grid": vc.Grid((24, 24), (2.4e-3, 2.4e-3)), "errors": False},
            **{"load": vc.step(0.1, tilt_y=0.0), "speed": [1e-3], "fields": [1e-3]},
            **{"friction": vc.Friction(0.3, coupling=False), "creepage": [1e-3, 2e-3]},
        },
    ),
    "rolling_temperature": (
        {
            **{"curve": rolling_curve(), "cooling": 10.0, "ambient": 333.15},
            **{"speed": [0.1, 1.0], "conductivity": 0.2},
        },
    ),
    "strip_stresses": ({"pressure": 1e6, "half_width": 1e-3, "y": LINE[1:], "depth": LINE[1:]},),
    "ting_triangle": (
        {**PRONY, "profile": reference.SphereProfile(0.01), "peak": 1.0, "rise": 1.0},
    ),
    "under_pressure": (
        {
            **{"material": RUBBER, "grid": vc.Grid((4, 4), (3e-3, 2e-3)), "times": [0.0, 1.0]},
            "pressure": np.arange(16.0).reshape(4, 4).tolist(),
        },
    ),
    "write_dxf": ({"path": Path("line.dxf"), "x": LINE, "drop": LINE},),
}


#: Arguments of methods by their names.
OF_METHODS: dict[str, Any] = {
    **{name: [1e-4, 2e-4] for name in ("x", "y", "r")},
    **{name: [0.5, 1.0] for name in ("t", "times", "start")},
    **{"end": [1.5, 2.0], "heights": MAP, "temperature": [290.0, 300.0], "half_length": 2e-3},
    **{"angular_frequency": [1.0, 2.0], "approach": DROPS},
}

#: Objects of all classes whose methods take arrays.
OBJECTS: tuple[Any, ...] = (
    *(BALL, vc.Cone(1.0), vc.Paraboloid(0.01, 0.02), vc.FlatPunch(1e-3), vc.Torus(0.01, 2e-3)),
    *(vc.Ellipsoid(0.01, 0.02, 0.01), vc.Pyramid(1.0, 4), vc.Wedge(1.0), vc.Waviness(1e-6, 1e-3)),
    *(vc.Dimples(1e-4, 2e-4, 1e-3), vc.HeightMap(LINE[:2], LINE[:2], MAP), vc.Swept(LINE, DROPS)),
    *(vc.Revolved(LINE, DROPS), vc.Roller(5e-3, 2e-3), BALL.shifted(x=1e-3), BALL + BALL),
    *(vc.CylindricalProfile(), vc.FullCrown(1.0), vc.PartialCrown(1.0), vc.Chamfer(1e-4, 0.5)),
    *(vc.TwoRadiiCrown(1.0, 1e-3, 0.5), vc.TabulatedProfile(LINE, DROPS)),
    *(vc.LogarithmicProfile(1e-6), vc.Elastic(1e6), vc.PowerLaw(1e-9, 0.5, 1.0)),
    *(vc.WLF(290.0, 17.0, 51.0), vc.Ageing(1.0, 0.8)),
    vc.TemperatureHistory(**CALLS["TemperatureHistory"][0]),
    vc.HarmonicTemperature(290.0, 10.0, 60.0, 1),
    *(vc.ForceHistory(**FORCES), vc.ApproachHistory(**APPROACHES)),
    *(vc.harmonic(2.0, 1.0, 1.0, 3), loads.MixedHistory(**CALLS["MixedHistory"][0])),
    *(vc.Travel(**CALLS["Travel"][0]), vc.reciprocating(1e-3, 1.0, 2)),
    *(surfaces.Surface(MAP, 1e-3), vc.IndentationRecord(**CALLS["IndentationRecord"][0])),
    reference.cattaneo_mindlin(10.0, 0.01, 2e9, 1.5, 0.3),
    *(reference.hertz_sphere(1.0, 0.01, 1e6), reference.hertz_line(1.0, 0.01, 1e6)),
    *(reference.hertz_elliptical(1.0, 0.01, 0.02, 1e6), reference.westergaard(1.0, 1e-6, 1.0, 1e6)),
    *(reference.flat_punch(1.0, 1e-3, 1e6), reference.cone(1.0, 1.0, 1e6)),
    reference.layer_punch(1e-3, 1e-6, 1e-3, shear_modulus=1e6, poisson_ratio=0.3),
    reference.lee_radok_step(1.0, 0.01, lambda t: 1e-6 + 0 * t, lambda t: 1e6 + 0 * t),
    reference.ting_cycles(reference.SphereProfile(0.01), 1e-6, 1.0, 1e6, 1.0),
    reference.ting_force_triangle(1.0, 1.0, 0.01, 1e6, 1.0),
)


@cache
def a_run() -> Any:
    """Result over time."""
    return synthetic_results.maxwell_sphere(cells=16)


@cache
def a_run_under_friction() -> Any:
    """Result over time, with tractions."""
    return synthetic_results.gripping_sphere(cells=16)


@cache
def a_run_with_adhesion() -> Any:
    """Result over time, of bodies that adhere."""
    grid, times = vc.Grid((24, 24), (2.4e-4, 2.4e-4)), [0.0, 2.0, 50.0, 100.0]
    gel = vc.Material(vc.Elastic(0.25e6), poisson_ratio=0.5)
    return vc.simulate(
        *(vc.Paraboloid(1e-3, 1e-3), gel, vc.ramp(approach=1e-6, duration=100.0), grid, times),
        adhesion=vc.Adhesion(0.05, range=1.4e-6),
        errors=False,
    )


@cache
def a_layered_run() -> Any:
    """Result over time, on layers."""
    layers = vc.Layered([vc.Layer(1e-4, RUBBER)], base=RUBBER)
    return vc.simulate(BALL, layers, vc.step(0.1), RUN["grid"], [0.0, 10.0], errors=False)


def several_runs() -> dict[str, Any]:
    """Results by name."""
    return {"run": a_run()}


@cache
def a_steady_motion() -> Any:
    """Result over speed."""
    return vc.steady(**CALLS["steady"][0])


#: Results that are made where they are needed.
LATER = (
    *(a_run, a_run_under_friction, a_run_with_adhesion, a_layered_run, several_runs),
    a_steady_motion,
)


@dataclass(frozen=True)
class Argument:
    """An argument that holds several numbers, of a call that works."""

    function: str
    call: Callable[..., Any]
    given: dict[str, Any]
    name: str
    unit: str

    @property
    def named(self) -> str:
        """Name in messages; the points of an isotherm and its columns have their own."""
        return {"points": "times", "measured": "modulus|measured"}.get(self.name, self.name)

    def with_value(self, value: Any) -> Any:
        """Call with another value of this argument."""
        if isinstance(self.given[self.name], dict):  # columns or places by name
            value = dict.fromkeys(self.given[self.name], value)
        given = {**self.given, self.name: value}
        for name, each in given.items():
            if callable(each) and each in LATER:
                given[name] = each()
        return self.call(**given)


def takes_arrays(call: Callable[..., Any]) -> list[str]:
    """Names of the arguments that hold several numbers, by their annotations."""
    parameters = inspect.signature(call).parameters.values()
    return [each.name for each in parameters if ARRAY.search(str(each.annotation))]


def exported() -> Iterator[tuple[str, Any]]:
    """Functions and classes of the public modules that users call, each once."""
    modules = (plot, reference, surfaces, loads, laws, indenters, vc)
    named = {
        id(found): (f"{module.__name__.removeprefix('viscontact.')}.{name}", found)
        for module in modules
        for name in module.__all__
        if name not in MADE_BY_THE_PACKAGE and callable(found := getattr(module, name))
    }
    for place, found in named.values():
        if not (isinstance(found, type) and issubclass(found, Exception)):
            yield place, found


def public_calls() -> Iterator[tuple[str, Callable[..., Any], tuple[dict[str, Any], ...]]]:
    """Functions, classes and methods of the public modules that take arrays, and their calls."""
    for place, found in exported():
        name = place.rpartition(".")[2]
        if takes_arrays(found):
            yield place, found, CALLS.get(name) or _of_result(found)
        for way in ("from_shear", "from_uniaxial"):
            if takes_arrays(make := getattr(found, way, found)) and make is not found:
                more = {"poisson_ratio": 0.3} if way == "from_uniaxial" else {}
                yield f"{place}.{way}", make, tuple({**each, **more} for each in CALLS[name])


def _of_result(call: Callable[..., Any]) -> tuple[dict[str, Any], ...]:
    """Call of a function of a result, or of several."""
    first, *others = inspect.signature(call).parameters
    if first not in ("results", "ds", "runs"):
        return ()
    places = {"times": [2.0, 100.0], "depths": [1e-4, 2e-4], "speeds": [1e-3]}
    run = a_steady_motion if "speeds" in others else several_runs if first == "runs" else a_run
    run = a_layered_run if call is vc.interface_stresses else run
    if call in (plot.stick_map, plot.traction_profile, plot.fretting_loop, plot.slip_history):
        run = a_run_under_friction
    run = a_run_with_adhesion if call is plot.force_curve else run
    return ({first: run, **{name: places[name] for name in others if name in places}},)


def public_methods() -> Iterator[tuple[str, Callable[..., Any], tuple[dict[str, Any], ...]]]:
    """Methods that take arrays, each once: of the objects with a call, of other classes without."""
    seen = set()
    for owner in OBJECTS:
        for method in _methods(owner, inspect.ismethod):
            if method.__func__ not in seen:
                seen.add(method.__func__)
                names = inspect.signature(method).parameters
                given = {each: OF_METHODS[each] for each in names if each in OF_METHODS}
                yield method.__qualname__, method, (given,)
    for _, owner in exported():
        for method in _methods(owner, inspect.isfunction) if isinstance(owner, type) else ():
            if method not in seen and not inspect.isabstract(owner):
                yield method.__qualname__, method, ()


def _methods(owner: Any, kind: Callable[[object], bool]) -> Iterator[Any]:
    for name, method in inspect.getmembers(owner, kind):
        is_public = name == "__call__" or not name.startswith("_")
        if is_public and name not in MADE_BY_THE_PACKAGE and takes_arrays(method):
            yield method


def array_arguments() -> list[Argument]:
    """All arguments that hold several numbers."""
    found = []
    for function, call, calls in (*public_calls(), *public_methods()):
        for given in calls:
            for name in takes_arrays(call):
                if name in given:
                    found.append(Argument(function, call, given, name, unit_in(call, name, given)))
    return found


def unit_in(call: Callable[..., Any], name: str, given: dict[str, Any]) -> str:
    """SI unit of an argument: that of the field, or by its name."""
    owner = getattr(call, "__self__", call)  # from_shear of a class
    if name == "fields":
        return "m/s" if "speed" in given else "s"
    if name == "measured":
        return "Pa" if isinstance(given[name], dict) else "s"
    with suppress(KeyError, TypeError):
        unit = unit_of(owner, name, "force") if isinstance(owner, type) else None
        if unit is not None:
            return unit
    return UNITS.get(name, "s")
