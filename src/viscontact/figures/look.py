"""Colours, units and common parts of interactive figures."""

from __future__ import annotations

import base64
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import plotly.graph_objects as go
from matplotlib import colormaps
from matplotlib.colors import to_hex
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Singles
from viscontact.results.formatting import format_with_error, format_with_error_in
from viscontact.units.formatting import ReadableUnit, format_number, without_trailing_zeros
from viscontact.units.systems import AUTOMATIC, unit_in

#: A trace, an axis or a frame, as Plotly reads them.
Part = dict[str, Any]

#: Steps of a pressure on a page: far finer than its colours.
STEPS = 65535
_FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, Arial, sans-serif"


@dataclass(frozen=True)
class Look:
    """Colours and system of units of a figure."""

    ink: str
    faint: str  # text of less importance
    line: str  # lines of less importance
    edge: str  # borders
    grid: str
    card: str  # background
    blue: str  # what is shown
    band: str  # its error
    warm: str  # what is compared with it
    early: float  # ends of the colours of instants in viridis
    late: float
    system: str = AUTOMATIC

    def unit(self, si: str, *values: ArrayLike) -> ReadableUnit:
        """Return the unit of values in SI."""
        return unit_in(self.system, si, *values)

    def text(self, value: float, error: float, si: str) -> str:
        """Return a value with its error, both in SI, and its unit."""
        if self.system == AUTOMATIC or math.isinf(error):
            return format_with_error(value, error, si)
        unit = self.unit(si, value)
        return f"{format_with_error_in(unit, value, error)} {unit.symbol}".rstrip()

    def quantity(self, value: float, si: str) -> str:
        """Return a value in SI with its unit, without trailing zeros."""
        unit = self.unit(si, value)
        number = without_trailing_zeros(format_number(value / unit.factor))
        return f"{number} {unit.symbol}".rstrip()

    def instants(self, count: int) -> list[str]:
        """Colours of instants, from early to late."""
        return [
            to_hex(each) for each in colormaps["viridis"](np.linspace(self.early, self.late, count))
        ]

    @cached_property
    def template(self) -> Part:
        """What all figures share, as a template of Plotly."""
        axis = {
            "color": self.ink,
            "gridcolor": self.grid,
            "zeroline": False,
            "zerolinecolor": self.edge,
            "linecolor": self.edge,
            "ticks": "outside",
            "ticklen": 3,
            "tickfont": {"size": 11},
            "title": {"standoff": 8, "font": {"size": 12}},
            "automargin": True,
        }
        clear = "rgba(0,0,0,0)"
        return {
            "layout": {
                "font": {"family": _FONT, "color": self.ink},
                "margin": {"l": 50, "r": 24, "t": 12, "b": 42},
                "paper_bgcolor": clear,
                "plot_bgcolor": clear,
                "showlegend": False,
                "hoverlabel": {
                    "bgcolor": self.card,
                    "bordercolor": self.edge,
                    "font": {"color": self.ink},
                },
                "modebar": {"bgcolor": clear, "color": self.faint, "activecolor": self.ink},
                "xaxis": axis,
                "yaxis": axis,
            }
        }


LIGHT = Look(
    ink="#262626",
    faint="#5f6670",
    line="#9aa3ab",
    edge="#8a939c",
    grid="#e8ecef",
    card="#ffffff",
    blue="#0072b2",
    band="rgba(0,114,178,0.22)",
    warm="#c2410c",
    early=0.0,
    late=0.85,
)
DARK = Look(
    ink="#e4e7ea",
    faint="#9ba5af",
    line="#6b7680",
    edge="#6b7680",
    grid="#2a3036",
    card="#1a1e22",
    blue="#5ab4e5",
    band="rgba(90,180,229,0.24)",
    warm="#f2a065",
    early=0.3,
    late=1.0,
)


def drawn(
    traces: Sequence[Part], look: Look, meta: Part, *, frames: Sequence[Part] = (), **layout: Any
) -> go.Figure:
    """Make a figure; `meta` has its name, its title and what a page adds to it."""
    shared = {"template": look.template, "uirevision": "kept", "meta": meta}
    return go.Figure(list(traces), shared | layout, list(frames))


def plain(figure: go.Figure) -> Part:
    """Return a figure as data for JSON: traces, layout, frames.

    Maps, which are most of a page, are packed in steps of their largest value, two bytes each; the
    step is beside them, and 0 is no value. `linked.js` unpacks them.
    """
    made: Part = figure.to_dict()
    frames = made.get("frames", ())
    for part in (*made["data"], *(part for frame in frames for part in frame["data"])):
        if part.get("type") == "heatmap":
            part["z"] = _in_steps(part["z"], made["data"][0]["zmax"] / STEPS)
    return made


def _in_steps(packed: Part, step: float) -> Part:
    """Values in four bytes each as steps in two bytes each; small ones do not vanish."""
    values = np.frombuffer(base64.b64decode(packed["bdata"]), "<f4")
    steps = np.where(np.isnan(values), 0.0, np.maximum(np.rint(values / step), 1.0))
    written = base64.b64encode(steps.astype("<u2").tobytes()).decode("ascii")
    return packed | {"dtype": "u2", "bdata": written, "step": step}


def numbers(values: ArrayLike) -> Singles:
    """Numbers to seven digits, which a page holds in four bytes each; NaN interrupts a line."""
    found = np.asarray(values, dtype=np.float32)
    # Plotly packs no empty array; a single NaN draws nothing either.
    return found if found.size else np.full(1, np.nan, dtype=np.float32)


def words(text: str, look: Look) -> Part:
    """Words in place of a curve."""
    centre = {"xref": "paper", "yref": "paper", "x": 0.5, "y": 0.5}
    return {"text": text, "showarrow": False, "font": {"size": 12, "color": look.faint}} | centre
