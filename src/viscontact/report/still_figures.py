"""Still figures of the chapters of a report, as the table of figures has them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any
from xml.etree.ElementTree import Element

import xarray as xr
from matplotlib.figure import Figure

from viscontact.drawing import matplotlib
from viscontact.drawing.content.usefulness import is_of_use
from viscontact.drawing.figures import TABLE, Chapter
from viscontact.drawing.matplotlib.histories.history import history_with_load
from viscontact.drawing.matplotlib.histories.hysteresis import loops
from viscontact.drawing.svg.html import element
from viscontact.report.drawings import framed
from viscontact.results.run_axis import run_axis

#: Functions that differ from those of the command line.
_OWN: dict[str, Callable[..., Figure]] = {"history": history_with_load, "hysteresis": loops}


def still_figures(
    ds: xr.Dataset, chapter: Chapter, *, beside_interactive: bool = False, **how: Any
) -> Iterator[Element]:
    """Yield the figures of a chapter with headings, if some precede; or those not interactive."""
    entries = [
        each
        for each in TABLE
        if each.reported is not None
        and each.reported.chapter == chapter
        and each.of in ("both", run_axis(ds).name)
        and not (beside_interactive and each.reported.interactive)
        and is_of_use(each, ds)
    ]
    for number, entry in enumerate(entries):
        if number or beside_interactive:
            yield element("h3", entry.heading)
        draw = _OWN.get(entry.name) or getattr(matplotlib, entry.drawn_by)
        yield framed(partial(draw, ds, **how), entry.heading)
