"""Compliance and modulus of laws over time and frequency, and the points they are based on."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Literal

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws import Law
from viscontact.bodies.materials.layers import creeping_laws
from viscontact.bodies.materials.library import Points
from viscontact.drawing.content.panel import FIRST, Axis, Curve, Ink, Mark, Panel
from viscontact.results.creep_times import follows_clock, law_times
from viscontact.results.recorded_objects import recorded_object
from viscontact.units.formatting import ReadableUnit, readable_unit
from viscontact.units.numbers import real_array

_NAME = "creep"
#: Four decades show how the law gets to where the run begins [-]; points of a curve.
_EARLIEST, _POINTS, _SAMPLES = 1e-4, 300, 241
#: Part of its largest value below which a curve is not drawn.
_DEPTH = 1e-6
#: Ratio of the ends of an axis, and its power with margins, from which on it is logarithmic.
_DECADE, _WITH_MARGINS = 8.0, 1.1
#: Names of the axis of a law.
TIME, REDUCED = "Time", "Reduced time"
_COMPLIANCE, _MODULUS = ("Creep compliance Φ", "1/Pa"), ("Relaxation modulus G", "Pa")


def recorded_laws(runs: Mapping[str, xr.Dataset]) -> dict[str, Law]:
    """Laws of the parts of half-spaces that creep, by the names of their runs."""
    return {
        f"{name} {part}".strip(): law
        for name, run in runs.items()
        for part, law in creeping_laws(recorded_object(run, "material", _NAME)).items()
    }


def run_times(runs: Mapping[str, xr.Dataset], times: ArrayLike | None) -> Floats:
    """Instants to draw the laws of runs at [s], over a span or the times of the runs."""
    simulated = np.concatenate([law_times(run) for run in runs.values()])
    span = simulated if times is None else np.atleast_1d(real_array(f"{_NAME}: times", times, "s"))
    positive = span[span > 0]
    if positive.size == 0 or not np.all(np.isfinite(span)):
        raise ValueError(f"{_NAME}: times must be finite with one above 0 s, got {times!r}")
    return curve_times(float(positive.max()), float(positive.min()))


def curve_times(end: float, first: float = np.inf) -> Floats:
    """Times up to the end of a run at which its law is drawn, from the first or earlier [s]."""
    return np.geomspace(min(first, _EARLIEST * end), end, _POINTS)


def time_of_laws(runs: Iterable[xr.Dataset], part: str = "material") -> str:
    """Name of the time over which the laws of runs are drawn."""
    return REDUCED if any(follows_clock(run, part) for run in runs) else TIME


def creep_panels(laws: Mapping[str, Law], times: Floats, along: str = TIME) -> list[Panel]:
    """Panels of compliance and modulus; without the modulus if a law has none at time 0."""
    compliances = {name: (law(times), float(law(0.0))) for name, law in laws.items()}
    panels = [_over_time(*_COMPLIANCE, times, compliances, along)]
    if all(at_once > 0 for _, at_once in compliances.values()):
        moduli = {
            name: (law.relaxation(times), float(law.relaxation(0.0))) for name, law in laws.items()
        }
        panels.append(_over_time(*_MODULUS, times, moduli, along))
    return panels


def _over_time(
    quantity: str,
    si: str,
    times: Floats,
    curves: Mapping[str, tuple[Floats, float]],
    along: str,
) -> Panel:
    """Panel of curves, of a single one with its value at time 0, which is not on the axis."""
    x, (first, end) = readable_unit("s", times), times[[0, -1]].tolist()
    at_once = [value for _, value in curves.values()]
    # Its text is on the side of the level where the curve is not.
    falls = [bool(values[-1] <= value) for values, value in curves.values()]
    level = Mark(at_once[0], "y", "t = 0", "dashed", is_text_below=falls[0])
    return Panel(
        Axis(along, x, (first, end), "log", first, in_clock_units=True),
        Axis.of(quantity, si, at_once, *(values for values, _ in curves.values())),
        tuple(
            Curve(times, values, name, Ink(place=number))
            for number, (name, (values, _)) in enumerate(curves.items())
        ),
        marks=(level,) if len(curves) == 1 else (),
    )


def material_panels(
    law: Law,
    times: tuple[float, float],
    known: tuple[float, float] | None,
    points: Sequence[Points],
) -> list[Panel]:
    """Panels of compliance and modulus over time, and of storage and loss over frequency."""
    first, last = real_array("material_curves: times", times, "s", 1).tolist()
    if known is not None:
        begin, end = real_array("material_curves: measured", known, "s", 1).tolist()
        known = begin, end
    if not (0 < first < last < np.inf):
        raise ValueError(
            f"material_curves: times must be two, above 0 s and increasing, got {times!r} s"
        )
    at = np.geomspace(first, last, _SAMPLES)
    over, omega = ("Time", "s"), 1.0 / at[::-1]
    compliance = _Part(law(at), "creep_compliance")
    panels = [_known_panel(over, at, _COMPLIANCE, [compliance], known, points)]
    if float(law(0.0)) > 0:
        modulus = _Part(law.relaxation(at), "relaxation_modulus")
        panels.append(_known_panel(over, at, _MODULUS, [modulus], known, points))
    dynamic = law.complex_modulus(omega)
    parts = [
        _Part(dynamic.real, "storage_modulus", "storage G′"),
        _Part(dynamic.imag, "loss_modulus", "loss G″", Ink("fit")),
    ]
    within = known and (1.0 / known[1], 1.0 / known[0] if known[0] else np.inf)
    over = ("Angular frequency", "rad/s")
    last_panel = _known_panel(over, omega, ("Modulus", "Pa"), parts, within, points)
    note = "shaded: what the constants rest on" if known else ""
    return [*panels, replace(last_panel, note=note)]


@dataclass(frozen=True, eq=False)
class _Part:
    """Values of a quantity of a law [SI]."""

    values: Floats
    quantity: str  # as in `Points`
    name: str = ""
    ink: Ink = FIRST


def _known_panel(
    over: tuple[str, str],
    at: Floats,
    of: tuple[str, str],
    parts: Sequence[_Part],
    known: tuple[float, float] | None,
    points: Sequence[Points],
) -> Panel:
    """Panel of curves over times or frequencies, whose known range is shaded."""
    low, high = ends = float(at[0]), float(at[-1])
    curves = [curve for part in parts for curve in _curves(part, at, known, points)]
    return Panel(
        Axis(over[0], ReadableUnit(over[1], 1.0), ends, "log", low),
        Axis(of[0], _middle_unit(of[1], parts[0].values), scale=_positive_scale(curves)),
        tuple(curves),
        shaded=known and (max(known[0], low), min(known[1], high)),
    )


def _curves(
    part: _Part, at: Floats, known: tuple[float, float] | None, points: Sequence[Points]
) -> Iterator[Curve]:
    """Yield a curve dashed, solid within its known range, and the points for comparison."""
    first, last = known or (0.0, np.inf)
    inside = (at >= first * (1 - 1e-9)) & (at <= last * (1 + 1e-9))
    is_shown = _continuation(_worth_showing(part.values), inside)
    shown = np.where(is_shown, part.values, np.nan)
    yield Curve(at, shown, ink=part.ink, look="beyond")
    yield Curve(at[inside], shown[inside], part.name, part.ink)
    given = [each for each in points if each.quantity == part.quantity]
    for number, each in enumerate(given):
        yield Curve(each.at, each.values, ink=part.ink, look="white", symbol=number)


def _positive_scale(curves: Sequence[Curve]) -> Literal["linear", "log"]:
    """Scale of positive curves: within one decade a logarithmic axis has hardly a tick to read."""
    values = np.concatenate([curve.y[curve.y > 0] for curve in curves])
    span = values.max() / values.min() if values.size else 1.0
    return "linear" if span > 1.0 and span**_WITH_MARGINS < _DECADE else "log"


def _worth_showing(values: Floats) -> Bools:
    # What a liquid has left after ten of its longest times, or an elastic body as its loss, is
    # nothing: it must not press the rest of the curve together.
    return np.asarray(values > _DEPTH * values.max(initial=0.0))


def _continuation(shown: Bools, inside: Bools) -> Bools:
    """Mask of the curve beyond its range, up to its first zero."""
    within = np.flatnonzero(inside)
    if not within.size:
        return shown
    first, last = int(within[0]), int(within[-1])
    shown = shown.copy()
    shown[first::-1] = np.logical_and.accumulate(shown[first::-1])
    shown[last:] = np.logical_and.accumulate(shown[last:])
    return shown


def _middle_unit(si_unit: str, values: Floats) -> ReadableUnit:
    """Unit in which the middle of a logarithmic axis is readable."""
    good = values[_worth_showing(values)]
    return readable_unit(si_unit, float(np.exp(np.log(good).mean())) if good.size else 0.0)
