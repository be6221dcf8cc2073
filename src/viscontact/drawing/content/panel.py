"""Panels of curves as plain data: what is drawn, in which units and ranges, and what is noted.

A figure is made in two steps. A function of this room takes results, and decides everything that a
reader sees: which panels there are, their axes, units and ranges, curves with their errors, marks
and notes. It returns panels. A renderer draws them: Matplotlib, Plotly or SVG. It chooses colours,
fonts and places only. All numbers are in SI; each axis has the unit in which they are drawn.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal, get_args

from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.formatting import ReadableUnit, readable_unit

#: Choice of a unit: called with an SI unit and values [SI], as `readable_unit` is.
Units = Callable[..., ReadableUnit]

#: Part per cent, of values without unit.
PERCENT = ReadableUnit("%", 0.01)


@dataclass(frozen=True)
class Axis:
    """Axis of a panel: quantity, unit, range and scale."""

    quantity: str
    unit: ReadableUnit
    limits: tuple[float, float] | None = None  # [SI]; None: around what is drawn
    #: "time" is logarithmic from the first step on, with the instant 0 at its beginning.
    scale: Literal["linear", "log", "time"] = "linear"
    first: float = 0.0  # instant [s] or speed [m/s] from which a logarithmic scale goes
    in_clock_units: bool = False  # hours and days are marked on a logarithmic scale of times
    has_choice: bool = False  # a reader may choose between a linear and a logarithmic scale
    texts: tuple[str, ...] = ()  # at 0, 1, 2, ... in place of numbers
    is_reversed: bool = False  # with the largest value at the origin

    @classmethod
    def of(cls, quantity: str, si: str, *values: ArrayLike, units: Units = readable_unit) -> Axis:
        """Linear axis for values of an SI unit."""
        return cls(quantity, units(si, *values))

    @classmethod
    def over_decades(cls, quantity: str, si: str, low: float, high: float) -> Axis:
        """Logarithmic axis between two ends above 0 [SI], in the unit of its middle."""
        unit = readable_unit(si, math.sqrt(low * high))
        return cls(quantity, unit, (low, high), "log", first=low)

    @classmethod
    def between(cls, quantity: str, si: str, low: float, high: float) -> Axis:
        """Linear axis between two ends [SI]."""
        return cls(quantity, readable_unit(si, low, high), (low, high))

    @property
    def label(self) -> str:
        """Quantity with its unit."""
        return self.unit.label(self.quantity)


def spans_decades(low: float, high: float) -> bool:
    """Return whether an axis from one value to another is logarithmic: from a ratio of 10 on."""
    return high > 10 * low


@dataclass(frozen=True)
class Ink:
    """Colour of a curve by its meaning; each renderer has its own shades."""

    # "run" is one of several different things, by its number from 0; "ordered" one of a sequence,
    # by its place from 0 (first) to 1 (last); "fit" what was fitted to measured points; "pale"
    # what is set aside; "temperature" one of several, by its place from 0 (cold) to 1 (warm);
    # "beyond" what exceeds its limit.
    kind: Literal["run", "ordered", "fit", "faint", "pale", "text", "temperature", "beyond"] = "run"
    place: float = 0


#: What is shown, what is compared with it, lines of less importance, what is set aside, and text.
FIRST, SECOND, FAINT, PALE, TEXT = Ink(), Ink(place=1), Ink("faint"), Ink("pale"), Ink("text")


#: Lines: "thin" guides the eye between markers, "beyond" continues a line where it is less certain.
LineLook = Literal["line", "bold", "thin", "dashed", "beyond", "dotted"]
#: Markers: full, on a line ("joined") or not; without or with a filling in white ("hollow",
#: "white"), on a thin line ("linked"); other ones; edges of a moving contact; bars from 0.
MarkLook = Literal[
    "joined",
    "linked",
    "points",
    "hollow",
    "white",
    "cross",
    "square",
    "leading",
    "trailing",
    "bars",
]


@dataclass(frozen=True, eq=False)
class Curve:
    """Curve or points in the order in which they are joined [SI]; NaN interrupts a line."""

    x: Floats
    y: Floats
    name: str = ""  # in the legend
    ink: Ink = FIRST
    look: LineLook | MarkLook = "line"
    #: Half widths: bands along a line, bars at markers; NaN where unknown, inf on the mesh.
    error: Floats | None = None
    error_x: Floats | None = None
    texts: tuple[str, ...] = ()  # of the points, below a pointer
    symbol: int = 0  # of markers: different sources or quantities have different ones
    is_fine: bool = False  # among many: small markers and thin lines
    has_spaced_markers: bool = False  # has only markers that are apart from each other
    is_on_top: bool = False  # above other curves and the border, which does not cut it

    @property
    def is_line(self) -> bool:
        """True for a line without markers."""
        return self.look in get_args(LineLook)


@dataclass(frozen=True, eq=False)
class ShadedRange:
    """Range along the horizontal axis [SI], such as that of most samples."""

    x: Floats
    low: Floats
    high: Floats
    name: str = ""
    ink: Ink = FIRST


@dataclass(frozen=True)
class Mark:
    """Line across a panel at a place on one of its axes [SI], with a text."""

    place: float
    axis: Literal["x", "y"] = "x"
    text: str = ""
    #: Ticks and crosses are at the border only.
    look: Literal["line", "dashed", "dotted", "tick", "cross"] = "line"
    ink: Ink = FAINT
    is_text_below: bool = False  # of a line at a place on the vertical axis


@dataclass(frozen=True, eq=False)
class Aside:
    """Curve on an axis of its own, at the right of a panel, behind its curves."""

    axis: Axis
    curve: Curve


@dataclass(frozen=True, eq=False)
class Panel:
    """Panel of a figure."""

    x: Axis
    y: Axis
    curves: tuple[Curve, ...] = ()
    bands: tuple[ShadedRange, ...] = ()
    marks: tuple[Mark, ...] = ()
    shaded: tuple[float, float] | None = None  # range on the horizontal axis [SI]
    title: str = ""
    note: str = ""  # remark beside the title
    in_place: str = ""  # text in place of curves that are not drawn
    name: str = ""  # identifies the panel, such as a scalar
    aside: Aside | None = None
