"""A step that has been solved, with all that it takes to take it again without solving."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viscontact.contact.equilibrium import ContactSolution
from viscontact.state import Outcome
from viscontact.time_integration.restart_data import RestartData


@dataclass(frozen=True, eq=False)
class StepRecord:
    """The solution of one step, and what solving it has left behind.

    Attributes
    ----------
    time : float
        Its end [s].
    refused : tuple of float
        Errors of the longer steps that were tried first [-].
    solution : ContactSolution
        Equilibrium at its end.
    outcome : Outcome
        How it ended.
    patch : tuple of int
        Span of the patch that the half-space keeps for the next step.
    cells : tuple of int
        Numbers of cells of the grid it was solved on.
    """

    time: float
    refused: tuple[float, ...]
    solution: ContactSolution
    outcome: Outcome
    patch: tuple[int, int, int, int]
    cells: tuple[int, int]

    def plain(self) -> RestartData:
        """The same as plain data."""
        solution = self.solution
        return {
            "time": self.time,
            "refused": list(self.refused),
            "pressure": solution.values[0],
            "deflection": solution.values[1],
            "motion": solution.motion,
            "gap": solution.gap,
            "residual": float(solution.residual),
            "iterations": int(solution.iterations),
            "convolutions": int(solution.convolutions),
            "outcome": int(self.outcome),
            "patch": list(self.patch),
            "cells": list(self.cells),
        }

    @classmethod
    def from_plain_data(cls, plain: RestartData) -> StepRecord:
        """The step that was made `plain`."""
        outcome = Outcome(plain["outcome"])
        solution = ContactSolution(
            np.stack([plain["pressure"], plain["deflection"]]),
            plain["motion"],
            plain["gap"],
            plain["residual"],
            plain["iterations"],
            plain["convolutions"],
            converged=outcome is not Outcome.NOT_CONVERGED,
        )
        first_row, last_row, first_column, last_column = plain["patch"]
        patch = (first_row, last_row, first_column, last_column)
        along, across = plain["cells"]
        refused = tuple(plain["refused"])
        return cls(plain["time"], refused, solution, outcome, patch, (along, across))
