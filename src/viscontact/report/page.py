"""A run as one page of HTML that needs nothing from outside."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from xml.etree.ElementTree import Element

import xarray as xr
from plotly.graph_objects import Figure

from viscontact.drawing.content.map import Maps, maps_if_any
from viscontact.drawing.plotly.histories import histories
from viscontact.drawing.plotly.loops import loops
from viscontact.drawing.plotly.pressure_map import outlines, pressure_map
from viscontact.drawing.plotly.sections import sections
from viscontact.drawing.svg.html import element
from viscontact.report import input_chapters, result_chapters
from viscontact.report.html_page import html_page
from viscontact.report.spots_chapter import spots_chapter
from viscontact.report.stress_chapter import stress_chapter
from viscontact.report.title_block import title_lines
from viscontact.report.verdict_chapter import verdict_chapter
from viscontact.results.run_axis import in_order, run_axis


def write_report(ds: xr.Dataset, path: str | Path, *, label: str = "") -> None:
    """Write a run as one page of HTML that needs nothing from outside.

    Parameters
    ----------
    ds : xarray.Dataset
        Result of `viscontact.simulate` or `viscontact.open_results`.
    path : path-like
        The file, by custom ending in ``.html``; an existing one is replaced.
    label : str, optional
        Name of the run among others whose cases have the same title.

    Raises
    ------
    ValueError
        If the result holds no instant.
    OSError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (6e-3, 6e-3))
    >>> ds = vc.simulate(vc.Paraboloid(0.01, 0.01), rubber, vc.step(1.0), grid, [0.0])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_report(ds, Path(folder) / "ball.html")
    ...     (Path(folder) / "ball.html").read_text(encoding="utf-8")[:15].lower()
    '<!doctype html>'
    """
    Path(path).write_text(report_page(ds, label=label), encoding="utf-8")


def report_page(ds: xr.Dataset, *, label: str = "") -> str:
    """Return a run as one page of HTML that needs nothing from outside.

    Parameters
    ----------
    ds : xarray.Dataset
        Result of `viscontact.simulate` or `viscontact.open_results`.
    label : str, optional
        Name of the run among others whose cases have the same title; the heading shows it after
        that title, or alone if it begins with it.

    Returns
    -------
    str
        The page: result, pressure map with a slider over time, sections, outlines, histories with
        error bands, inputs, geometry, material, accuracy, limits, versions, citation. It holds
        its own scripts, forbids itself any connection, and has its numbers as CSV files inside.

    Raises
    ------
    ValueError
        If the result holds no instant.
    """
    axis = run_axis(ds)
    if not ds.sizes.get(axis.name):
        raise ValueError(
            f"a report needs one {axis.row} at least, got a result without any; run it"
        )
    ds = in_order(ds)
    maps = maps_if_any(ds)
    over_run = *histories(ds), loops(ds)
    drawn = [*_over_surface(ds, maps), *chain(*over_run)]
    name = result_chapters.heading_of(ds, label)
    return html_page(name, _body(name, ds, maps, over_run), drawn)


def _over_surface(ds: xr.Dataset, maps: Maps | None) -> list[Figure]:
    """Figures of the pressure, from top to bottom; none without fields."""
    return [] if maps is None else [pressure_map(maps), *sections(ds, maps), outlines(maps)]


def _body(
    name: str, ds: xr.Dataset, maps: Maps | None, over_run: tuple[list[Figure], ...]
) -> Iterator[Element]:
    pressure = result_chapters.pressure_chapter(ds, maps)
    chapters = run_chapters(ds, pressure, result_chapters.history_chapter(ds, *over_run))
    yield element("noscript", element("p", "The figures of this page need JavaScript."))
    yield from title_lines(ds)
    yield result_chapters.opening(name, ds, {each.place: each.title for each in chapters})
    for each in chapters:
        yield element("section", element("h2", each.title), *each.parts, id=each.place)


@dataclass(frozen=True)
class Chapter:
    """Chapter of the report of a run: its place, to which a link leads, title and content."""

    place: str
    title: str
    parts: list[Element]


def run_chapters(
    ds: xr.Dataset, pressure: Iterable[Element], history: Iterable[Element]
) -> list[Chapter]:
    """Chapters of a run that have content, with those of pressure and history as given."""
    axis = run_axis(ds)
    speeds = () if axis.is_history else input_chapters.speed_table(ds)
    chapters = (
        ("allowable", "Allowable values", verdict_chapter(ds)),
        ("pressure", "Pressure", pressure),
        ("spots", "Contact spots", spots_chapter(ds)),
        ("stress", "Stress below the surface", stress_chapter(ds)),
        ("histories", axis.heading, chain(speeds, history)),
        ("inputs", "Inputs", input_chapters.inputs_chapter(ds)),
        ("geometry", "Geometry", input_chapters.geometry_chapter(ds)),
        ("material", "Material", input_chapters.material_chapter(ds)),
        ("accuracy", "Accuracy", input_chapters.accuracy_chapter(ds)),
        ("limits", "Limits of the theory", input_chapters.limits_chapter(ds)),
        ("about", "Versions and citation", input_chapters.about_chapter(ds)),
    )
    found = (Chapter(place, title, list(parts)) for place, title, parts in chapters)
    return [each for each in found if each.parts]
