"""Runs of a profile design: largest pressures along a roller, and certified peak pressures."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Literal

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.checks.half_space_theory import AT_THE_END
from viscontact.errors import AccuracyWarning, ConvergenceError, DomainError
from viscontact.grid import Grid
from viscontact.indenters.profile import Profile
from viscontact.runs.single import simulate
from viscontact.studies.design.evaluation import ends_sharply
from viscontact.studies.design.goals import Value, magnitude
from viscontact.studies.design.profiles.journal import Journal
from viscontact.studies.design.profiles.loaded_roller import LoadedRoller
from viscontact.studies.design.profiles.minimax import CallsSpentError

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
class SearchRuns:
    """Runs of the profiles that are tried, in all scenarios; `journal` has earlier ones."""

    scenarios: Sequence[LoadedRoller]
    at: Literal["worst", "end"] | float
    journal: Journal
    executor: Executor | None
    progress: Callable[[int, int], None]
    budget: int  # most runs
    runs: int = 0
    grid: Grid | None = None
    amplitude: float = 1.0  # drop that counts as much as the peak pressure, where a gap is open [m]
    materials: Mapping[str, Any] = field(default_factory=dict)  # in place of those of the case

    def pressures(self, profiles: Sequence[Sequence[Profile]]) -> list[RowPressures | None]:
        """Pressures under groups of profiles, all of a group together; None where a run fails."""
        flat = [profile for group in profiles for profile in group]
        found = iter(self._rows(flat))
        return [_joined([next(found) for _ in range(len(group))]) for group in profiles]

    def _rows(self, profiles: Sequence[Profile]) -> Iterator[RowPressures | None]:
        recipes = [
            {
                **each.arguments(profile),
                **self.materials,
                **{"grid": self.grid, "fields": self._instants(each), "tolerance": TOLERANCE},
                "errors": False,
            }
            for profile in profiles
            for each in self.scenarios
        ]
        if self.runs + len(recipes) > self.budget:
            raise CallsSpentError
        calls = [
            partial(_row_peaks, each, self.scenarios[0].end, self.amplitude) for each in recipes
        ]
        found = iter(self._results(calls))
        for _ in profiles:
            rows = [next(found) for _ in self.scenarios]
            yield None if None in rows else _joined([RowPressures(*map(np.array, r)) for r in rows])

    def widths(self, profile: Profile) -> tuple[float, float]:
        """Smallest and largest width of the loaded contact [m]; ValueError if a run fails."""
        return self._extents([each.arguments(profile) for each in self.scenarios])

    def own_widths(self) -> tuple[float, float]:
        """Smallest and largest width of the contact of the case [m]."""
        return self._extents([each.arguments() for each in self.scenarios])

    def _extents(self, given: Sequence[Mapping[str, Any]]) -> tuple[float, float]:
        grid = {} if self.grid is None else {"grid": self.grid}
        calls = [
            partial(_widths, {**each, **grid, "fields": "none", "errors": False}) for each in given
        ]
        found = self._results(calls)
        for each in found:
            if isinstance(each, str):
                raise ValueError(each)
        return min(low for low, _ in found), max(high for _, high in found)

    def certified(
        self, profiles: Sequence[Profile | None]
    ) -> list[tuple[list[Value], tuple[str, ...]]]:
        """Peak pressures with errors in all scenarios, on fine cells, and warnings."""
        assert self.grid is not None
        recipes = [
            each.certifying(profile, fine_grid(self.grid))
            for profile in profiles
            for each in self.scenarios
        ]
        found = iter(self._results([partial(_peak, each, self.at) for each in recipes]))
        return [_values([next(found) for _ in self.scenarios]) for _ in profiles]

    def _instants(self, scenario: LoadedRoller) -> str | list[float]:
        if self.at == "worst":
            return "all"
        return [float(scenario.case.instants[-1] if self.at == "end" else self.at)]

    def _results(self, calls: Sequence[Callable[[], Any]]) -> list[Any]:
        """Results of some runs, in their order; those of the journal are not computed."""
        found = []
        for _ in calls:
            recorded = self.journal.recorded()
            if recorded is None:
                break
            found.append(recorded)
            self._count()
        left = calls[len(found) :]
        made = map(_call, left) if self.executor is None else self.executor.map(_call, left)
        for each in made:
            self.journal.keep(each)
            found.append(each)
            self._count()
        return [None if each == _FAILED else each for each in found]

    def _count(self) -> None:
        self.runs += 1
        self.progress(self.runs, self.budget)


def search_grids(end: float, widths: tuple[float, float]) -> tuple[Grid, ...]:
    """Grids of the search, the coarse one first, for a half length and widths of contacts [m].

    Their cells end where the roller does, and where the part without pressure begins.

    >>> [grid.shape for grid in search_grids(10e-3, (0.5e-3, 1e-3))]
    [(108, 37), (432, 37)]
    """
    small, large = widths
    count = int(np.clip(np.ceil(ACROSS * WIDTH * large / small), 35, MOST_ACROSS))
    across = count + 1 - count % 2  # a cell on the axis
    along = 2 * (CELLS + BEYOND)
    size = (along * end / CELLS, WIDTH * large)
    finer = int(np.clip(np.ceil(2 * ON_HALF_WIDTH * end / (small * CELLS)), 1, MOST_FINER))
    return tuple(Grid((each * along, across), size) for each in sorted({1, finer}))


def fine_grid(grid: Grid) -> Grid:
    """Grid of the certified runs, for the last one of the search.

    >>> fine_grid(Grid((108, 37), (1.0, 1.0))).shape
    (216, 75)
    """
    along, across = grid.shape
    return Grid((CERTIFIED * along, CERTIFIED * across + 1), grid.size)


#: Entry of a failed run in the journal, where null stands for no entry.
_FAILED = "failed"


def _call(call: Callable[[], Any]) -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AccuracyWarning)
        return call()


def _row_peaks(recipe: Mapping[str, Any], end: float, amplitude: float) -> Any:
    """Largest pressures on rows inside, and at the ends less those of open gaps [Pa], as lists."""
    try:
        found = simulate(**recipe)
    except (ValueError, ConvergenceError, DomainError):
        return _FAILED
    grid = recipe["grid"]
    x, margin = np.abs(grid.x), (1 - MARGIN) * end
    rows, gaps = found["pressure"].values.max(axis=2), found["gap"].values.min(axis=2)
    inside, at_end = x < margin, (x > margin) & (x < end)
    forbidden = (rows - rows.max() / amplitude * gaps)[:, at_end]
    return rows[:, inside].ravel().tolist(), forbidden.ravel().tolist()


def _widths(recipe: Mapping[str, Any]) -> Any:
    try:
        found = simulate(**recipe)
    except (ValueError, ConvergenceError, DomainError) as error:
        return str(error).splitlines()[0]
    loaded = found["force"].values > 0.5 * found["force"].values.max()
    widths = found["contact_width"].values[loaded]
    return float(widths.min()), float(widths.max())


def _peak(recipe: Mapping[str, Any], at: Any) -> Any:
    """Peak pressure, its error, and the warnings; a reason if the run fails."""
    try:
        found = simulate(**{**recipe, "fields": "none"})
    except (ValueError, ConvergenceError, DomainError) as error:
        return {"failure": str(error).splitlines()[0]}
    value = magnitude(found, "peak_pressure", at, largest=True)
    warned = str(found.attrs.get("warnings", ""))
    is_sharp = AT_THE_END in warned and ends_sharply(recipe["indenter"])
    bar = np.inf if is_sharp else value.error
    # JSON of Python has NaN and Infinity, which it also reads.
    return {"value": value.value, "error": float(bar), "warnings": warned}


def _values(found: Sequence[Mapping[str, Any]]) -> tuple[list[Value], tuple[str, ...]]:
    values = [Value(each.get("value", np.nan), each.get("error", np.nan)) for each in found]
    lines = [line for each in found for line in each.get("warnings", "").splitlines()]
    failures = [each["failure"] for each in found if "failure" in each]
    return values, tuple(dict.fromkeys([*failures, *lines]))


def _joined(rows: Sequence[RowPressures | None]) -> RowPressures | None:
    known = [each for each in rows if each is not None]
    if len(known) < len(rows):
        return None
    return RowPressures(
        np.concatenate([each.values for each in known]),
        np.concatenate([each.forbidden for each in known]),
    )
