"""Valid sections of an incomplete case, each read on its own."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

from pydantic import TypeAdapter

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.case.document import document_of
from viscontact.case.indenters.shapes import Shapes, combined
from viscontact.case.loads.load import AnyLoad
from viscontact.case.materials.layers import AnyBody
from viscontact.case.time_grid_output import Time

#: Kinds of the sections that are read here.
_KINDS: dict[str, Any] = {
    "indenter": Shapes,
    "material": AnyBody,
    "indenter_material": AnyBody,
    "load": AnyLoad,
    "time": Time,
}

_Object = TypeVar("_Object")


@dataclass(frozen=True)
class Parts:
    """Valid sections of a case, each read on its own.

    Attributes
    ----------
    indenter : Indenter or None
        The pressed body's shape; None, here and below, where it is not valid.
    material, indenter_material : Material, Layered or None
        The half-space's material, and the pressed body's.
    load : LoadHistory or None
        Force or approach; None for a mean pressure, whose force needs a grid.
    end : float or None
        The last instant [s].
    """

    indenter: Indenter | None
    material: Material | Layered | None
    indenter_material: Material | Layered | None
    load: LoadHistory | None
    end: float | None


def read_parts(text: str, path: str | PathLike[str]) -> Parts:
    r"""Read the valid sections of an incomplete case from an untrusted source.

    Parameters
    ----------
    text : str
        The case, in YAML.
    path : path-like
        As `read_case_text`: the files that it names lie in the same folder.

    Returns
    -------
    Parts
        The valid sections.

    Raises
    ------
    CaseError
        If it is not valid YAML, or not a mapping.

    Examples
    --------
    >>> text = "indenter: {shape: sphere, radius: 5 mm}\nload: {kind: step, force: 3 Pa}"
    >>> parts = read_parts(text, "case.yaml")
    >>> parts.indenter, parts.load
    (Sphere(radius=0.005), None)
    """
    data = document_of(text, Path(path), confined=True).data
    context = {"folder": str(Path(path).parent), "confined": True}

    def part(key: str, build: Callable[[Any], _Object]) -> _Object | None:
        try:
            return build(_adapter(key).validate_python(data.get(key), context=context))
        except ValueError:
            return None

    def load(found: Any) -> LoadHistory | None:
        history: LoadHistory | None = None if found.is_by_pressure else found.build(1.0)
        return history

    return Parts(
        part("indenter", combined),
        part("material", lambda found: found.built),
        part("indenter_material", lambda found: found.built),
        part("load", load),
        part("time", lambda found: float(found.end)),
    )


@cache
def _adapter(key: str) -> TypeAdapter[Any]:
    """Reader of a section, built when it is first read."""
    return TypeAdapter(_KINDS[key])
