"""Lazy dataclasses: what they do is what those of the standard library do."""

from __future__ import annotations

import copy
import dataclasses
import inspect
import pickle
import re
from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import FrozenInstanceError, InitVar, field
from functools import cached_property
from threading import Barrier
from typing import Any, ClassVar, Generic, TypeVar

import pytest

from viscontact.backend import lazy_dataclass
from viscontact.backend.lazy_dataclass import dataclass as lazy

DECORATORS = {"lazy": lazy, "standard": dataclasses.dataclass}
Of = TypeVar("Of")


def family(dataclass: Callable[..., Any]) -> dict[str, type]:
    """Classes as the package has them, made by one decorator."""

    @dataclass(frozen=True)
    class Point:
        """A point."""

        x: float
        y: float = 2.0
        names: list[str] = field(default_factory=list, repr=False, compare=False)
        kind: ClassVar[str] = "point"

        def __post_init__(self) -> None:
            object.__setattr__(self, "x", float(self.x))

        @cached_property
        def sum(self) -> float:
            return self.x + self.y

    @dataclass(frozen=True, kw_only=True)
    class Named(Point):
        """A point with a name, and one that is left out."""

        name: str
        hidden: int = field(default=3, init=False)

    class Loud(Point):
        """A class that is no dataclass of its own."""

        def __init__(self, x: float) -> None:
            super().__init__(x, 1.0)

    @dataclass
    class Box(Generic[Of]):
        """A box that can be changed."""

        content: Of
        scale: InitVar[float] = 1.0

        def __post_init__(self, scale: float) -> None:
            self.size = scale

    @dataclass(frozen=True, eq=False, repr=False)
    class Body(ABC):
        """A body with an abstract part."""

        mass: float

        @property
        @abstractmethod
        def volume(self) -> float: ...

        def __repr__(self) -> str:
            return "a body"

    @dataclass(frozen=True, eq=False)
    class Cube(Body):
        """A body that is complete."""

        edge: float = field(default=1.0, metadata={"unit": "m"})

        @property
        def volume(self) -> float:
            return self.edge**3

    @dataclass(frozen=True)
    class Own:
        """A class with methods of its own."""

        value: int

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Own)

    @dataclass(frozen=True, eq=False, init=False)
    class Started:
        """A class that makes its objects itself."""

        value: int

        def __init__(self, text: str) -> None:
            object.__setattr__(self, "value", int(text))

    found = (Point, Named, Loud, Box, Body, Cube, Own, Started)
    return {each.__name__: each for each in found}


def facts(dataclass: Callable[..., Any], told: Callable[[dict[str, type]], Any]) -> Any:
    try:
        found = told(family(dataclass))
    except (TypeError, AttributeError, ValueError) as error:
        found = type(error), str(error)
    return re.sub(r" at 0x[0-9a-f]+", "", repr(found)) if not isinstance(found, str) else found


#: Of new classes each, as the first use makes them.
TOLD: tuple[Callable[[dict[str, Any]], Any], ...] = (
    lambda of: {name: str(inspect.signature(each)) for name, each in of.items()},
    lambda of: [
        (each.name, each.default, each.metadata) for each in dataclasses.fields(of["Cube"])
    ],
    lambda of: [each.name for each in dataclasses.fields(of["Named"])],
    lambda of: {name: each.__match_args__ for name, each in of.items()},
    lambda of: {name: dataclasses.is_dataclass(each) for name, each in of.items()},
    lambda of: {name: each.__dataclass_params__ for name, each in of.items()},
    lambda of: of["Point"](1),
    lambda of: of["Point"](1, y=3, names=["a"]).names,
    lambda of: of["Point"](),
    lambda of: of["Point"](1) == of["Point"](1.0, names=["other"]),
    lambda of: hash(of["Point"](1)) == hash(of["Point"](1.0)),
    lambda of: of["Named"](1, name="n") == of["Point"](1),
    lambda of: of["Named"](1, name="n"),
    lambda of: of["Named"](1, "n"),
    lambda of: dataclasses.replace(of["Named"](1, name="n"), x=5),
    lambda of: dataclasses.asdict(of["Named"](1, name="n")),
    lambda of: of["Named"].hidden,
    lambda of: of["Loud"](4),
    lambda of: of["Loud"](4) == of["Loud"](4),
    lambda of: vars(of["Box"]([1], 2.0)),
    lambda of: of["Box"][int](3),
    lambda of: hash(of["Box"](1)),
    lambda of: of["Box"](1) == of["Box"](1),
    lambda of: of["Body"](1.0),
    lambda of: (of["Cube"](1.0, 2.0), of["Cube"](1.0, 2.0).volume),
    lambda of: of["Cube"](1.0) == of["Cube"](1.0),
    lambda of: of["Cube"].__abstractmethods__,
    lambda of: hash(of["Own"](1)) == hash(of["Own"](1)),
    lambda of: of["Own"](1) == of["Own"](2),
    lambda of: of["Started"]("3"),
    lambda of: of["Started"](),
    lambda of: copy.deepcopy(of["Point"](1, names=["a"])).names,
    lambda of: {name: each.__doc__ for name, each in of.items()},
    lambda of: of["Point"](1).sum,
)


