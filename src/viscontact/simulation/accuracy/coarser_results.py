"""Results of coarser runs: scalars, and what the pressures show of ends, points and spots."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import field, replace

import numpy as np

from viscontact.backend.arrays import Bools, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.mechanics.state import ContactState, EventKind
from viscontact.results.variables import scalars_with_error
from viscontact.simulation.checks.mesh import cells_across_spots
from viscontact.simulation.checks.singularities import (
    MIN_ANGLE,
    apex_exponent,
    bend_at,
    cells_at_end,
    sharpest_angle,
    strain_of,
)
from viscontact.simulation.transient.setup import RunSetup

#: Growth of the largest pressure since the last search for a sharp point there that calls for
#: another [-].
PEAK_GROWTH = 1.1

#: Scalars over the instants of a run by name, including ``time``.
History = Mapping[str, Floats]


@dataclass(frozen=True, eq=False)
class CoarserResult:
    """Result of a coarser run."""

    spacing: float  # cell size, in cells of the original run
    divides_steps: bool  # divides steps that the coarsest run takes as the original run does
    scalars: History
    end_pressures: Floats  # over the instants, see `singularities.EndCells` [Pa]
    at_end: Bools  # instants at which the contact reaches the end of the body
    #: Growth of the largest pressure with the logarithm of the cells that the body's bend there can
    #: cause, over the mean pressure [-].
    bend_growth: Floats
    #: The same by the bend within the cells next to the peak.
    near_bend_growth: Floats
    spots: Floats  # mean width of the contact spots, in cells of the original run
    peak_drops: Floats  # relative drop of pressure from the largest one to the cells next to it
    #: Exponents of the gap around the largest pressure, see `apex_exponent` [-].
    apex_exponents: Floats
    rises_to_ends: Bools  # pressure rises to both ends along x, y; shape (instants, 2)
    is_sharp: bool  # the largest pressure lies on a point or a ridge of the body
    #: Ends of the segments of a load program, NaN where they ended in another way than those of the
    #: run; none of other loads [s].
    segment_ends: Floats = field(default_factory=lambda: np.zeros(0))
    #: Largest pull [N] and its time [s] of the bodies that it pulls off each other, and its bend.
    pull_off: tuple[float, float] = (math.nan, math.nan)
    pull_bend: float = math.nan  # see `ContactEvent` [N/s²]
    #: Kinds and times [s] of its jumps into contact and losses of it.
    contact_events: tuple[tuple[EventKind, float], ...] = ()

    def times_of(self, kind: EventKind) -> list[float]:
        """Times of its jumps into contact, or of its losses of it [s]."""
        return [time for each, time in self.contact_events if each == kind]

    def at(self, instants: Floats, *, segment_ends: Floats) -> CoarserResult:
        """The result at instants of the original run, without those that are NaN [s]."""
        known = ~np.isnan(instants)
        scalars = {name: values[known] for name, values in self.scalars.items()}
        return replace(
            self,
            scalars=scalars | {"time": instants[known]},
            end_pressures=self.end_pressures[known],
            at_end=self.at_end[known],
            bend_growth=self.bend_growth[known],
            near_bend_growth=self.near_bend_growth[known],
            spots=self.spots[known],
            peak_drops=self.peak_drops[known],
            apex_exponents=self.apex_exponents[known],
            rises_to_ends=self.rises_to_ends[known],
            segment_ends=segment_ends,
        )


class ObservedStates:
    """States of a coarser run, one after the other, without their fields."""

    def __init__(self, run: RunSetup, spacing: float) -> None:
        """Begin with none; `spacing` is the cell size in cells of the original run."""
        self._run, self._spacing = run, spacing
        self._end_cells = cells_at_end(run.open_gap)
        self._states: list[ContactState] = []
        self._pull_off, self._pull_bend = (math.nan, math.nan), math.nan
        self._contact_events: list[tuple[EventKind, float]] = []
        self._ends: list[tuple[float, float]] = []
        self._at_end: list[bool] = []
        self._bends: list[tuple[float, float]] = []
        self._spots: list[float] = []
        self._drops: list[float] = []
        self._exponents: list[float] = []
        self._rises: list[tuple[bool, bool]] = []
        self._peak, self._is_sharp = 0.0, False
        # The largest pressure stays in a few cells: exponents, bends and angles of the body there.
        self._exponents_at: dict[tuple[int, int], float] = {}
        self._bends_at: dict[tuple[int, int], tuple[float, float]] = {}
        self._angles_at: dict[tuple[float, float], float] = {}

    def add(self, state: ContactState) -> None:
        """Add the next state."""
        run, pressure = self._run, state.pressure
        self._states.append(state.without_fields())
        for event in state.events:
            self._contact_events.append((event.kind, event.time))
            if event.kind == "pull_off" and not event.pull <= self._pull_off[0]:
                self._pull_off = event.pull, event.pull_time
                self._pull_bend = event.pull_bend
        self._ends.append(self._end_cells.pressures(pressure))
        self._at_end.append(bool(state.in_contact[self._end_cells.beside].any()))
        self._examine_body(state)
        self._spots.append(cells_across_spots(state.in_contact, periodic=run.grid.periodic))
        self._drops.append(_drop_beside_peak(pressure))
        self._rises.append((_rises_to_ends(pressure), _rises_to_ends(pressure.T)))
        if state.peak_pressure > PEAK_GROWTH * self._peak:
            self._peak = state.peak_pressure
            self._is_sharp = self._is_sharp or self._peaks_at_point(state)

    def result(self, *, divides_steps: bool) -> CoarserResult:
        """Result of the run after its last state."""
        bends = np.array(self._bends, dtype=float).reshape(-1, 2)
        return CoarserResult(
            self._spacing,
            divides_steps,
            history_of(self._states),
            np.array(self._ends, dtype=float).reshape(-1, 2),
            np.array(self._at_end, dtype=bool),
            bends[:, 0],
            bends[:, 1],
            self._spacing * np.array(self._spots, dtype=float),
            np.array(self._drops, dtype=float),
            np.array(self._exponents, dtype=float),
            np.array(self._rises, dtype=bool).reshape(-1, 2),
            self._is_sharp,
            pull_off=self._pull_off,
            pull_bend=self._pull_bend,
            contact_events=tuple(self._contact_events),
        )

    def _examine_body(self, state: ContactState) -> None:
        """Growth of the largest pressure that the body's bend there can cause, and its exponent."""
        run = self._run
        i, j = np.unravel_index(int(state.pressure.argmax()), state.pressure.shape)
        cell = int(i), int(j)
        if cell not in self._bends_at:
            around, near = (bend_at(run.open_gap, run.grid, cell, reach) for reach in (2, 1))
            self._bends_at[cell] = around, near
            self._exponents_at[cell] = apex_exponent(run.open_gap, run.grid, cell)
        strain = 2 * np.pi * float(run.problem.compliance(state.time)) * state.mean_pressure
        around, near = self._bends_at[cell]
        self._bends.append((around / strain, near / strain) if strain > 0 else (0.0, 0.0))
        self._exponents.append(self._exponents_at[cell])

    def _peaks_at_point(self, state: ContactState) -> bool:
        """Test whether the largest pressure lies at a point that is sharp on the original cells."""
        run = self._run
        place = run.grid.largest_at(state.pressure)
        dx, dy = run.grid.cell_size
        if place not in self._angles_at:
            cell = (dx / self._spacing, dy / self._spacing)
            reach = (1.5 * dx, 1.5 * dy)
            self._angles_at[place] = sharpest_angle(run.problem.indenter, place, reach, cell)
        strain = strain_of(state.peak_pressure, float(run.problem.compliance(state.time)))
        return self._angles_at[place] > MIN_ANGLE * strain


