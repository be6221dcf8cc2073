"""Analysis of a contact problem, over time or over speed."""

from __future__ import annotations

import json
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Protocol, Self, TypeVar

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.grid import Grid
from viscontact.mechanics.problem.kept_fields import KeptFields
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.state import LEAKAGE, ContactState, Outcome
from viscontact.mechanics.time_integration.restart_data import RestartData
from viscontact.results import leakage
from viscontact.results.descriptions import describe
from viscontact.results.run_axis import RunAxis

if TYPE_CHECKING:
    from viscontact.results.leakage.of_state import CaseLeakage
    from viscontact.runs.forecast import Forecast
    from viscontact.simulation.accuracy.coarser_results import History
    from viscontact.simulation.accuracy.error_bars import ErrorBars


class States(Protocol):
    """Loop over the states of a run, which can stop and continue after any of them."""

    done: int  # states so far
    outcome: Outcome  # of the last step

    @property
    def left(self) -> int:
        """States still to come; an estimate where the run chooses its steps."""

    def __iter__(self) -> Iterator[ContactState | None]:
        """Yield the remaining states, None for an inner step."""

    def restart_data(self) -> RestartData:
        """Return the state after a step as plain data."""


class Setup(Protocol):
    """Checked and complete setup of a run."""

    @property
    def grid(self) -> Grid:
        """Cells before the first step."""

    @property
    def transforms(self) -> str:
        """Library of the Fourier transforms."""

    @property
    def inner_loops(self) -> str:
        """What computes inner loops: "compiled", or "numpy"."""

    def with_libraries(self, transforms: str, inner_loops: str) -> Self:
        """Return the run with other libraries; ValueError if they are not installed."""


OfSetup = TypeVar("OfSetup", bound=Setup)
OfStates = TypeVar("OfStates", bound=States)


#: Attribute of what a pressure leaves on the free ends of bodies.
END_STRESS_LEFT = "end_stress_left"


