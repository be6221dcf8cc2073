"""Entries of the material library, read on demand."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import PurePosixPath
from typing import Any

from ruamel.yaml import YAML

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.materials.library.points import Points, read_points
from viscontact.units.parsing import parse_quantity

#: First in the list: the paper's material in its two versions.
_FIRST = ("pmma-paper", "pmma-kumar-2004")


@dataclass(frozen=True)
class Entry:
    """One material of the library with its sources.

    Parameters
    ----------
    name, family, title : str
        Its name, family of materials, and title.
    source, cite : str
        Authors, year, title, journal or repository, table or file; and in a few words.
    temperature, test : str
        At what temperature and in what test it was measured.
    measured : tuple of float or None
        First and last time on which the constants rest [s]; none of elastic ones.
    constants : str
        Origin: printed, and the place, or identified here, and from which data.
    limits : dict
        Strain, stress, first time and temperatures of the tests, as a case file has them; what the
        source does not state is left out.
    volume : str
        Source of Poisson's ratio or the bulk modulus.
    checked : str
        Check of the constants.
    licence : str
        Of the source, if it is a repository.
    material : dict
        The `material` section of a case file.
    points : tuple of Points
        Values of the source that the constants are compared with.
    """

    name: str
    family: str
    title: str
    source: str
    cite: str
    temperature: str
    test: str
    measured: tuple[float, float] | None
    limits: dict[str, Any]
    constants: str
    volume: str
    checked: str
    licence: str
    material: dict[str, Any]
    points: tuple[Points, ...]

    def __hash__(self) -> int:
        return hash(self.name)  # sections of files cannot be hashed


@cache
def names() -> tuple[str, ...]:
    """Return the names of the shipped materials, without reading their files.

    Returns
    -------
    tuple of str
        The paper's material in its two versions first, then in alphabetical order.

    Examples
    --------
    >>> names()[:2]
    ('pmma-paper', 'pmma-kumar-2004')
    """
    paths = (PurePosixPath(file.name) for file in _folder().iterdir())
    found = {path.stem for path in paths if path.suffix == ".yaml"}
    return (*_FIRST, *sorted(found.difference(_FIRST)))


@cache
def entry(name: str) -> Entry:
    """Read one entry of the library.

    Parameters
    ----------
    name : str
        One of `names`.

    Returns
    -------
    Entry
        The content of its file.

    Raises
    ------
    KeyError
        If there is no such entry.

    Examples
    --------
    >>> entry("pmma-paper").family
    'glassy polymer'
    """
    if name not in names():
        raise KeyError(name)
    given = YAML(typ="safe", pure=True).load(
        _folder().joinpath(f"{name}.yaml").read_text(encoding="utf-8")
    )
    ratio = given["material"].get("poisson_ratio")
    measured = None
    if "range" in given:
        first, last = (parse_quantity(text, "time") for text in given.pop("range"))
        measured = first, last
    points = tuple(read_points(each, ratio) for each in given.pop("points"))
    return Entry(**given, measured=measured, points=points)


def _folder() -> Traversable:
    return files("viscontact.bodies.materials.library")
