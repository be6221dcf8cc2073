"""A run as one page of HTML that needs nothing from outside."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from pathlib import Path
from xml.etree.ElementTree import Element

import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.map import maps_if_any
from viscontact.drawing.figures import Chapter as FigureChapter
from viscontact.drawing.plotly.run_figures import run_figures
from viscontact.drawing.svg.html import element
from viscontact.report import input_chapters, result_chapters
from viscontact.report.creepage_table import creepage_table
from viscontact.report.end_chapter import end_chapter
from viscontact.report.html_page import html_page
from viscontact.report.leak_chapter import leak_chapter
from viscontact.report.slip_chapter import slip_chapter
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
    figures = run_figures(ds, maps)
    shown: dict[FigureChapter, Iterable[Element]] = {
        "pressure": result_chapters.pressure_part(ds, maps, figures["pressure"]),
        "friction": result_chapters.friction_part(ds, figures["friction"]),
        "histories": result_chapters.history_part(ds, figures["histories"]),
        "loops": result_chapters.loop_part(ds, figures["loops"]),
    }
    name = result_chapters.heading_of(ds, label)
    return html_page(name, _body(name, ds, shown), [*chain(*figures.values())])


def _body(
    name: str, ds: xr.Dataset, shown: Mapping[FigureChapter, Iterable[Element]]
) -> Iterator[Element]:
    chapters = run_chapters(ds, shown)
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


def run_chapters(ds: xr.Dataset, shown: Mapping[FigureChapter, Iterable[Element]]) -> list[Chapter]:
    """Chapters of a run that have content, with the figures that differ from page to paper."""
    over_run = shown["histories"], shown["loops"]
    chapters = (
        ("allowable", "Allowable values", verdict_chapter(ds)),
        ("pressure", "Pressure", shown["pressure"]),
        ("ends", "Ends of the bodies", end_chapter(ds)),
        ("spots", "Contact spots", result_chapters.spots_chapter(ds)),
        ("leakage", "Leakage", leak_chapter(ds)),
        ("stress", "Stress below the surface", stress_chapter(ds)),
        ("slip", "Friction", slip_chapter(ds)),
        (
            *("histories", run_axis(ds).heading),
            chain(
                shown["friction"],
                input_chapters.speed_table(ds),
                creepage_table(ds),
                *over_run,
            ),
        ),
        ("inputs", "Inputs", input_chapters.inputs_chapter(ds)),
        ("geometry", "Geometry", input_chapters.geometry_chapter(ds)),
        ("material", "Material", input_chapters.material_chapter(ds)),
        ("accuracy", "Accuracy", input_chapters.accuracy_chapter(ds)),
        ("limits", "Limits of the theory", input_chapters.limits_chapter(ds)),
        ("about", "Versions and citation", input_chapters.about_chapter(ds)),
    )
    found = (Chapter(place, title, list(parts)) for place, title, parts in chapters)
    return [each for each in found if each.parts]
