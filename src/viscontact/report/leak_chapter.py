"""Chapter of a report on the leakage that its case asks for."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal
from xml.etree.ElementTree import Element

import xarray as xr

from viscontact.drawing.matplotlib.histories.leak_rate import leak_rate
from viscontact.drawing.matplotlib.pressure.leak_channel import leak_channel
from viscontact.report.page_elements import drawn_figure, listed, remark
from viscontact.results.leakage.of_case import case_leakage, leakage_lines
from viscontact.results.run_axis import run_axis


def leak_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield what leaks at the last instant, its channel, and the leak rate over the run."""
    lines = leakage_lines(ds)
    if not lines:
        return
    found = listed(lines)
    if found is not None:
        yield found
    try:
        leak = case_leakage(ds)
    except ValueError:  # the line says why
        return
    assert leak is not None  # there are lines
    along: Literal["x", "y"] = "y" if leak.attrs["along"] == "y" else "x"
    channel = leak_channel(ds, along=along)
    yield drawn_figure(channel, "Flow of the fluid at the last stored instant.")
    if leak.sizes[run_axis(leak).name] > 1:
        rate = leak_rate(leak, along=along)
        yield drawn_figure(rate, "Leak rate and gaps at the stored instants.")
    for change in str(leak.attrs["changes"]).splitlines():
        yield remark(f"The contact {change}.")
    for note in str(leak.attrs["warnings"]).splitlines():
        yield remark(note)
    yield remark(
        "Critical gap: at the narrowest place of the widest channel. Effective gap: of parallel "
        "plates through which as much would leak. The fluid does not push the bodies apart."
    )
