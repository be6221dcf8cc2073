"""Table of figures: their names, what each takes, what draws it, and its place in reports.

A new figure is a row of `TABLE`. The command line and its help, `ds.viscontact.plot`, `FIGURES`,
`STEADY_FIGURES` and `COMPARISONS` of `viscontact.plot`, reports in HTML and PDF, and the calculator
page read it. It imports no plotting library, so that the command line can print the names at once.
"""

from __future__ import annotations

from functools import partial
from typing import Literal

from viscontact.backend.lazy_dataclass import dataclass

#: Chapters of the report of a run, and of the calculator page, which has interactive figures only;
#: those of "spots", "stress" and "slip" follow a sentence of the report, and are still.
Chapter = Literal["pressure", "friction", "histories", "loops", "spots", "stress", "slip"]


@dataclass(frozen=True)
class Reported:
    """Place of a figure in reports and on the calculator page."""

    chapter: Chapter
    heading: str
    #: Function among those of `drawing/plotly/run_figures.py`. Reports in HTML and the page show
    #: its figures; without it, reports in HTML have the still figure, as those in PDF do.
    interactive: str = ""
    #: Test among those of `drawing/content/usefulness.py`, if it is of use for some results only.
    of_use: str = ""


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
    over_creepage: bool = False  # of all creepages, where each has a contact of its own, too
    any_time: bool = False  # its times may lie outside the run
    is_animation: bool = False
    reported: Reported | None = None  # None: neither in reports nor on the page

    @property
    def method(self) -> str:
        """Name of the method of `ds.viscontact.plot`."""
        return self.name.replace("-", "_")

    @property
    def drawn_by(self) -> str:
        """Name of the function of `viscontact.plot`."""
        return self.function or self.method

    @property
    def heading(self) -> str:
        """Heading in reports and on the page; empty where it is in neither."""
        return self.reported.heading if self.reported else ""


#: Entry of a figure of fields at single instants or speeds.
_fields = partial(FigureEntry, of="both", at_instants=True)

TABLE = (
    _fields(
        "pressure-map",
        compare="compare_pressure_maps",
        takes=("times", "style", "scale"),
        reported=Reported("pressure", "Pressure", "pressure_map"),
    ),
    _fields(
        "pressure-profile",
        compare="compare_pressure_profiles",
        takes=("times", "along", "at"),
        reported=Reported("pressure", "Section through the pressure", "sections"),
    ),
    _fields("pressure-radial"),
    _fields(
        "line-load",
        compare="compare_line_loads",
        reported=Reported(
            "pressure",
            "Line load along x: the pressure integrated over y",
            "line_loads",
            of_use="has_line_load",
        ),
    ),
    _fields("pressure-3d", function="pressure_surface", compare="compare_pressure_surfaces"),
    _fields("surface-3d", function="deformed_surface"),
    _fields(
        "contact-outline",
        compare="compare_contact_outlines",
        reported=Reported("pressure", "Outline of the contact", "outlines", of_use="has_outline"),
    ),
    FigureEntry("contact-area", takes=("times", "theory")),
    FigureEntry("area-pressure", takes=("times", "theory")),
    _fields(
        "contact-spots", takes=("times", "theory"), reported=Reported("spots", "Contact spots")
    ),
    _fields("leak-channel", takes=("times", "along")),
    _fields("fluid-pressure", takes=("times", "along")),
    _fields("leak-rate", takes=("times", "along", "over")),
    FigureEntry(
        "history",
        compare="compare_histories",
        reported=Reported("histories", "History", "histories"),
    ),
    FigureEntry(
        "hysteresis",
        compare="compare_hysteresis",
        reported=Reported("loops", "Loops", "loops", of_use="has_loops"),
    ),
    FigureEntry("creep", compare="compare_creep", of="both", any_time=True),
    FigureEntry("exact"),
    _fields(
        "stress-section",
        takes=("times", "progress"),
        reported=Reported("stress", "Von Mises stress"),
    ),
    _fields(
        "von-mises",
        function="von_mises_history",
        compare="compare_von_mises",
        of="time",
        takes=("times", "progress"),
    ),
    _fields("indenter"),
    _fields(
        "stick-map",
        takes=("times",),
        reported=Reported("slip", "Sticking and slipping cells", of_use="has_stored_slip"),
    ),
    _fields(
        "traction-profile",
        takes=("times", "along", "at"),
        reported=Reported("slip", "Section through the tractions", of_use="has_stored_slip"),
    ),
    FigureEntry(
        "force-curve",
        reported=Reported("histories", "Force over approach", of_use="has_force_curve"),
    ),
    FigureEntry(
        "fretting-loop",
        reported=Reported("slip", "Force over shift", of_use="has_shift"),
    ),
    FigureEntry("slip-history", reported=Reported("slip", "Slip over time", of_use="has_slip")),
    FigureEntry(
        "friction",
        of="speed",
        compare="compare_frictions",
        takes=("theory",),
        reported=Reported("friction", "Friction coefficient over speed", "friction"),
    ),
    FigureEntry(
        "traction-creepage",
        of="speed",
        takes=(),
        over_creepage=True,
        reported=Reported(
            "friction", "Traction over creepage", "traction_creepage", of_use="has_creepages"
        ),
    ),
    _fields(
        "motion-profile",
        of="speed",
        takes=("speeds", "at"),
        reported=Reported("histories", "Pressure along the motion"),
    ),
    FigureEntry("animation", takes=("times", "seconds", "fps"), is_animation=True),
    FigureEntry("response", of="sweep", takes=()),
    FigureEntry("pull-off", of="sweep", takes=()),
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
