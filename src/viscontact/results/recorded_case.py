"""The case that a result keeps as JSON: what it says of the run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.results.descriptions import parse_case, stored_class
from viscontact.units.axis_flags import AxisFlags

if TYPE_CHECKING:
    import xarray as xr

    from viscontact.results.stored_result import Result


def case_of(ds: Result) -> dict[str, Any]:
    """The case that a result keeps, not to be changed; empty where it keeps none."""
    try:
        return parse_case(str(ds.attrs.get("case", "")))
    except ValueError:
        return {}


def is_layered(results: Result, part: str = "material") -> bool:
    """True if a body of a result, the pressed one or the half-space, has layers."""
    body = case_of(results).get(part) or {}
    if body.get("type") == "Body":
        body = body["material"]
    return body.get("type") == "Layered"


def has_ends(results: Result, part: str = "material") -> bool:
    """True if a body of a result, the pressed one or the half-space, ends along x."""
    return (case_of(results).get(part) or {}).get("type") == "Body"


@dataclass(frozen=True)
class RecordedEnd:
    """End of a body of a result at a plane across x."""

    part: str  # "material" or "indenter_material"
    place: float  # [m]
    kind: str  # "free" or "held"


def recorded_ends(results: Result) -> tuple[RecordedEnd, ...]:
    """Ends of the bodies of a result, of the half-space first, that at -x before that at +x."""
    found = []
    for part in ("material", "indenter_material"):
        body = case_of(results).get(part) or {}
        if body.get("type") != "Body":
            continue
        for side, kind in zip((-1, 1), body["ends"], strict=True):
            if kind is not None:
                place = float(body["centre"]) + side * float(body["length"]) / 2
                found.append(RecordedEnd(part, place, str(kind)))
    return tuple(found)


def recorded_poisson_ratio(results: xr.Dataset, part: str = "material") -> float:
    """Poisson's ratio [-] of a half-space that a result belongs to."""
    if part == "indenter_material" and case_of(results).get(part) is None:
        raise ValueError("stresses: the indenter of this result is rigid")
    material = case_of(results).get(part) or {}
    if material.get("type") == "Body":
        material = material["material"]
    ratio = material.get("poisson_ratio")
    if ratio is not None:
        return float(ratio)
    if material.get("bulk_modulus") is not None:
        raise ValueError(
            "with an elastic bulk modulus Poisson's ratio varies in time, and the stresses depend "
            "on more than the present pressure; for an estimate give poisson_ratio="
        )
    raise ValueError("the result does not contain Poisson's ratio; give poisson_ratio=")


def recorded_grid(results: Result) -> Grid:
    """Grid of a result: shape, size and centre from its coordinates, periodic as in its case."""
    # Coordinates do not show the length of a single cell.
    x, y = results["x"].values, results["y"].values
    recorded = case_of(results).get("grid") or {}
    along, across = (
        float(at[1] - at[0]) * at.size if at.size > 1 else float(recorded["size"][axis])
        for axis, at in enumerate((x, y))
    )
    centre = (float(x[0] + x[-1]) / 2, float(y[0] + y[-1]) / 2)
    periodic = recorded.get("periodic", False)
    return Grid((x.size, y.size), (along, across), periodic, centre=centre)


def across_period(results: Result) -> Literal["x", "y"] | None:
    """Axis across the only one along which a result's grid is periodic; None without such."""
    periodic = AxisFlags((case_of(results).get("grid") or {}).get("periodic", False))
    return None if periodic[0] == periodic[1] else "y" if periodic[0] else "x"


def prescribes_approach(ds: Result) -> bool:
    """True if the load of a run prescribes the approach, so that the force is computed."""
    load = case_of(ds).get("load") or {}
    kind = stored_class(load.get("type", ""))
    return bool(load.get("control", getattr(kind, "control", "force")) == "approach")


def has_mixed_control(ds: Result) -> bool:
    """True if the load of a run prescribes the force on some segments, the approach on others."""
    load = case_of(ds).get("load") or {}
    kind = stored_class(load.get("type", ""))
    return getattr(kind, "control", "") == "mixed"


def is_prescribed(ds: Result, name: str) -> bool:
    """True if the load of a run prescribes a scalar, so that it has no error."""
    load = case_of(ds).get("load")
    if not load:
        return False
    name = name.removesuffix("_per_length")
    if name in ("force", "approach") and has_mixed_control(ds):
        return False
    if name in ("force", "approach"):
        return prescribes_approach(ds) == (name == "approach")
    if name.startswith("eccentricity_"):
        is_tilted = load.get(name.replace("eccentricity", "tilt")) is not None
        return not prescribes_approach(ds) and not is_tilted
    return name.startswith("tilt_") and load.get(name) is not None
