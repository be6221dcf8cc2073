"""Friction coefficient over speed with the limits of slow and fast motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import xarray as xr

from viscontact import reference
from viscontact.backend.arrays import Floats
from viscontact.bodies.indenters import Indenter, Paraboloid, Roller, Sphere
from viscontact.bodies.materials.compliance import SeriesCompliance
from viscontact.bodies.materials.material import Material
from viscontact.drawing.content.along_run import texts_along
from viscontact.drawing.content.ordered_names import inks_of
from viscontact.drawing.content.panel import (
    FAINT,
    FIRST,
    SECOND,
    Axis,
    Curve,
    Ink,
    Panel,
    ShadedRange,
    Units,
)
from viscontact.drawing.content.rough_theory import theory_band, theory_curves
from viscontact.results.recorded_case import case_of
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.recorded_theory import sliding_of_theory
from viscontact.results.stated_errors import errors_of
from viscontact.results.variables import SCALARS
from viscontact.units.formatting import readable_unit

NAME = "friction_coefficient"
#: Bodies of constant curvature along their motion.
_ROUND = (Paraboloid, Sphere, Roller)
#: Speeds of the curves of the limits, and room above and below the values, as a factor: with
#: limits, which are drawn as far as they lie within, and of values alone.
_SAMPLES, _ROOM, _LITTLE_ROOM = 60, 2.0, 1.3


def friction_panel(
    run: xr.Dataset,
    units: Units = readable_unit,
    reference: xr.Dataset | None = None,
    *,
    theory: bool = False,
) -> Panel:
    """Panel of a result over speed in order, first, a reference beside it, limits and theory."""
    positive = run[NAME].values[run[NAME].values > 0]
    lowest, highest = float(positive.min()) / _ROOM, float(positive.max()) * _ROOM
    speeds = limit_speeds(run)
    limits = [
        Curve(speeds, limit, name, FAINT, "dashed" if name.endswith("slow motion") else "dotted")
        for name, limit in friction_limits(run, speeds)
        if ((limit > lowest) & (limit < highest)).any()
    ]
    others = [] if reference is None else [_curve(reference, SECOND)]
    bands: tuple[ShadedRange, ...] = ()
    if theory:
        band = theory_band(sliding_of_theory(run, "friction"))
        bands, others = (band,), [*others, *theory_curves(band)]
        lowest = min(lowest, float(band.low.min()) / _ROOM)
        highest = max(highest, float(band.high.max()) * _ROOM)
    variable = SCALARS[NAME]
    return Panel(
        Axis("Speed", units("m/s", speeds), scale="log"),
        Axis(variable.label, units(variable.units), (lowest, highest), "log"),
        (_curve(run, FIRST), *others, *limits),
        bands=bands,
        name=NAME,
    )


def frictions_panel(runs: Mapping[str, xr.Dataset]) -> Panel:
    """Panel of several results over speed, in order, by name."""
    values = np.concatenate([run[NAME].values for run in runs.values()])
    positive, variable = values[values > 0], SCALARS[NAME]
    limits = float(positive.min()) / _LITTLE_ROOM, float(positive.max()) * _LITTLE_ROOM
    speeds = np.concatenate([run["speed"].values for run in runs.values()])
    return Panel(
        Axis("Speed", readable_unit("m/s", speeds), scale="log"),
        Axis(variable.label, readable_unit(variable.units), limits, "log"),
        tuple(
            replace(_curve(run, ink), name=name)
            for (name, run), ink in zip(runs.items(), inks_of(list(runs)), strict=True)
        ),
        name=NAME,
    )


def _curve(run: xr.Dataset, ink: Ink) -> Curve:
    title = str(run.attrs.get("title") or f"along {run.attrs.get('along', '')}".strip())
    values, texts = run[NAME].values, texts_along(run, NAME)
    error = errors_of(run, NAME)
    return Curve(run["speed"].values, values, title, ink, "joined", error=error, texts=texts)


def limit_speeds(results: xr.Dataset) -> Floats:
    """Return the speeds at which the curves of the limits are drawn [m/s]."""
    speeds = results["speed"].values
    return np.geomspace(speeds.min(), speeds.max(), _SAMPLES)


def friction_limits(results: xr.Dataset, speeds: Floats) -> list[tuple[str, Floats]]:
    """Limits that hold for the body and its material: names, and values at some speeds."""
    body, series = round_body(results, "friction"), contact_series(results, "friction")
    if body is None or series is None:
        return []
    if not series.amplitudes.size + series.fluidity:
        return []
    curvature = body.curvatures["xy".index(str(results.attrs["along"]))]
    found = []
    if curvature > 0 and not series.fluidity:
        relaxed = series.instant + float(series.amplitudes.sum())
        mean_time = float(series.amplitudes @ series.times) / relaxed
        slow = [
            reference.slow_friction_coefficient(1 / curvature, mean_time, speed)
            for speed in speeds.tolist()
        ]
        found.append(("limit of slow motion", np.array(slow)))
    is_ball = not isinstance(body, Roller) and body.curvatures[0] == body.curvatures[1]
    if is_ball and series.instant > 0:
        rate = float((series.amplitudes / series.times).sum()) + series.fluidity
        force = float(results["force"].max())
        fast = [
            reference.fast_sphere_friction_coefficient(
                force, 1 / curvature, series.instant, rate, speed
            )
            for speed in speeds.tolist()
        ]
        found.append(("limit of fast motion", np.array(fast)))
    return found


def round_body(results: xr.Dataset, figure: str) -> Indenter | None:
    """Indenter of a result, if its curvature is constant."""
    kind = (case_of(results).get("indenter") or {}).get("type")
    if kind not in {round_body.__name__ for round_body in _ROUND}:
        return None
    body = recorded_object(results, "indenter", figure)
    assert isinstance(body, Indenter)
    return body


def contact_series(results: xr.Dataset, figure: str) -> SeriesCompliance | None:
    """Contact compliance of both bodies if only the half-space creeps, and as a series."""
    material = recorded_object(results, "material", figure)
    mate = recorded_object(results, "indenter_material", figure)
    if not isinstance(material, Material) or not isinstance(mate, Material | None):
        return None
    found = material.contact_compliance()
    if not isinstance(found, SeriesCompliance):
        return None
    if mate is None:
        return found
    other = mate.contact_compliance()
    if not isinstance(other, SeriesCompliance) or other.amplitudes.size or other.fluidity:
        return None
    both = found + other
    assert isinstance(both, SeriesCompliance)
    return both
