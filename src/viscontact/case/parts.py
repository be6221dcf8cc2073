"""What of a case can be read although the rest cannot: each section by itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

from pydantic import TypeAdapter

from viscontact.case.document import document_of
from viscontact.case.indenters.shapes import Shapes, combined
from viscontact.case.loads.load import AnyLoad
from viscontact.case.materials.material import AnyMaterial
from viscontact.case.time_grid_output import Time
from viscontact.indenters import Indenter
from viscontact.loads import LoadHistory
from viscontact.materials.material import Material

_SHAPES: TypeAdapter[Any] = TypeAdapter(Shapes)
_MATERIAL: TypeAdapter[Any] = TypeAdapter(AnyMaterial)
_LOAD: TypeAdapter[Any] = TypeAdapter(AnyLoad)
_TIME: TypeAdapter[Any] = TypeAdapter(Time)

_Noun = TypeVar("_Noun")


@dataclass(frozen=True)
class Parts:
    """The sections of a case that can be read, each by itself.

    Attributes
    ----------
    indenter : Indenter or None
        The pressed body's shape; None, here and below, where it cannot be read.
    material, indenter_material : Material or None
        The half-space's material, and the pressed body's.
    load : LoadHistory or None
        Force or approach; none of a mean pressure, whose force takes a grid.
    end : float or None
        The last instant [s].
    """

    indenter: Indenter | None
    material: Material | None
    indenter_material: Material | None
    load: LoadHistory | None
    end: float | None


def read_parts(text: str, path: str | PathLike[str]) -> Parts:
    r"""Read what can be read of a case that somebody else sends and is still writing.

    Parameters
    ----------
    text : str
        The case, in YAML.
    path : path-like
        As `read_case_text`: the files that it names lie in the same folder.

    Returns
    -------
    Parts
        Its sections, whatever is wrong with the others.

    Raises
    ------
    CaseError
        If it is no YAML, or no mapping.

    Examples
    --------
    >>> text = "indenter: {shape: sphere, radius: 5 mm}\nload: {kind: step, force: 3 Pa}"
    >>> parts = read_parts(text, "case.yaml")
    >>> parts.indenter, parts.load
    (Sphere(radius=0.005), None)
    """
    data = document_of(text, Path(path), confined=True).data
    context = {"folder": str(Path(path).parent), "confined": True}

    def part(key: str, kind: TypeAdapter[Any], noun: Callable[[Any], _Noun]) -> _Noun | None:
        try:
            return noun(kind.validate_python(data.get(key), context=context))
        except ValueError:
            return None

    def load(found: Any) -> LoadHistory | None:
        history: LoadHistory | None = None if found.is_by_pressure else found.build(1.0)
        return history

    return Parts(
        part("indenter", _SHAPES, combined),
        part("material", _MATERIAL, lambda found: found.build()),
        part("indenter_material", _MATERIAL, lambda found: found.build()),
        part("load", _LOAD, load),
        part("time", _TIME, lambda found: float(found.end)),
    )
