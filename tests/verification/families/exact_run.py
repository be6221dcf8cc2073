"""A drawn run of one of the families, with the exact values of its scalars."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import viscontact as vc

Array = np.ndarray


@dataclass(frozen=True, eq=False)
class ExactRun:
    """A run and the exact values of its scalars.

    `exact` gives scalars at the run's instants: inf where one has no finite value, NaN where no
    value is known. What the load prescribes is not among them.
    """

    name: str
    indenter: vc.Indenter
    material: vc.Material
    load: vc.LoadHistory
    grid: vc.Grid | vc.AutomaticGrid | None
    times: Any
    exact: Callable[[Array], dict[str, Array]]
    more: dict[str, Any] = field(default_factory=dict)
    #: Instants of the events of a load program [s].
    events: tuple[float, ...] = ()
    #: Uncertainties of the exact values at the run's instants, where they count.
    uncertainty: Callable[[Array], dict[str, Array]] = lambda times: {}
    #: Forces and instants of jumps of bodies that adhere, each with its uncertainty, by names of
    #: attributes of the result, or "jump_in" and "pull_off" for the instants of both.
    jumps: Callable[[], dict[str, tuple[Array, Array]]] = dict

    @property
    def arguments(self) -> dict[str, Any]:
        """Arguments of `simulate`."""
        return {
            "indenter": self.indenter,
            "material": self.material,
            "load": self.load,
            "grid": self.grid,
            "times": self.times,
            **self.more,
        }


class NotDrawnError(Exception):
    """The drawn problem has no exact solution here, or is too expensive; another one is drawn."""
