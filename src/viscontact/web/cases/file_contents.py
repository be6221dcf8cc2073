"""Contents of a file that was opened on the page, and the section of a case that names it."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import asdict
from typing import Any

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.surfaces import read_surface
from viscontact.identification.instrument_curves import is_instrument_file
from viscontact.tables import Table, read_table
from viscontact.web.cases.case_reader import CaseReader
from viscontact.web.workspace.problems import RequestError

#: Quantities of a test of a material, and of a force curve, whose fit is a part of the page.
_OF_MATERIALS = ("creep_compliance", "relaxation_modulus", "storage_modulus", "strain")
_OF_CURVES = ("position", "deflection", "signal")


@dataclass(frozen=True)
class FileContents:
    """What a file holds in words, and the section of a case that names it."""

    holds: str
    path: tuple[str, ...] = ()  # of the section; none for what the fit takes
    section: dict[str, Any] | None = None
    fit: str = ""  # kind of the fit that takes it: "curve" or "material"


def contents_of_upload(cases: CaseReader, name: str) -> dict[str, Any]:
    """Return what a file of the folder holds; RequestError if that is not known."""
    path = cases.folder.stored_file(name)
    if is_instrument_file(path):
        return asdict(FileContents("a force curve", fit="curve"))
    with suppress(ValueError, OSError):
        if found := _of_table(read_table(path), name):
            return asdict(found)
    try:
        surface = read_surface(path)
    except (ValueError, OSError) as error:
        # A height map may lack the distance of its points, which the case states.
        if path.suffix.lower() not in (".npy", ".npz"):
            raise RequestError(
                422,
                f"{name} is stored, but neither a case nor a table, force curve or height map that "
                f"can be read; a case names it by a key 'file'. As a height map: {error}",
            ) from error
        shape = "a height map"
    else:
        shape = f"a height map of {' × '.join(map(str, surface.heights.shape))} points"
    return asdict(FileContents(shape, ("indenter",), {"shape": "height-map", "file": name}))


def _of_table(table: Table, name: str) -> FileContents | None:
    """Contents of a table with headings; None for one of heights."""
    if any(each in table for each in _OF_CURVES) or ("force" in table and "approach" in table):
        return FileContents("a force curve", fit="curve")
    if any(each in table for each in _OF_MATERIALS):
        if not table.has_varying_temperature and (count := len(table.sets())) > 1:
            return FileContents(f"{count} tests of a material", fit="material")
        section = {"law": "table", "file": name}
        return FileContents("a test of a material", ("material",), section, fit="material")
    if "time" in table and ("force" in table or "approach" in table):
        section = {"kind": "history", "file": name}
        return FileContents("a load over time", ("load",), section)
    return None