@pytest.mark.parametrize("told", TOLD)
def test_a_lazy_dataclass_is_that_of_the_standard_library(told: Callable[[Any], Any]) -> None:
    assert facts(lazy, told) == facts(dataclasses.dataclass, told)


@pytest.mark.parametrize("name", ["x", "names", "new"])
@pytest.mark.parametrize("kind", ["Point", "Named", "Loud", "Started"])
def test_assignments_are_refused_alike(kind: str, name: str) -> None:
    words: tuple[Any, dict[str, Any]]
    words = ("7", {}) if kind == "Started" else (7, {"name": "n"} if kind == "Named" else {})
    ends = []
    for dataclass in (lazy, dataclasses.dataclass):
        made = family(dataclass)[kind](words[0], **words[1])
        for change in (lambda of: setattr(of, name, 1), lambda of: delattr(of, name)):
            try:
                change(made)
            except AttributeError as error:
                ends.append((type(error), re.sub(r"^'\w+' object", "object", str(error))))
            else:
                ends.append((type(None), ""))
    assert ends[:2] == ends[2:]
    assert (kind == "Loud" and name == "new") or FrozenInstanceError in {end for end, _ in ends}


@lazy(frozen=True)
class Kept:
    """A class that pickle finds."""

    value: int


def test_an_object_from_elsewhere_is_frozen_and_equal_before_its_class_is_made() -> None:
    @lazy(frozen=True)
    class Value:
        """Unused yet."""

        value: int

    # as pickle makes it, without `__init__`
    made = []
    for _ in range(2):
        made.append(object.__new__(Value))
        vars(made[-1])["value"] = 3
    with pytest.raises(FrozenInstanceError):
        made[0].value = 4  # type: ignore[misc]
    assert made[0] == made[1]
    assert pickle.loads(pickle.dumps(Kept(3))) == Kept(3)


def test_methods_are_made_at_the_first_use(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[str] = []
    standard = dataclasses.dataclass

    def counting(**options: bool) -> Callable[[type], type]:
        return lambda cls: made.append(cls.__name__) or standard(**options)(cls)  # type: ignore[func-returns-value,call-overload,no-any-return]

    monkeypatch.setattr(lazy_dataclass.dataclasses, "dataclass", counting)
    classes = family(lazy)
    assert made == []
    classes["Named"](1.0, name="n")
    classes["Named"](2.0, name="n")
    assert sorted(made) == ["Named", "Point"]


def test_two_threads_may_use_a_class_for_the_first_time() -> None:
    count = 8
    for _ in range(50):
        point, barrier = family(lazy)["Named"], Barrier(count)

        def make(number: int, point: Any = point, barrier: Barrier = barrier) -> float:
            barrier.wait()
            return float(point(number, name="n").sum)

        with ThreadPoolExecutor(count) as pool:
            assert list(pool.map(make, range(count))) == [2.0 + each for each in range(count)]
