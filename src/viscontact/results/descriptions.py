"""Objects as plain data and back, to record the case of a result."""

from __future__ import annotations

import functools
import hashlib
import json
import math
from dataclasses import Field, fields, is_dataclass
from inspect import isabstract
from typing import Any

import numpy as np

from viscontact.bodies import indenters, laws, loads, materials
from viscontact.bodies.adhesion import Adhesion
from viscontact.bodies.friction import Friction
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.units.axis_flags import AxisFlags

#: Rooms whose exported classes a description names, and further classes by their names.
_ROOMS = (indenters, laws, loads, materials)
_OTHERS = {each.__name__: each for each in (Grid, AutomaticGrid, Friction, Adhesion)}

#: The number for which JSON has no notation.
INFINITE = "infinite"

#: Larger maps (measured surfaces) are named by shape and fingerprint, not written out.
LARGEST_ARRAY = 4096


def stored_class(name: str) -> Any | None:
    """Class that a description names: a shape, law, shift, load or what they make; else None."""
    room = next((room for room in _ROOMS if name in room.__all__), None)
    found = _OTHERS.get(name) if room is None else getattr(room, name)
    is_kind = isinstance(found, type) and not (isabstract(found) or found is loads.LoadPoint)
    return found if is_kind else None


def stored_classes() -> dict[str, Any]:
    """All classes that descriptions name, by their names."""
    names = [*(name for room in _ROOMS for name in room.__all__), *_OTHERS]
    found = {name: stored_class(name) for name in names}
    return {name: each for name, each in found.items() if each is not None}


def describe(obj: Any) -> Any:
    """Describe an object as plain data: its type's name and its arguments in SI units."""
    if is_dataclass(obj) and not isinstance(obj, type):
        arguments = {
            item.name: describe(getattr(obj, item.name))
            for item in fields(obj)
            if not _is_left_out(item, obj)
        }
        return {"type": type(obj).__name__, **arguments}
    if isinstance(obj, np.ndarray):
        # JSON has no NaN, which marks the holes of a map.
        is_map = obj.ndim > 1 and (obj.size > LARGEST_ARRAY or not np.isfinite(obj).all())
        return _fingerprint(obj) if is_map else obj.tolist()
    if isinstance(obj, np.generic):
        return obj.item()
    if isinstance(obj, AxisFlags):
        obj = obj.plain
    if isinstance(obj, tuple | list):
        return [describe(item) for item in obj]
    if isinstance(obj, float) and math.isinf(obj):
        return INFINITE
    if obj is None or isinstance(obj, str | int | float):
        return obj
    return {"type": type(obj).__name__, "repr": repr(obj)}


def _is_left_out(item: Field[Any], obj: Any) -> bool:
    """True for a field that follows from others, or equals a default that is not recorded."""
    if item.metadata.get("recorded") == "never":
        return True
    return item.metadata.get("recorded") == "if given" and getattr(obj, item.name) == item.default


@functools.lru_cache(maxsize=8)
def parse_case(text: str) -> dict[str, Any]:
    """Parse the attribute ``case`` of a result; ValueError if it is no JSON object."""
    case = json.loads(text)
    if not isinstance(case, dict):
        raise ValueError("the recorded case is no JSON object")
    return case


def rebuild(description: Any) -> Any:
    """Rebuild an object from its description."""
    if description == INFINITE:
        return math.inf
    if isinstance(description, list):
        return [rebuild(item) for item in description]
    if not isinstance(description, dict):
        return description
    if "sha256" in description:
        raise ValueError(
            f"an array of shape {description['shape']} is too large, or has holes, and is not kept "
            "in a result; build the indenter from its source again"
        )
    kind = stored_class(str(description.get("type", "")))
    if kind is None:
        raise ValueError(
            f"no object is called {description.get('type')!r}; known are {sorted(stored_classes())}"
        )
    return kind(**{key: rebuild(value) for key, value in description.items() if key != "type"})


def _fingerprint(array: np.ndarray[Any, Any]) -> dict[str, Any]:
    digest = hashlib.sha256(np.ascontiguousarray(array).tobytes()).hexdigest()
    return {"shape": list(array.shape), "sha256": digest}
