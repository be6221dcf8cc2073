"""Table of figures: the names and what each takes.

A new figure is a row of `TABLE`. The command line and its help, the calculator page,
`ds.viscontact.plot`, and `FIGURES`, `STEADY_FIGURES` and `COMPARISONS` of `viscontact.plot` read
it. It imports no plotting library, so that the command line can print the names at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class FigureEntry:
    """Figure by its name on the command line."""

    name: str
    function: str = ""  # of viscontact.plot; by default the name
    compare: str = ""  # function of viscontact.plot that draws several runs
    #: Runs over time, over speed, or both; "sweep" for a figure of many runs.
    of: Literal["time", "speed", "both", "sweep"] = "time"
    #: Keywords beside `width`: "times" or "speeds", options of the command line, "progress".
    takes: tuple[str, ...] = ("times",)
    at_instants: bool = False  # fields of the stored instants or speeds next to the given ones
    any_time: bool = False  # its times may lie outside the run
    is_animation: bool = False

    @property
    def method(self) -> str:
        """Name of the method of `ds.viscontact.plot`."""
        return self.name.replace("-", "_")

    @property
    def drawn_by(self) -> str:
        """Name of the function of `viscontact.plot`."""
        return self.function or self.method


def _fields(name: str, function: str = "", compare: str = "", *options: str) -> FigureEntry:
    """Entry of a figure of fields at single instants or speeds."""
    return FigureEntry(name, function, compare, "both", ("times", *options), at_instants=True)


TABLE = (
    _fields("pressure-map", "", "compare_pressure_maps", "style"),
    _fields("pressure-profile", "", "compare_pressure_profiles", "along", "at"),
    _fields("pressure-radial"),
    _fields("line-load", "", "compare_line_loads"),
    _fields("pressure-3d", "pressure_surface", "compare_pressure_surfaces"),
    _fields("surface-3d", "deformed_surface"),
    _fields("contact-outline", "", "compare_contact_outlines"),
    FigureEntry("contact-area"),
    _fields("contact-spots"),
    FigureEntry("history", compare="compare_histories"),
    FigureEntry("hysteresis", compare="compare_hysteresis"),
    FigureEntry("creep", compare="compare_creep", of="both", any_time=True),
    FigureEntry("exact"),
    _fields("stress-section", "", "", "progress"),
    FigureEntry(
        *("von-mises", "von_mises_history", "compare_von_mises", "time", ("times", "progress")),
        at_instants=True,
    ),
    _fields("indenter"),
    FigureEntry("friction", of="speed", takes=()),
    FigureEntry("motion-profile", of="speed", takes=("speeds", "at"), at_instants=True),
    FigureEntry("animation", takes=("times", "seconds", "fps"), is_animation=True),
    FigureEntry("response", of="sweep", takes=()),
)


def names_of(*of: str) -> list[str]:
    """Names of the figures of some kinds of runs, without animations."""
    return [each.name for each in TABLE if each.of in of and not each.is_animation]


def compared_names() -> list[str]:
    """Names of the figures that draw several runs."""
    return [each.name for each in TABLE if each.compare]


def entry_of(name: str) -> FigureEntry:
    """Entry of a figure by its name."""
    return next(each for each in TABLE if each.name == name)