@dataclass(frozen=True, eq=False)
class Analysis(ABC, Generic[OfSetup, OfStates]):
    """Contact problem that has been prepared; `errors` are those of its scalars, if estimated."""

    setup: OfSetup
    errors: bool = True
    #: Fluid that leaks through the gap, if the case names one.
    leakage: CaseLeakage | None = None

    #: Quantity in which its states differ.
    axis: ClassVar[RunAxis]

    @property
    def grid(self) -> Grid:
        """Cells before the first step."""
        return self.setup.grid

    @property
    @abstractmethod
    def contact(self) -> Problem:
        """Bodies, load and requirements."""

    @property
    @abstractmethod
    def places(self) -> Floats:
        """Instants [s] or speeds [m/s] of the states, as far as they are known."""

    @property
    def creepages(self) -> tuple[float, ...]:
        """Creepages of a body that rolls in steady motion with traction [-]."""
        return ()

    @property
    def fields(self) -> KeptFields:
        """Choice of the fields that are kept."""
        return self.contact.kept

    @property
    def total(self) -> int | None:
        """Number of states; None where the run chooses its steps."""
        return len(self.places)

    @property
    def grows(self) -> bool:
        """True if the grid may be enlarged under way."""
        return False

    # Resources, and what to expect.

    @property
    @abstractmethod
    def work(self) -> float:
        """Cells times steps or speeds, a relative measure of the computing time."""

    @property
    @abstractmethod
    def memory(self) -> float:
        """Memory of the run [bytes]."""

    @property
    @abstractmethod
    def seconds(self) -> float:
        """Predicted time of the run on this machine [s]."""

    @abstractmethod
    def forecast(self) -> Forecast:
        """Return the forecast; ValueError if no contact can carry the load."""

    # States and their errors.

    @abstractmethod
    def states(self, saved: RestartData | None = None) -> OfStates:
        """Return the loop from the beginning, or from the restart data of an earlier one."""

    @cached_property
    def _kept(self) -> frozenset[float]:
        return frozenset(self.fields.among(self.places, self.axis.name).tolist())

    def keeps(self, state: ContactState) -> bool:
        """True for a state whose fields are kept."""
        over = self.axis.name
        return self.fields.axis(over) == over or getattr(state, over) in self._kept

    @property
    def parts(self) -> frozenset[str]:
        """Parts of its states that only some runs have."""
        return self.contact.parts | (self.leakage.parts if self.leakage else frozenset())

    def leaking(self, state: ContactState) -> ContactState:
        """Return a state of the loop, with what leaks if the case names a fluid."""
        fluid = self.leakage
        if fluid is None:
            return state
        # As it is stored, so that a leakage of the result finds the same.
        found = fluid.values(self.recorded_state(state)) if self.keeps(state) else fluid.unknown
        return replace(state, **found)

    @property
    def leakage_memory(self) -> float:
        """Memory of the flow through the gap [bytes]."""
        return 0.0 if self.leakage is None else leakage.leakage_memory(self._cells)

    @property
    def leakage_seconds(self) -> float:
        """Predicted time of the flow at all instants whose fields are kept [s]."""
        if self.leakage is None:
            return 0.0
        return len(self._kept) * self.leakage.directions * leakage.leakage_seconds(self._cells)

    @property
    def _cells(self) -> int:
        return self.grid.shape[0] * self.grid.shape[1]

    def recorded_state(self, state: ContactState) -> ContactState:
        """Return a state of the loop as it is written to the result."""
        return state

    def after(self, states: Sequence[ContactState]) -> Self:
        """Return the analysis of these states only, with which a run has ended early."""
        return self

    @abstractmethod
    def part(self, states: OfStates, state: ContactState) -> float:
        """Finished part of the loop, after a state."""

    @abstractmethod
    def is_last(self, state: ContactState) -> bool:
        """True for the last state of the run."""

    @abstractmethod
    def error_bars(
        self,
        states: OfStates,
        history: History,
        grid: Grid,
        issued: Sequence[str],
        on_step: Callable[[], None] | None = None,
    ) -> ErrorBars:
        """Errors of the scalars, from coarser runs; `on_step` may end them by an exception."""

    @abstractmethod
    def error_bars_so_far(self, states: OfStates, history: History) -> ErrorBars:
        """Errors of the scalars that are known where a run has ended early."""

    # Description.

    @property
    @abstractmethod
    def description(self) -> dict[str, Any]:
        """Problem and grid."""

    @property
    def case(self) -> dict[str, Any]:
        """Description as plain data, which a run that is resumed must equal."""
        return plain_case(
            self.description, self.fields, errors=self.errors, leakage=self._fluid_settings
        )

    @property
    def _fluid_settings(self) -> Mapping[str, Any]:
        return {} if self.leakage is None else self.leakage.settings

    @property
    def fluid_attributes(self) -> dict[str, str]:
        """Attribute of a result with the settings of its leakage; none without a fluid."""
        return {LEAKAGE: json.dumps(self._fluid_settings)} if self._fluid_settings else {}

    @property
    @abstractmethod
    def attributes(self) -> dict[str, Any]:
        """Attributes that every result carries."""

    def attributes_after(
        self, states: Sequence[ContactState], described: Mapping[str, Any]
    ) -> dict[str, Any]:
        """Attributes that follow from the states, and from what error bars have described."""
        return {}

    def field_axis(self, states: Sequence[ContactState]) -> str:
        """Return the dimension of the fields of some states."""
        return self.fields.axis(self.axis.name)

    @property
    @abstractmethod
    def longest_creep(self) -> float:
        """Longest time for which the material creeps under the load [s]."""

    # Sentences.

    @property
    @abstractmethod
    def extent(self) -> str:
        """Extent of the finished run, in words."""

    @abstractmethod
    def made(self, rows: int, reached: float | None) -> str:
        """Describe the progress of the run, up to the instant [s] or speed [m/s] reached."""

    def continued(self, rows: int, reached: float | None) -> str:
        """Describe where a run is resumed, as `made`."""
        made = self.made(rows, reached)
        if reached is None or ", up to t =" in made:
            return made
        return f"{made}, {self.axis.place(reached)}"

    @abstractmethod
    def course(self) -> list[tuple[str, str]]:
        """Return what is computed, as rows of name and value."""

    def with_libraries(self, transforms: str, inner_loops: str) -> Self:
        """Return the run with other transforms and inner loops; ValueError if not installed."""
        return replace(self, setup=self.setup.with_libraries(transforms, inner_loops))


def plain_case(
    described: Mapping[str, Any],
    fields: KeptFields,
    *,
    errors: bool,
    leakage: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Return the description of a run as plain data, with its output."""
    whole = {**described, "fields": describe(fields.requested), "errors": errors}
    whole |= {LEAKAGE: leakage} if leakage else {}
    plain: dict[str, Any] = json.loads(json.dumps(whole))
    return plain


def fits_single_precision(problem: Problem, late: float) -> bool:
    """True if pressures fit into single precision, 1e-38 to 3e38 Pa, until a `late` time [s]."""
    compliance, level = float(problem.compliance(late)), problem.contact_load.largest_level
    return 1e-20 <= compliance <= 1e10 and 1e-25 <= level <= 1e15