def history_of(states: Sequence[ContactState]) -> History:
    """Scalars of states that are used to estimate their errors, over their instants."""
    scalars = scalars_with_error(states[0].parts if states else ())
    names = ["time", *scalars, "cells_across", "time_error"]
    if states and states[0].thickening is not None:
        names.append("thickening")
    return {name: np.array([getattr(state, name) for state in states], float) for name in names}


def indentation(history: History) -> Floats:
    """Approach of the surfaces with the growth of layers that expand, as deep as they press [m]."""
    return np.asarray(history["approach"] + history.get("thickening", 0.0))


def with_contact(history: History) -> Bools:
    """Instants at which the bodies are in contact."""
    return np.asarray(history["contact_area"] > 0)


def _drop_beside_peak(pressure: Floats) -> float:
    """Largest relative drop from the largest pressure to the neighbouring cells in contact."""
    i, j = np.unravel_index(int(pressure.argmax()), pressure.shape)
    around = pressure[max(i - 1, 0) : i + 2, max(j - 1, 0) : j + 2]
    peak = float(pressure[i, j])
    return float(1 - around.min(where=around > 0, initial=peak) / peak) if peak > 0 else 0.0


def _rises_to_ends(pressure: Floats) -> bool:
    """Test whether the largest pressures across the first axis rise to both ends of the contact."""
    lines = pressure.max(axis=1)
    pressed = lines[lines > 0]
    return len(pressed) > 1 and bool(pressed[0] >= pressed[1] and pressed[-1] >= pressed[-2])
