"""A case that has been understood: the run that it describes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from viscontact.case.document import Document
from viscontact.case.error_messages import object_problem
from viscontact.case.errors import CaseError, KeyPath
from viscontact.case.yaml_source import with_overrides
from viscontact.display import Displayable, DisplayableGroup
from viscontact.grid import AutomaticGrid, Grid
from viscontact.indenters import Indenter
from viscontact.loads import LoadHistory
from viscontact.materials.material import Material
from viscontact.run_files import CASE_NAME, PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.time_integration.requested_times import AdaptiveTimes
from viscontact.units.formatting import format_quantity

#: Files of a run beside its case; names that begin with a dot are its own, too.
_RUN_NAMES = (CASE_NAME, RESULT_NAME, PROGRESS_NAME, STATE_NAME)


@dataclass(frozen=True, eq=False)
class Case(DisplayableGroup):
    """A run as a case file describes it, in nouns and SI numbers.

    Parameters
    ----------
    title : str
        What the user calls it.
    indenter : Indenter
        The pressed body's shape.
    material : Material
        The half-space's material.
    indenter_material : Material or None
        The pressed body's material; None for a rigid one.
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    times : ndarray or AdaptiveTimes
        Instants of the run, those of the fields among them [s], or the wish for adaptive ones.
    grid : Grid, AutomaticGrid or None
        The grid, or what is asked of an automatic one; None if nothing is said of it.
    fields : str or tuple of float
        ``"all"``, ``"none"``, or the instants whose fields are kept [s].
    errors : bool
        Whether the errors of the scalars are estimated.
    tolerance : float
        Relative error of pressure and balances.
    load_file : Path or None
        The CSV of the load history, if it has one.
    files : mapping of tuple to Path
        Every file that the case is read from, by the key that names it.
    digests : mapping of Path to bytes
        What each of those files held when it was read, as `digest` tells it.
    notes : tuple of str
        What was found in those files, and what of it is not used.
    document : Document
        The file it is from.
    """

    title: str
    indenter: Indenter
    material: Material
    indenter_material: Material | None
    load: LoadHistory
    times: NDArray[np.float64] | AdaptiveTimes
    grid: Grid | AutomaticGrid | None
    fields: str | tuple[float, ...]
    errors: bool
    tolerance: float
    load_file: Path | None
    files: Mapping[KeyPath, Path]
    digests: Mapping[Path, bytes] = field(repr=False)
    notes: tuple[str, ...]
    document: Document = field(repr=False)

    @property
    def display_title(self) -> str:
        """What the user calls it."""
        return self.title or "Case"

    def display_parts(self) -> dict[str, Displayable | str]:
        """Return what a notebook shows of it."""
        return {
            "indenter": self.indenter,
            "material": self.material,
            "indenter material": self.indenter_material or "rigid",
            "load": self.load,
            "grid": self.grid or "automatic",
            "steps": _steps_told(self.times),
            "tolerance": f"{self.tolerance:g}",
        }

    @property
    def text(self) -> str:
        """The case as YAML as it is run: with what was set, its files beside it."""
        if not self.files:
            return self.document.text
        names = self.file_names
        return with_overrides(
            self.document.text, {key: names[path] for key, path in self.files.items()}
        )

    @property
    def file_names(self) -> dict[Path, str]:
        """What each file is called beside the case as it is run: its own name if that is free."""
        names: dict[Path, str] = {}
        taken = {name.lower() for name in _RUN_NAMES}
        for key, path in self.files.items():
            if path in names:
                continue
            name = path.name
            while name.lower() in taken or name.startswith("."):
                name = f"{key[0]}-{name}"
            names[path] = name
            taken.add(name.lower())
        return names

    def error(self, why: str) -> CaseError:
        """Return what the run refused as an error at the key it speaks of.

        Parameters
        ----------
        why : str
            The refusal, as ``load.eccentricity_x: the force acts ...``.

        Returns
        -------
        CaseError
            The same with file, line and key in front.
        """
        return CaseError(object_problem(self.document, (), why))


def _steps_told(times: NDArray[np.float64] | AdaptiveTimes) -> str:
    if isinstance(times, AdaptiveTimes):
        return (
            f"chosen by their error, {times.tolerance:g} at most, up to "
            f"{format_quantity(times.end, 's')}"
        )
    first, last = (format_quantity(float(instant), "s") for instant in times[[0, -1]])
    return f"{times.size}, from {first} to {last}"
