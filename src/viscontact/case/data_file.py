"""Files that a case file names."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, ValidationInfo

from viscontact import tables
from viscontact.case.plain_names import is_plain_name
from viscontact.case.quantities import Section


def beside_the_case(name: str, info: ValidationInfo) -> str:
    """Return the path of a file that a case names; a confined case may use plain names only."""
    context = info.context or {}
    if context.get("confined") and not is_plain_name(name):
        raise ValueError(
            f"{name!r} is not the plain name of a file, such as 'pmma.csv'; here a case reads only "
            "files in its own folder"
        )
    return str(Path(context.get("folder", "."), name))


def at_key(why: str) -> str:
    """A message of the reader of tables, with the key of the section that it belongs to."""
    at = "" if why.startswith("columns: ") else "file: "
    return f"{at}{tables.with_typed_meanings(why, 'columns:')}"


def is_same_file(one: Path, other: Path) -> bool:
    """True if two paths, links followed, are the same existing file."""
    return one.exists() and other.exists() and one.samefile(other)


#: The path of a file, relative to the folder of the case file unless it is absolute.
DataFile = Annotated[str, AfterValidator(beside_the_case)]


class FileSection(Section):
    """Section that may name a file under the key `file`."""

    @property
    def files(self) -> Mapping[tuple[str, ...], Path]:
        """Files of the section, by the keys that name them."""
        name = getattr(self, "file", None)
        return {} if name is None else {("file",): Path(name)}
