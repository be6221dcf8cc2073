"""Steady motion of coupled bodies at several creepages, each of which has a pressure of its own."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import xarray as xr

from viscontact.simulation.steady_motion.preparation import SteadySetup
from viscontact.simulation.steady_motion.record import steady_attributes


def at_each_creepage(setup: SteadySetup) -> Iterator[SteadySetup]:
    """The same run, on the same grids, at one creepage after the other."""
    problem = setup.problem
    for creepage in problem.motion.creepages:
        motion = replace(problem.motion, creepages=(creepage,))
        own = replace(setup.solver, problem=replace(problem, motion=motion))
        yield replace(setup, solver=own)


def over_creepages(setup: SteadySetup, parts: Sequence[xr.Dataset]) -> xr.Dataset:
    """One result of those at each creepage: all that is over speed is over the creepage, too."""
    found = xr.concat(
        [part.map(_at_its_creepage, keep_attrs=True, at=part["creepage"]) for part in parts],
        "creepage",
        combine_attrs="override",
    )
    texts = [line for part in parts for line in part.attrs["warnings"].splitlines()]
    return found.assign_attrs(
        parts[0].attrs,
        case=steady_attributes(setup, setup.grid)["case"],
        wall_time=sum(part.attrs["wall_time"] for part in parts),
        warnings="\n".join(dict.fromkeys(texts)),
    )


def _at_its_creepage(variable: xr.DataArray, at: xr.DataArray) -> xr.DataArray:
    """A variable over speed and the creepage, in this order."""
    over, *others = (dim for dim in variable.dims if dim != "creepage")
    several = variable if "creepage" in variable.dims else variable.expand_dims(creepage=at)
    return several.transpose(over, "creepage", *others)
