"""Runs of a profile design: largest pressures along a roller, and certified peak pressures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field, fields
from functools import partial
from hashlib import sha256
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.indenters.profile import Profile
from viscontact.runs.single import simulate
from viscontact.studies.design.profiles.loaded_roller import LoadedRoller
from viscontact.studies.design.sharp_ends import reaches_sharp_end
from viscontact.studies.evaluation import Evaluation, SimulatedRun
from viscontact.studies.journal import Entry
from viscontact.studies.scalars import At, Value, magnitude

#: Coarse cells from the middle of the roller to its end, and beyond it.
CELLS, BEYOND = 50, 4
#: Finer cells on the smallest half width of the contact: over this length pressure changes at the
#: ends of a roller. Most of them for one coarse cell.
ON_HALF_WIDTH, MOST_FINER = 5, 6
#: Cells across the smallest contact, and the most cells across the grid.
ACROSS, MOST_ACROSS = 11, 101
#: Cells of the certified runs for one of the search, along and across.
CERTIFIED = 2
#: Width of the grid over that of the largest contact.
WIDTH = 1.6
#: Part of the half length next to an end that is to carry no pressure: it has no limit at the end.
MARGIN = 1 / CELLS
#: Tolerance of the solver in the search.
TOLERANCE = 1e-5


@dataclass(frozen=True, eq=False)
class RowPressures:
    """Largest pressures on the rows of cells across a roller, at all instants [Pa]."""

    values: Floats  # rows that may carry pressure
    forbidden: Floats  # rows at the ends; where the gap is open, minus its size as a pressure


@dataclass
class ProfileRuns:
    """Runs of the profiles that are tried, in all scenarios."""

    scenarios: Sequence[LoadedRoller]
    at: At
    evaluation: Evaluation
    grid: Grid | None = None
    amplitude: float = 1.0  # drop that counts as much as the peak pressure, where a gap is open [m]
    materials: Mapping[str, Any] = field(default_factory=dict)  # in place of those of the case

    def pressures(self, profiles: Sequence[Sequence[Profile]]) -> list[RowPressures | None]:
        """Pressures under groups of profiles, None where a run fails; BudgetSpentError."""
        runs = [self._search_run(each) for group in profiles for each in group]
        found = iter(self.evaluation.outcomes([run for each in runs for run in each]))
        return [
            _join([next(found) for _ in range(len(group) * len(self.scenarios))])
            for group in profiles
        ]

    def _search_run(self, profile: Profile) -> list[SimulatedRun]:
        common = {"grid": self.grid, "tolerance": TOLERANCE, "errors": False, **self.materials}
        cells = f"{self.grid!r} {'elastic' if self.materials else ''}"
        return [
            SimulatedRun(
                f"rows {number} {_profile_key(profile)} {cells}",
                partial(
                    simulate,
                    **{**each.arguments(profile), **common, "fields": self._instants(each)},
                ),
                partial(
                    row_peaks,
                    each.end,
                    self.amplitude,
                    margin=0.0 if each.may_touch_ends else MARGIN,
                ),
            )
            for number, each in enumerate(self.scenarios)
        ]

    def widths(self, profile: Profile | None = None) -> tuple[float, float]:
        """Smallest and largest width of the loaded contact [m]; ValueError if a run fails."""
        cells = {} if self.grid is None else {"grid": self.grid}
        common = {**cells, "fields": "none", "errors": False}
        runs = [
            SimulatedRun(
                f"widths {number} {_profile_key(profile)} {self.grid!r}",
                partial(simulate, **{**each.arguments(profile), **common}),
                least_and_largest_width,
            )
            for number, each in enumerate(self.scenarios)
        ]
        found = self.evaluation.outcomes(runs, is_limited=False)
        for each in found:
            if each.failure:
                raise ValueError(each.failure)
        least, largest = ([each.values[name] for each in found] for name in ("least", "largest"))
        return min(least), max(largest)

    def certified(
        self, profiles: Sequence[Profile | None]
    ) -> list[tuple[list[Value], tuple[str, ...]]]:
        """Peak pressures with errors in all scenarios, on fine cells, and warnings."""
        assert self.grid is not None
        cells = fine_grid(self.grid)
        runs = []
        for profile in profiles:
            for number, each in enumerate(self.scenarios):
                recipe = each.certifying(profile, cells) | {"fields": "none"}
                key = f"peak {number} {_profile_key(profile)} {cells!r}"
                numbers = partial(certified_peak, recipe["indenter"], self.at)
                runs.append(SimulatedRun(key, partial(simulate, **recipe), numbers))
        found = iter(self.evaluation.outcomes(runs, is_limited=False))
        return [_values([next(found) for _ in self.scenarios]) for _ in profiles]

    def _instants(self, scenario: LoadedRoller) -> str | list[float]:
        if self.at == "worst":
            return "all"
        return [float(scenario.case.instants[-1] if self.at == "end" else self.at)]


def row_peaks(
    end: float, amplitude: float, found: xr.Dataset, *, margin: float = MARGIN
) -> dict[str, Any]:
    """Largest pressures on rows inside, and at the ends less open gaps [Pa], of a roller.

    `margin` is the part of its half length at the ends.
    """
    x, last = np.abs(found["x"].values), (1 - margin) * end
    rows, gaps = found["pressure"].values.max(axis=2), found["gap"].values.min(axis=2)
    inside, at_end = x < last, (x > last) & (x < end)
    forbidden = (rows - rows.max() / amplitude * gaps)[:, at_end]
    values = {"rows": rows[:, inside], "forbidden": forbidden}
    return {name: each.ravel().tolist() for name, each in values.items()}


def least_and_largest_width(found: xr.Dataset) -> dict[str, Any]:
    """Least and largest width of the loaded contact [m]."""
    loaded = found["force"].values > 0.5 * found["force"].values.max()
    widths = found["contact_width"].values[loaded]
    return {"least": float(widths.min()), "largest": float(widths.max())}


def certified_peak(indenter: Indenter, at: At, found: xr.Dataset) -> dict[str, Any]:
    """Peak pressure and its error [Pa]."""
    value = magnitude(found, "peak_pressure", at)
    is_sharp = reaches_sharp_end(indenter, found)
    return {"value": value.value, "error": float(np.inf if is_sharp else value.error)}


def _profile_key(profile: Profile | None) -> str:
    """Text that is the same for equal profiles."""
    if profile is None:
        return "case"
    values = (getattr(profile, each.name) for each in fields(profile))  # type: ignore[arg-type]
    texts = (
        sha256(each.tobytes()).hexdigest() if isinstance(each, np.ndarray) else repr(each)
        for each in values
    )
    return f"{type(profile).__name__}({', '.join(texts)})"


def search_grids(end: float, widths: tuple[float, float]) -> tuple[Grid, ...]:
    """Grids of the search, the coarse one first, for a half length and widths of contacts [m]."""
    # Their cells end where the roller does, and where the part without pressure begins.
    small, large = widths
    count = int(np.clip(np.ceil(ACROSS * WIDTH * large / small), 35, MOST_ACROSS))
    across = count + 1 - count % 2  # a cell on the axis
    along = 2 * (CELLS + BEYOND)
    size = (along * end / CELLS, WIDTH * large)
    finer = int(np.clip(np.ceil(2 * ON_HALF_WIDTH * end / (small * CELLS)), 1, MOST_FINER))
    return tuple(Grid((each * along, across), size) for each in sorted({1, finer}))


def fine_grid(grid: Grid) -> Grid:
    """Grid of the certified runs, for the last one of the search."""
    along, across = grid.shape
    return Grid((CERTIFIED * along, CERTIFIED * across + 1), grid.size)


def _values(found: Sequence[Entry]) -> tuple[list[Value], tuple[str, ...]]:
    none: dict[str, Any] = {"value": np.nan, "error": np.nan}
    values = [Value(**{**none, **each.values}) for each in found]
    lines = [line for each in found for line in each.warnings.splitlines()]
    failures = [each.failure for each in found if each.failure]
    return values, tuple(dict.fromkeys([*failures, *lines]))


def _join(outcomes: Sequence[Entry]) -> RowPressures | None:
    if any(each.failure for each in outcomes):
        return None
    rows, forbidden = (
        np.concatenate([np.array(each.values[name]) for each in outcomes])
        for name in ("rows", "forbidden")
    )
    return RowPressures(rows, forbidden)
