"""Largest von Mises stress below the contact, and its depth, over time."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.along_run import along_run
from viscontact.drawing.content.notes import peak_note
from viscontact.drawing.content.ordered_names import inks_of
from viscontact.drawing.content.panel import Axis, Curve, LineLook, MarkLook, Panel
from viscontact.drawing.content.stress_planes import stress_sections
from viscontact.mechanics.halfspace.stress_lines import Progress, part_of
from viscontact.results.run_axis import require_time
from viscontact.results.snapshots import field_times, take_snapshots
from viscontact.results.stress_source import stress_source

_NAME = "von-mises"
#: Largest number of separate markers, and height of an axis over its largest value.
_MARKED, _ABOVE = 40, 1.1


def von_mises_panels(
    runs: Mapping[str, xr.Dataset], times: ArrayLike | None, progress: Progress | None = None
) -> tuple[Panel, Panel]:
    """Panels of the largest stress on planes across the contact, and of its depth."""
    found = [
        _largest_stresses(run, times, part_of(progress, index, len(runs)))
        for index, run in enumerate(runs.values())
    ]
    instants = [each[0] for each in found]
    x = along_run(runs.values(), drawn=instants)
    looks: list[LineLook | MarkLook]
    looks = ["joined" if each.size <= _MARKED else "line" for each in instants]
    inks, note = inks_of(list(runs)), peak_note(runs.values(), np.concatenate(instants))

    def panel(row: int, quantity: str, si: str, title: str, note: str = "") -> Panel:
        curves = tuple(
            Curve(each[0], each[row], name, ink, look, is_on_top=True)
            for name, each, ink, look in zip(runs, found, inks, looks, strict=True)
        )
        values = np.concatenate([curve.y for curve in curves])
        y = Axis.of(quantity, si, values)
        top = _ABOVE * float(values.max()) or y.unit.factor
        y = Axis(quantity, y.unit, (0.0, top))
        return Panel(x, y, curves, title=title, note=note, name=quantity)

    return (
        panel(1, "Von Mises stress", "Pa", "largest below the contact", note),
        panel(2, "Depth", "m", "where it is the largest"),
    )


def _largest_stresses(
    run: xr.Dataset, times: ArrayLike | None, progress: Progress | None
) -> tuple[Floats, Floats, Floats]:
    """Instants [s], largest stress [Pa] and its depth [m]."""
    require_time(run, _NAME)
    chosen = field_times(run, _NAME) if times is None else times
    snapshots = take_snapshots(run, chosen, _NAME)
    sections = stress_sections(stress_source(run), snapshots, progress)
    stress, depth, _ = np.array([section.largest for section in sections]).T
    return np.array([section.time for section in sections]), stress, depth
