"""Limits of the theory for one run: warnings and assumptions."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator

import numpy as np
import xarray as xr

from viscontact.bodies.materials.layers import named_parts
from viscontact.mechanics.state import Outcome
from viscontact.results.creep_times import creep_times
from viscontact.results.recorded_case import case_of, is_layered, recorded_ends
from viscontact.results.recorded_objects import recorded_object
from viscontact.results.run_axis import run_axis
from viscontact.units.formatting import format_number, format_quantity


def notices(ds: xr.Dataset) -> list[str]:
    """Notices for the head of the page: an early end, failed instants."""
    sentences = []
    axis = run_axis(ds)
    times, reached = case_of(ds).get("times") or [], float(ds[axis.name][-1])
    speeds = (case_of(ds).get("motion") or {}).get("speed") or []
    if not axis.is_history and ds.sizes["speed"] < len(speeds):
        sentences.append(
            f"The run ended after {ds.sizes['speed']} of {len(speeds)} speeds: this page shows "
            "what it had completed."
        )
    if times and reached < float(times[-1]):
        sentences.append(
            f"The run ended at t = {format_quantity(reached, 's')}, before its last instant, t = "
            f"{format_quantity(float(times[-1]), 's')}: this page shows what it had completed."
        )
    failed = int((ds["outcome"].values == Outcome.NOT_CONVERGED).sum())
    if failed:
        sentences.append(
            f"The solver did not converge at {failed} of {ds.sizes[axis.name]} {axis.row}s."
        )
    return sentences


def warnings_of(ds: xr.Dataset) -> list[str]:
    """Warnings of a run, each once, and enlargements of its grid."""
    enlarged = str(ds.attrs.get("grid_enlarged", "")).splitlines()
    lines = [
        *str(ds.attrs.get("warnings", "")).splitlines(),
        *(f"grid enlarged at {line}" for line in enlarged),
    ]
    return list(dict.fromkeys(filter(None, lines)))


def assumptions(ds: xr.Dataset) -> Iterator[tuple[str, str]]:
    """Yield the assumptions of the theory with this run's numbers: title and text."""
    if is_layered(ds) or is_layered(ds, "indenter_material"):
        unbounded = "surface and layers are plane and unbounded, and the base is infinitely deep"
        yield "Layers", f"{unbounded}{_size(ds)}"
    else:
        yield "Half-space", f"the surface is unbounded, and so is the body below it{_size(ds)}"
    if recorded_ends(ds):
        yield "Ends", "bodies end along x at planes, free of stress or held without friction"
    yield (
        "Small slopes",
        (
            "surfaces are nearly level where they touch, and displacements are along z only. "
            f"{_approach(ds)}"
        ),
    )
    yield _friction(ds)
    yield _adhesion(ds)
    yield (
        "Linear viscoelasticity",
        (f"twice the load gives twice the strain at any time, and {_clock(ds)}. {_strain(ds)}"),
    )
    yield "No inertia", "loads change slowly against the time that waves take through the contact."


def _friction(ds: xr.Dataset) -> tuple[str, str]:
    """What the contact transmits along the surface."""
    friction = case_of(ds).get("friction")
    if friction is None:
        return "No friction", "the contact transmits pressure only."
    coefficient = f"{float(friction['coefficient']):g}"
    return (
        "Friction of Coulomb",
        f"the surfaces slip where the traction reaches {coefficient} times the pressure.",
    )


def _adhesion(ds: xr.Dataset) -> tuple[str, str]:
    """What holds the surfaces together."""
    if case_of(ds).get("adhesion") is None:
        alone = "the surfaces do not attract each other; contact ends where the pressure is zero."
        return "No adhesion", alone
    work = format_quantity(recorded_object(ds, "adhesion", "report").work, "J/m²", 3)
    return (
        "Adhesion over the gap",
        f"the attraction depends on the gap alone, whichever way it changes, with a work of {work} "
        "per area, and contact ends where the gap opens.",
    )


def _clock(ds: xr.Dataset) -> str:
    """What the creep follows, as the end of a sentence."""
    if "reduced_time" not in ds and "reduced_time_indenter" not in ds:
        return "the material neither ages nor changes its temperature"
    if "temperature" not in ds:
        return "the creep slows down only by the ageing that is given"
    return (
        "all its times change with the temperature by one factor (a thermorheologically simple "
        "material); the temperature is even in the bodies"
    )


def _size(ds: xr.Dataset) -> str:
    periodic = (case_of(ds).get("grid") or {}).get("periodic")
    if isinstance(periodic, list):
        axis = "xy"[periodic.index(True)]
        return f": one period of it along {axis} is pressed here; the approach has no datum."
    if periodic:
        return ": one period of it is pressed here; the approach is to its mean plane."
    length, width = (float(ds[name].max()) for name in ("contact_length", "contact_width"))
    return (
        f". Largest contact here: {format_quantity(length, 'm', 3)} along x, "
        f"{format_quantity(width, 'm', 3)} along y. A part that is not large compared with it in "
        "every direction deforms differently."
    )


def _approach(ds: xr.Dataset) -> str:
    approach, extents = np.abs(ds["approach"].values), ds["contact_width"].values
    shorter = float(min(ds["contact_length"].max(), extents.max()))
    if shorter <= 0 or np.isnan(approach).all():
        return ""
    part = float(approach.max()) / shorter
    largest = format_quantity(float(approach.max()), "m", 3)
    return (
        f"Largest approach here: {largest}, {format_number(part, 2)} of the contact's shorter side."
    )


#: Representative strain of a ball, in units of contact radius over radius of the ball.
_TABOR = 0.2


def _strain(ds: xr.Dataset) -> str:
    """Strain of the contact, with its definition; empty if it is not known."""
    try:
        found = (None if is_layered(ds) else _strain_of_shape(ds)) or _strain_of_stress(ds)
    except (ValueError, AttributeError, json.JSONDecodeError):
        return ""
    if found is None:
        return ""
    index, strain, definition = found
    axis = run_axis(ds)
    return (
        f"Largest strain, as {definition}: {format_number(strain, 2)}, at "
        f"{axis.place(float(ds[axis.name][index]))}. Check with your material data whether it is "
        "still linear at this strain."
    )


def _strain_of_shape(ds: xr.Dataset) -> tuple[int, float, str] | None:
    """Largest 0.2 a/R, half the contact over the radius of curvature (Tabor 1951), of x and y."""
    shape = recorded_object(ds, "indenter", "limits")
    if not hasattr(shape, "curvatures"):
        return None
    halves = np.stack([ds["contact_length"].values, ds["contact_width"].values]) / 2
    strains = _TABOR * halves * np.asarray(shape.curvatures)[:, None]
    index = int(np.nanmax(strains, axis=0).argmax())
    strain = float(np.nanmax(strains[:, index]))
    definition = "0.2 a/R with half the contact a and the radius of curvature R of the body"
    return (index, strain, definition) if math.isfinite(strain) and strain > 0 else None


def _strain_of_stress(ds: xr.Dataset) -> tuple[int, float, str] | None:
    """Largest product of mean pressure and creep compliance, of the top layer, at one instant."""
    uppermost = next(iter(named_parts(recorded_object(ds, "material", "limits")).values()))
    strains = ds["mean_pressure"].values * np.asarray(uppermost.law(creep_times(ds)))
    index = int(np.nan_to_num(strains).argmax())
    strain = float(strains[index])
    definition = "mean pressure times creep compliance at the same instant"
    return (index, strain, definition) if math.isfinite(strain) and strain > 0 else None
