"""Reader of case files."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from os import PathLike
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from viscontact import case, tables
from viscontact.bodies import series_fits
from viscontact.bodies.loads.steady_motion import SteadyMotion
from viscontact.case.case import Case
from viscontact.case.document import Document, as_written, document_of, read_document
from viscontact.case.errors import CaseError, KeyPath
from viscontact.case.indenters.height_maps import HeightMap
from viscontact.case.indenters.shapes import combined
from viscontact.case.materials.measured_laws import TableLaw
from viscontact.case.overrides import override
from viscontact.case.sections import CaseFile, lacks_time
from viscontact.case.temperature_checks import temperature_problems
from viscontact.case.time_grid_output import early_fields, kept_fields, kept_speeds, with_instants
from viscontact.mechanics.problem.kept_fields import KeptFields

# Largest number of problems that are reported.
_MOST_PROBLEMS = 200


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
        If it is not valid; with all problems, each with its line and key.
    """
    document = override(read_document(Path(path)), overrides)
    return _case(document, _check_document(document))


def read_case_text(text: str, path: str | PathLike[str], overrides: Iterable[str] = ()) -> Case:
    """Read and check a case from an untrusted source, which may not read files elsewhere.

    Parameters
    ----------
    text : str
        The case, in YAML.
    path : path-like
        Its name in messages, a file or not. The files that it names lie in the same folder, and
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
    return _case(document, _check_document(document))


def digest(path: Path) -> bytes:
    """Return the SHA-256 of a file, to detect changes; empty if it cannot be read."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").digest()
    except OSError:
        return b""


def _check_document(document: Document) -> CaseFile:
    known = [document.problem(key, why) for key, why in document.misused]
    if lacks_time(document.data):
        known.append(document.problem(("time",), "is missing; instants of the run"))
    try:
        found = _validate(document, document.data)
    except ValidationError as error:
        findings = error.errors()
    else:
        known += [document.problem(*each) for each in temperature_problems(found, document.data)]
        if known:
            raise CaseError(*known)
        return found
    if guess := case.error_messages.corrected(document.data, findings):
        try:
            _validate(document, guess)
        except ValidationError as error:
            findings += error.errors()
    problems = dict.fromkeys(
        case.error_messages.problem(document, each) for each in findings[:_MOST_PROBLEMS]
    )
    problems |= dict.fromkeys(known)
    more = len(findings) - _MOST_PROBLEMS
    raise CaseError(*problems, *([f"{document.path}: and {more} more"] if more > 0 else []))


def _validate(document: Document, data: dict[str, Any]) -> CaseFile:
    folder, confined = str(document.path.parent), document.confined
    return CaseFile.model_validate(data, context={"folder": folder, "confined": confined})


def _case(document: Document, found: CaseFile) -> Case:
    motion, times, early = found.body_motion, None, None
    try:
        if isinstance(motion, SteadyMotion):
            fields = kept_speeds(found.output, motion.speeds)
        else:
            times = found.instants()
            early = early_fields(found.output, times)
            fields = kept_fields(found.output, times)
            times = with_instants(times, fields)
    except ValueError as error:
        raise CaseError(document.problem(("output", "fields"), str(error))) from error
    files = _files(found, document)
    return Case(
        title=found.title,
        indenter=combined(found.indenter),
        material=found.material.body,
        load=found.history(),
        motion=motion,
        temperature=found.temperature.built if found.temperature else None,
        adhesion=found.adhesion.built if found.adhesion else None,
        friction=found.friction.built if found.friction else None,
        tangential=found.tangential.built if found.tangential else None,
        title_block=found.report.entries,
        allowable=found.limits,
        leakage=found.leakage.settings if found.leakage else {},
        grid=found.grid.build() if found.grid else None,
        times=times,
        indenter_material=found.indenter_body,
        tolerance=found.tolerance,
        kept=KeptFields(fields),
        errors=found.output.errors,
        load_file=found.load.table,
        files=files,
        digests={path: digest(path) for path in (document.path, *files.values())},
        measured={name: law.measured for name, law in _tables(found).items()},
        fits=_fits(found),
        surfaces=tuple(each.surface for each in found.indenter if isinstance(each, HeightMap)),
        notes=(*_notes(found), *([early] if early else [])),
        document=document,
    )


def _notes(found: CaseFile) -> tuple[str, ...]:
    described = (*found.indenter, found.material, found.indenter_material, found.temperature)
    return tuple(note for each in described if each is not None for note in each.notes)


def _tables(found: CaseFile) -> dict[str, TableLaw]:
    """Measured tables as laws, by the section of the material."""
    materials = {"material": found.material, "indenter_material": found.indenter_material}
    return {name: law for name, law in materials.items() if isinstance(law, TableLaw)}


def _fits(found: CaseFile) -> dict[str, series_fits.Fit]:
    """Fits of the materials and of those of layers, by their keys."""
    laws = {name: law for name, law in found.media.items() if isinstance(law, TableLaw)}
    return {name: law.fit for name, law in laws.items() if law.fit is not None}


def _files(found: CaseFile, document: Document) -> dict[KeyPath, Path]:
    files: dict[KeyPath, Path] = {}
    is_list = isinstance(document.data["indenter"], list)
    for place, shape in enumerate(found.indenter):
        at: KeyPath = ("indenter", place) if is_list else ("indenter",)
        files |= {(*at, *key): path for key, path in shape.files.items()}
    if found.load.table is not None:
        files[("load", "file")] = found.load.table
    if found.temperature is not None and found.temperature.table is not None:
        files[("temperature", "file")] = found.temperature.table
    if found.tangential is not None and found.tangential.table is not None:
        files[("tangential", "file")] = found.tangential.table
    if found.motion is not None:
        files |= {("motion", *key): path for key, path in found.motion.files.items()}
    materials = {"material": found.material, "indenter_material": found.indenter_material}
    for section, material in materials.items():
        if material is not None:
            found_there = {(section, *key): path for key, path in material.files.items()}
            files |= {as_written(document.data, key): path for key, path in found_there.items()}
    return {key: tables.split_sheet(path)[0] for key, path in files.items()}
