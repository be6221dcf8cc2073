"""Single materials: from the library, a case file or a section."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from viscontact.bodies.materials import library
from viscontact.bodies.materials.material import Material
from viscontact.case.document import Document, read_document, with_section
from viscontact.case.error_messages import problem
from viscontact.case.errors import CaseError
from viscontact.case.materials.base import Medium
from viscontact.case.materials.material import MaterialAlone


def shipped_material(name: str) -> Material:
    """Return a material of the shipped library.

    Parameters
    ----------
    name : str
        Such as ``"pmma-paper"``; ``viscontact material`` lists them with their sources.

    Returns
    -------
    Material
        The material, as for a case file that gives its name.

    Raises
    ------
    ValueError
        If there is no such material; the message lists all.

    Examples
    --------
    >>> round(shipped_material("pmma-kumar-2004").law.relaxation(0.0) / 1e6, 2)
    653.42
    """
    if name not in library.names():
        raise ValueError(library.unknown_name(str(name)))
    return MaterialAlone.model_validate({"material": name}).material.built


def read_material(path: str | PathLike[str]) -> Material:
    """Read the material of a case file, and nothing else.

    Parameters
    ----------
    path : path-like
        A case file, YAML or TOML; or a file that holds a `material` section alone, or only its
        keys.

    Returns
    -------
    Material
        The half-space's material.

    Raises
    ------
    CaseError
        If there is none, or it is not valid; with all problems, each with its line and key.
    """
    document = with_section(read_document(Path(path)))
    if "material" not in document.data:
        raise CaseError(
            f"{path}: holds no material; a case file has a section material: with its law"
        )
    return _lone_material(document, document.path.parent).built


def read_section(section: Mapping[str, Any], place: str | PathLike[str]) -> Medium:
    """Read a `material` section without a case file.

    Parameters
    ----------
    section : mapping
        Its keys, and texts, numbers and lists as a case file has them. Files are named from the
        working directory.
    place : path-like
        First words of messages.

    Returns
    -------
    Medium
        The checked section; its ``build()`` returns the material.

    Raises
    ------
    CaseError
        If it is not valid; with all problems, each with its key.

    Examples
    --------
    >>> keys = {"law": "elastic", "shear_modulus": "1 MPa", "poisson_ratio": 0.5}
    >>> read_section(keys, "typed").build().law
    Elastic(shear_modulus=1000000.0)
    """
    return _lone_material(Document(Path(place), "", {"material": dict(section)}, {}), Path())


def _lone_material(document: Document, folder: Path) -> Medium:
    try:
        context = {"folder": str(folder)}
        return MaterialAlone.model_validate(document.data, context=context).material
    except ValidationError as error:
        found = dict.fromkeys(problem(document, each) for each in error.errors())
        raise CaseError(*found) from error
