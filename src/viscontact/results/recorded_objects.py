"""Parts of the case that a result keeps, rebuilt as objects."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from viscontact.bodies.loads import TemperatureHistory
from viscontact.bodies.loads.clock import TIME, Clock
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.layers import Layered, at_temperature
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.halfspace.ended_response import EndedResponse
from viscontact.mechanics.problem.surface import clock_of, ended_response
from viscontact.results.descriptions import rebuild
from viscontact.results.recorded_case import case_of

if TYPE_CHECKING:
    import xarray as xr

    from viscontact.results.stored_result import Result


def recorded_temperature(results: Result) -> TemperatureHistory | None:
    """Temperature that the case of a result gives; None where laws are used as they are."""
    described = case_of(results).get("temperature")
    found = None if described is None else rebuild(described)
    assert found is None or isinstance(found, TemperatureHistory)
    return found


def recorded_clock(results: xr.Dataset, part: str, figure: str) -> Clock:
    """Clock of the creep of a body of a result, "material" or "indenter_material"."""
    temperature = recorded_temperature(results)
    varies = temperature is not None and not temperature.is_constant
    body = recorded_object(results, part, figure)
    return TIME if body is None else clock_of(body, temperature if varies else None)


def recorded_object(results: Result, part: str, figure: str) -> Any:
    """Rebuild a part of the recorded case, such as "indenter"; None where the case has none.

    Bodies at a constant temperature have the laws of the run, and no ends: see `has_ends`.
    """
    # A large part is recorded by its fingerprint only.
    if "case" not in results.attrs:
        raise ValueError(
            f"{figure}: needs to know the {part} of the case, but the result has no attribute "
            "'case'; give a result as simulate or open_results returned it"
        )
    described = case_of(results).get(part)
    try:
        found = None if described is None else rebuild(described)
    except ValueError as error:
        raise ValueError(f"{figure}: cannot rebuild the {part}: {error}") from error
    if isinstance(found, Body):
        found = found.material
    if not isinstance(found, Material | Layered):
        return found
    temperature = recorded_temperature(results)
    constant = temperature is not None and temperature.is_constant
    return at_temperature(found, temperature.range[0]) if temperature and constant else found


def recorded_end_response(results: Result, part: str, figure: str) -> EndedResponse | None:
    """Response of a body of a result that ends along x; None of one without ends."""
    described = case_of(results).get(part) or {}
    if described.get("type") != "Body":
        return None
    body = rebuild(described)
    assert isinstance(body, Body)
    return ended_response(body, recorded_object(results, part, figure))
