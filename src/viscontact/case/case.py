"""Case: the run that a case file describes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field
from pathlib import Path
from typing import Any

from viscontact import case, tables
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies import series_fits
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.bodies.surfaces import Surface
from viscontact.case.document import Document
from viscontact.case.errors import CaseError, KeyPath
from viscontact.case.yaml_source import with_overrides
from viscontact.mechanics.problem.problem import Problem
from viscontact.results.run_files import CASE_NAME, PROGRESS_NAME, RESULT_NAME, STATE_NAME
from viscontact.units.display import Displayable, DisplayableGroup
from viscontact.units.formatting import format_quantity

#: Files of a run other than its case; names with a leading dot are reserved as well.
_RUN_NAMES = (CASE_NAME, RESULT_NAME, PROGRESS_NAME, STATE_NAME)


@dataclass(frozen=True, eq=False, kw_only=True)
class Case(DisplayableGroup, Problem):
    """A contact problem that was read from a case file.

    Parameters
    ----------
    title : str
        Title of the run.
    errors : bool
        True if the errors of the scalars are estimated.
    load_file : Path or None
        The table of the load history, if it has one.
    files : mapping of tuple to Path
        Every file that the case is read from, by the key that names it.
    title_block : mapping of str to str
        Entries of the report's title block, by name.
    allowable : mapping of str to float
        Limits by the names of scalars or stresses, in SI units.
    leakage : mapping of str to object
        Settings of the leakage, by the arguments of `leakage`, in SI units; empty without it.
    digests : mapping of Path to bytes
        SHA-256 of each of those files, and of the case file, when it was read.
    measured : mapping of str to mapping
        Tables of the laws, in the quantities that were measured, by the section of the material.
    fits : mapping of str to Fit
        Series fitted to oscillations that the case names, by the key of the material:
        "material", "material.layers[1]", "material.base".
    surfaces : tuple of Surface
        Measured surfaces of the indenter, as they are pressed.
    notes : tuple of str
        Notes on contents of the files, and on those that are not used.
    document : Document
        The file it is from.
    """

    title: str
    errors: bool
    load_file: Path | None
    files: Mapping[KeyPath, Path]
    title_block: Mapping[str, str]
    allowable: Mapping[str, float]
    leakage: Mapping[str, Any]
    digests: Mapping[Path, bytes] = field(repr=False)
    measured: Mapping[str, Mapping[str, Any]]
    fits: Mapping[str, series_fits.Fit] = field(repr=False)
    surfaces: tuple[Surface, ...] = field(repr=False)
    notes: tuple[str, ...]
    document: Document = field(repr=False)

    @property
    def fields(self) -> str | Sequence[float]:
        """Instants [s] or speeds [m/s] whose fields are kept, or "all", or "none"."""
        return self.kept.requested

    @property
    def display_title(self) -> str:
        """Title of the case."""
        return self.title or "Case"

    def display_parts(self) -> dict[str, Displayable | str]:
        """Return the parts for display in notebooks."""
        return {
            "indenter": self.indenter,
            "material": self.material,
            "indenter material": self.indenter_material or "rigid",
            "load": self.load,
            **({} if self.temperature is None else {"temperature": self.temperature}),
            "grid": self.grid or "automatic",
            **_format_rows(self),
            "tolerance": f"{self.tolerance:g}",
        }

    @property
    def text(self) -> str:
        """YAML text of the case as run: with overrides, and with its files next to it."""
        if not self.files:
            return self.document.text
        names = self.file_names
        return with_overrides(
            self.document.text,
            {key: names[path] + self._sheet(key) for key, path in self.files.items()},
        )

    def _sheet(self, key: KeyPath) -> str:
        """The chosen sheet of a spreadsheet with its ``#``; empty without one."""
        named: Any = self.document.data
        for step in key:
            named = named[step]
        sheet = tables.split_sheet(Path(named))[1]
        return "" if sheet is None else f"#{sheet}"

    @property
    def file_names(self) -> dict[Path, str]:
        """Name of each file next to the case as run: its own name, if that is free."""
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
        """Return an error of the run as an error at the key that it names."""
        return CaseError(case.error_messages.object_problem(self.document, (), why))


def _format_rows(case: Case) -> dict[str, str]:
    if not isinstance(case.motion, SteadyMotion):
        return {"steps": _format_steps(case)}
    speeds = case.motion.speeds
    low, high = (format_quantity(each, "m/s") for each in (min(speeds), max(speeds)))
    several = f"{len(speeds)} from {low} to {high}"
    return {"speeds" if len(speeds) > 1 else "speed": several if len(speeds) > 1 else low}


def _format_steps(problem: Problem) -> str:
    if problem.adaptive is not None:
        end, tolerance = format_quantity(problem.adaptive.end, "s"), problem.adaptive.tolerance
        return f"chosen by their error, {tolerance:g} at most, up to {end}"
    first, last = (format_quantity(float(time), "s") for time in problem.instants[[0, -1]])
    return f"{problem.instants.size}, from {first} to {last}"
