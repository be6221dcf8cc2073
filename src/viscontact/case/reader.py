"""From a case file to nouns."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from viscontact.case.document import Document, document_of, read_document
from viscontact.case.indenters import combined
from viscontact.case.overrides import override
from viscontact.case.problems import CaseError, KeyPath
from viscontact.case.schedule import kept_fields, with_instants
from viscontact.case.sections import CaseFile
from viscontact.case.wording import corrected, noun_problem, problem
from viscontact.case.yaml_source import with_overrides
from viscontact.grid import AutomaticGrid, Grid
from viscontact.indenters import Indenter
from viscontact.load import LoadHistory
from viscontact.material import Material
from viscontact.shown import Shown, ShownWhole
from viscontact.stepping import AdaptiveTimes
from viscontact.units import in_words

# What a run writes beside its case; names that begin with a dot are its own, too.
_RUN_NAMES = ("case.yaml", "result.nc", "progress.jsonl", "state.npz", "steps.log")


# Of so many problems each is told; who has more mends these first.
_MOST_PROBLEMS = 200


@dataclass(frozen=True, eq=False)
class Case(ShownWhole):
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
    def shown_title(self) -> str:
        """What the user calls it."""
        return self.title or "Case"

    def shown_parts(self) -> dict[str, Shown | str]:
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
        return CaseError(noun_problem(self.document, (), why))


def read_case(path: str | PathLike[str], overrides: Iterable[str] = ()) -> Case:
    """Read and check a case file, YAML or TOML.

    Parameters
    ----------
    path : path-like
        The file.
    overrides : iterable of str
        Values in place of those in the file, such as ``"load.force=20kN"``.

    Returns
    -------
    Case
        The run it describes.

    Raises
    ------
    CaseError
        If anything in it cannot be understood or makes no sense; all problems at once, each
        with its line and key.
    """
    document = override(read_document(Path(path)), overrides)
    return _case(document, _checked(document))


def read_case_text(text: str, path: str | PathLike[str], overrides: Iterable[str] = ()) -> Case:
    """Read and check a case that somebody else sends, and that may read no files of the user's.

    Parameters
    ----------
    text : str
        The case, in YAML.
    path : path-like
        What messages call it, a file or not. The files that it names lie in the same folder, and
        are named by plain names: paths that lead elsewhere are refused before anything is read.
    overrides : iterable of str
        Values in place of those in the text, such as ``"load.force=20kN"``.

    Returns
    -------
    Case
        The run it describes.

    Raises
    ------
    CaseError
        As `read_case`.

    Examples
    --------
    >>> try:
    ...     read_case_text("material: {law: table, file: /etc/passwd}", "case.yaml")
    ... except CaseError as error:
    ...     "'/etc/passwd' is not the plain name of a file" in str(error)
    True
    """
    document = override(document_of(text, Path(path), confined=True), overrides)
    return _case(document, _checked(document))


def digest(path: Path) -> bytes:
    """Tell what a file holds, so that a change is noticed; nothing if it cannot be read.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    bytes
        Its SHA-256.
    """
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").digest()
    except OSError:
        return b""


def _checked(document: Document) -> CaseFile:
    try:
        return _validated(document, document.data)
    except ValidationError as error:
        findings = error.errors()
    if guess := corrected(document.data, findings):
        try:
            _validated(document, guess)
        except ValidationError as error:
            findings += error.errors()
    problems = dict.fromkeys(problem(document, each) for each in findings[:_MOST_PROBLEMS])
    more = len(findings) - _MOST_PROBLEMS
    raise CaseError(*problems, *([f"{document.path}: and {more} more"] if more > 0 else []))


def _validated(document: Document, data: dict[str, Any]) -> CaseFile:
    folder, confined = str(document.path.parent), document.confined
    return CaseFile.model_validate(data, context={"folder": folder, "confined": confined})


def _case(document: Document, found: CaseFile) -> Case:
    times = found.time.instants()
    try:
        fields = kept_fields(found.output, times)
    except ValueError as error:
        raise CaseError(document.problem(("output", "fields"), str(error))) from error
    of_indenter, files = found.indenter_material, _files(found, document)
    return Case(
        title=found.title,
        indenter=combined(found.indenter),
        material=found.material.noun(),
        indenter_material=of_indenter.noun() if of_indenter else None,
        load=found.history(),
        times=with_instants(times, fields),
        grid=found.grid.noun() if found.grid else None,
        fields=fields,
        errors=found.output.errors,
        tolerance=found.tolerance,
        load_file=found.load.table,
        files=files,
        digests={path: digest(path) for path in files.values()},
        notes=_notes(found),
        document=document,
    )


def _notes(found: CaseFile) -> tuple[str, ...]:
    described = (*found.indenter, found.material, found.indenter_material)
    return tuple(note for each in described if each is not None for note in each.notes)


def _steps_told(times: NDArray[np.float64] | AdaptiveTimes) -> str:
    if isinstance(times, AdaptiveTimes):
        return (
            f"chosen by their error, {times.tolerance:g} at most, up to {in_words(times.end, 's')}"
        )
    first, last = (in_words(float(instant), "s") for instant in times[[0, -1]])
    return f"{times.size}, from {first} to {last}"


def _files(found: CaseFile, document: Document) -> dict[KeyPath, Path]:
    files: dict[KeyPath, Path] = {}
    is_list = isinstance(document.data["indenter"], list)
    for place, shape in enumerate(found.indenter):
        at: KeyPath = ("indenter", place) if is_list else ("indenter",)
        files |= {(*at, *key): path for key, path in shape.files.items()}
    if found.load.table is not None:
        files[("load", "file")] = found.load.table
    materials = {"material": found.material, "indenter_material": found.indenter_material}
    for section, material in materials.items():
        if material is not None:
            files |= {(section, *key): path for key, path in material.files.items()}
    return files
