"""Choice of a figure by its name, with its instants or speeds, on the command line and the page."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from functools import cached_property

import numpy as np
import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.figures import FigureEntry, entry_of
from viscontact.results.run_axis import SPEED, TIME, RunAxis, run_axis
from viscontact.units.parsing import parse_quantity

#: Digits of instants and speeds in messages, and part of the last one that is rounding: 0.1 min may
#: differ from 6 s in the last digit.
_DIGITS, _SLACK = 6, 1e-9
#: Letters of an unknown name that are repeated.
_MOST = 40


class UnknownFigureError(ValueError):
    """No figure has this name."""


@dataclass(frozen=True)
class FigureChoice:
    """Wanted figure and its instants or speeds, as texts with units."""

    name: str
    times: tuple[str, ...] = ()
    speeds: tuple[str, ...] = ()
    prefix: str = ""  # before names of arguments in messages: "--" on the command line

    @property
    def axis(self) -> RunAxis:
        """Quantity of the places."""
        return SPEED if self.speeds else TIME

    @cached_property
    def places(self) -> list[float] | None:
        """The instants [s] or speeds [m/s]; None for the default of the figure."""
        if self.times and self.speeds:
            raise ValueError(
                f"{self._argument(TIME)} and {self._argument(SPEED)}: a run is over one of them; "
                "leave out the other"
            )
        try:
            texts = self.speeds or self.times
            return [parse_quantity(text, self.axis.name) for text in texts] or None
        except ValueError as error:
            raise ValueError(f"{self._argument(self.axis)}: {error}") from error

    def entry_in(self, names: Iterable[str]) -> FigureEntry:
        """Entry of the figure, which must be one of these."""
        known = list(names)
        if self.name not in known:
            near = difflib.get_close_matches(self.name, known, n=1)
            hint = f"; did you mean {near[0]}?" if near else "."
            raise UnknownFigureError(
                f"no figure is called {self.name[:_MOST]!r}{hint} There are {', '.join(known)}"
            )
        return entry_of(self.name)

    def keywords(self, entry: FigureEntry) -> dict[str, list[float] | None]:
        """Keywords of the drawing function for the instants or speeds."""
        taken = [name for name in ("times", "speeds") if name in entry.takes]
        if self.places is not None and not taken:
            self.refuse(self.axis.name)
        return dict.fromkeys(taken, self.places)

    def refuse(self, argument: str) -> None:
        """Raise ValueError for an argument that the figure does not take."""
        raise ValueError(f"{self.prefix}{argument}: does not apply to the figure {self.name}")

    def require_within(self, run: xr.Dataset, name: str = "") -> None:
        """Raise ValueError if a place lies outside a run; `name` is that of the run."""
        if self.places is None or entry_of(self.name).any_time:
            return
        axis, the_run = run_axis(run), f"the run {name}".rstrip()
        if self.axis is not axis:
            raise ValueError(
                f"{self._argument(self.axis)}: {the_run} is over {axis.name}; give "
                f"{self._argument(axis)} in its place"
            )
        start, end = float(axis.values(run).min()), float(axis.values(run).max())
        for place in self.places:
            if not start - _SLACK * end <= place <= end + _SLACK * end:
                ends = f"{axis.quantity(start, _DIGITS)} to {axis.quantity(end, _DIGITS)}"
                raise ValueError(
                    f"{self._argument(axis)}: {axis.quantity(place, _DIGITS)} lies outside "
                    f"{the_run}, which goes from {ends}"
                )

    def drawn_instead(self, run: xr.Dataset) -> str:
        """Message about stored fields drawn in place of wanted ones; empty without any."""
        if self.places is None or not entry_of(self.name).at_instants or "pressure" not in run:
            return ""
        stored, axis = run[run["pressure"].dims[0]].values, self.axis
        nearest = {each: float(stored[np.abs(stored - each).argmin()]) for each in self.places}
        return "; ".join(
            f"{axis.quantity(each)} is not stored; drew {axis.quantity(drawn)}"
            for each, drawn in nearest.items()
            if not np.isclose(each, drawn, rtol=_SLACK, atol=0.0)
        )

    def _argument(self, axis: RunAxis) -> str:
        return f"{self.prefix}{axis.name}"


def require_one_axis(runs: Mapping[str, xr.Dataset]) -> None:
    """Raise ValueError for runs over time beside runs over speed."""
    over_speed = [label for label, run in runs.items() if not run_axis(run).is_history]
    if 0 < len(over_speed) < len(runs):
        raise ValueError(
            "runs over time and runs over speed cannot be compared; over speed: "
            f"{', '.join(over_speed)}"
        )
