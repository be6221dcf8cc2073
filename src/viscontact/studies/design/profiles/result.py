"""Result of a profile design: the free profile and the named ones under the same loads."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters.profile import Profile
from viscontact.case import Case
from viscontact.results.formatting import format_with_error
from viscontact.runs.single import simulate
from viscontact.studies.design.profiles.loaded_roller import LoadedRoller, case_with_table
from viscontact.studies.design.year_of_creep import creeps_on, year_of_creep
from viscontact.units.display import StudyResult

#: Profiles of the table beside the named ones.
CASE, FREE, ELASTIC = "case", "free", "free, without creep"


@dataclass(frozen=True, eq=False)
class ProfileDesign(StudyResult):
    """Free profile of a roller, and named profiles under the same loads.

    Attributes
    ----------
    x : ndarray
        Positions along the roller from end to end, from its middle [m].
    drop : ndarray
        Drop of the free profile there [m].
    table : xarray.Dataset
        Along ``profile`` ("case", "cylindrical", "crowned", "lundberg", "johns-gohar", "free", and
        "free, without creep"): ``drop`` over (profile, x) [m], NaN where it has no limit;
        ``peak_pressure`` in the worst scenario [Pa] and ``peak_pressure_of_scenarios`` over
        (profile, scenario), on the cells of the case, with their errors (infinite where the
        pressure has no limit); ``parameter`` of the named ones. With a production tolerance,
        ``peak_pressure_of_deviations`` of the free profile over ``deviation``.
    notes : tuple of str
        Notes on the profile.
    runs : int
        Number of runs.
    """

    table: xr.Dataset
    notes: tuple[str, ...]
    runs: int
    case: Path
    settings: Mapping[str, str]
    scenarios: tuple[LoadedRoller, ...]
    profiles: Mapping[str, Profile | None]  # by their name in the table; None for the case's own

    @property
    def x(self) -> Floats:
        """Positions along the roller [m]."""
        return np.asarray(self.table["x"].values)

    @property
    def drop(self) -> Floats:
        """Drop of the free profile [m]."""
        return np.asarray(self.table["drop"].sel(profile=FREE).values)

    @property
    def peak_pressure(self) -> float:
        """Peak pressure under the free profile in the worst scenario [Pa]."""
        return float(self.table["peak_pressure"].sel(profile=FREE))

    @property
    def radius(self) -> float:
        """Radius of the roller [m]."""
        return self.scenarios[0].roller.radius

    @property
    def best_named(self) -> str:
        """Named profile with the least peak pressure that has a limit."""
        names = [n for n in self.profiles if n not in (CASE, FREE, ELASTIC)]
        one = self.table.sel(profile=names)
        limited = np.where(
            np.isposinf(one["peak_pressure_error"]), np.inf, one["peak_pressure"].fillna(np.inf)
        )
        return names[int(np.argmin(limited))]

    def best_case(self, table: Path) -> Case:
        """Case with the free profile as a table, which is an existing file."""
        end = self.scenarios[0].end
        return case_with_table(self.case, self.settings, end, str(table.resolve()))

    def _page(self) -> tuple[Any, ...]:
        title = f"Free profile of {self.case.stem}"
        years = self.over_a_year()
        words = {"title": title, "headline": str(self), "years": years}
        return "profile", self.table, self.before_and_after(), words

    def before_and_after(self) -> dict[str, xr.Dataset]:
        """Results of the best named profile and of the free one, in the scenario that decides.

        Fields are kept at the first and at the last instant.
        """
        roller = self._deciding()
        instants = roller.case.instants
        fields = sorted({float(instants[0]), float(instants[-1])})
        found, options = {}, {"fields": fields}
        for name in (self.best_named, FREE):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", AccuracyWarning)  # they are among the notes
                found[name] = simulate(**(roller.arguments(self.profiles[name]) | options))
        return found

    def over_a_year(self) -> dict[str, xr.Dataset | str]:
        """Results of the same profiles up to a year, as `DesignResult.over_a_year`."""
        roller = self._deciding()
        if not creeps_on(roller.case):
            return {}
        return {
            name: year_of_creep(roller.case, roller.arguments(self.profiles[name]))
            for name in (self.best_named, FREE)
        }

    def _deciding(self) -> LoadedRoller:
        """Roller under the load of the scenario that decides."""
        worst = self.table["peak_pressure_of_scenarios"].sel(profile=FREE).values
        return self.scenarios[int(np.argmax(worst))]

    def __str__(self) -> str:
        best = self.best_named
        return (
            f"least peak_pressure: {self.formatted(FREE)} with the free profile, "
            f"{self.formatted(best)} with the best named one, {best}"
        )

    def formatted(self, profile: str) -> str:
        """Peak pressure of a profile with its error."""
        row = self.table.sel(profile=profile)
        return format_with_error(
            float(row["peak_pressure"]), float(row["peak_pressure_error"]), "Pa"
        )
