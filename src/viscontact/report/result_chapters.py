"""Chapters of the page: headline, pressure, histories."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from urllib.parse import quote
from xml.etree.ElementTree import Element

import numpy as np
import xarray as xr
from plotly.graph_objects import Figure

from viscontact.drawing.content.along_run import along_run
from viscontact.drawing.content.history import load_names
from viscontact.drawing.content.map import Maps
from viscontact.drawing.content.section import Along, Lines, line_load, section
from viscontact.drawing.content.usefulness import is_of_use
from viscontact.drawing.figures import entry_of
from viscontact.drawing.plotly.panel_over_run import LINEAR, LOGARITHMIC
from viscontact.drawing.plotly.pressure_map import map_remarks
from viscontact.drawing.svg.html import element
from viscontact.report.limits import notices
from viscontact.report.page_elements import remark
from viscontact.report.still_figures import still_figures
from viscontact.results.contact_spots import last_spots
from viscontact.results.formatting import format_scalar
from viscontact.results.history_csv import write_history
from viscontact.results.last_cycle_values import worst_notes
from viscontact.results.recorded_events import recorded_events
from viscontact.results.recorded_motion import motion_axis
from viscontact.results.run_axis import run_axis
from viscontact.results.shown_scalars import shown_labels
from viscontact.results.summary import headline
from viscontact.results.variables import MESH_DEPENDENT, Place
from viscontact.units.formatting import format_quantity


def title_of(ds: xr.Dataset) -> str:
    """Title of a run."""
    return str(ds.attrs.get("title") or "Contact of a creeping body")


def heading_of(ds: xr.Dataset, label: str) -> str:
    """Heading of a run: its title, with a label if several runs have that title."""
    title = title_of(ds)
    if not label:
        return title
    return label if label.startswith(title) else f"{title} ({label})"


def opening(name: str, ds: xr.Dataset, chapters: dict[str, str]) -> Element:
    """Head of the page: title, result in a sentence, notices, key results, links."""
    links = (element("a", title, href=f"#{place}") for place, title in chapters.items())
    return element(
        "header",
        element("h1", name),
        element("p", _unbroken(headline(ds)), class_="headline"),
        *(element("p", text, class_="notice") for text in notices(ds)),
        _facts(ds),
        element("nav", *links, aria_label="Chapters"),
    )


def pressure_part(ds: xr.Dataset, maps: Maps | None, figures: list[Figure]) -> Iterator[Element]:
    """Yield map, sections and other figures of the pressure, or why there are none."""
    if maps is None:
        yield remark(_without_fields(ds))
        return
    yield _map(maps)
    yield element("h3", "Sections through the pressure")
    # Nothing varies along a single cell.
    axes: list[Along] = [axis for axis in ("x", "y") if ds.sizes[axis] > 1]
    lines, unit = [section(maps, axis) for axis in axes], maps.window.unit
    sections = (_lines(maps, each, f"{each.title}, {each.place(unit)}") for each in lines)
    yield element("div", *sections, class_="pair")
    if is_of_use(entry_of("line-load"), ds):
        lines.append(line_load(maps))
        yield _lines(maps, lines[-1], lines[-1].title)
    yield element(
        "p",
        f"Bold: the {maps.snapshots[0].axis.row} of the slider.",
        " Full marker: leading edge, hollow: trailing edge." if maps.moves else None,
        element(
            "span",
            " Drag over a figure to enlarge a part of it, double-click to go back.",
            id="zoom-hint",
        ),
        class_="faint",
    )
    placed = {"map", *(each.name for each in lines)}
    for about in (each.layout.meta for each in figures if each.layout.meta["name"] not in placed):
        yield element("h3", about["title"])
        yield element("figure", element("div", "", id=about["name"], class_="plot"))
    yield from still_figures(ds, "pressure", beside_interactive=True)


def spots_chapter(ds: xr.Dataset) -> Iterator[Element]:
    """Yield number and sizes of the contact spots; nothing for a contact of one spot."""
    if found := last_spots(ds):
        yield element("p", f"{found.text[0].upper()}{found.text[1:]}.")
        yield from still_figures(ds, "spots")


def friction_part(ds: xr.Dataset, figures: list[Figure]) -> Iterator[Element]:
    """Yield friction over speed; over a single one its point, or why there is no friction."""
    yield from (element("figure", panel(each), class_="single") for each in figures)
    yield from still_figures(ds, "friction", beside_interactive=bool(figures))


def history_part(ds: xr.Dataset, figures: list[Figure]) -> Iterator[Element]:
    """Yield the panels of load and motion, and of the contact's response."""
    csv = io.StringIO()
    write_history(ds, csv)
    yield element(
        "div",
        _scale_button(ds),
        _download("Download the history (CSV)", "history.csv", csv.getvalue()),
        class_="downloads",
    )
    if figures:
        yield from _load_and_response(ds, figures)
    yield from still_figures(ds, "histories", beside_interactive=True)


def _load_and_response(ds: xr.Dataset, figures: list[Figure]) -> Iterator[Element]:
    given = {f"history-{name}" for name in load_names(ds)}
    load, response = (
        [each for each in figures if (each.layout.meta["name"] in given) == is_load]
        for is_load in (True, False)
    )
    yield element("h3", "Load" if motion_axis(ds) is None else "Load and motion")
    yield element("div", *map(panel, load), class_="panels")
    yield element("h3", "Contact")
    yield element("div", *map(panel, response), class_="panels")
    legend = "Shaded: the error of each value. "
    if any(each.layout.meta["note"] == MESH_DEPENDENT for each in response):
        legend += "A value that depends on the mesh is not drawn; its error in the CSV is inf. "
    for number, event in enumerate(recorded_events(ds), start=1):
        legend += f"Dotted line {number}: {event.text}. "
    yield remark(legend + "All numbers are in the CSV file, in SI units.")


def loop_part(ds: xr.Dataset, figures: list[Figure]) -> Iterator[Element]:
    """Yield loops of a run."""
    if figures:
        yield element("h3", entry_of("hysteresis").heading)
        yield element("div", *map(_loop, figures), class_="panels")
    yield from still_figures(ds, "loops", beside_interactive=True)


def _facts(ds: xr.Dataset) -> Element:
    return element(
        "dl",
        *(
            element(
                "div",
                element("dt", _unbroken(label + where)),
                element(
                    "dd",
                    _unbroken(format_scalar(ds, scalar, index)),
                    *(
                        element("small", _unbroken(note), class_="worst")
                        for note in worst_notes(ds, scalar, index)
                    ),
                ),
            )
            for scalar, label in shown_labels(ds, Place.FACTS).items()
            for index, where in (_fact(ds, scalar),)
        ),
        class_="facts",
    )


#: Relative change below which a value is the same at all speeds.
_CONSTANT = 1e-9


def _fact(ds: xr.Dataset, name: str) -> tuple[int, str]:
    """Row of a result at the head of the page, and its place: the end, or the worst speed."""
    axis = run_axis(ds)
    if not axis.is_history:
        sizes = np.nan_to_num(np.abs(ds[name].values))
        index = int(sizes.argmax())
        if ds.sizes["speed"] > 1 and np.ptp(sizes) <= _CONSTANT * sizes[index]:
            return index, ""
        place = axis.place(float(ds["speed"][index]))
        return index, f" at {place}" if ds.sizes["speed"] == 1 else f", largest at {place}"
    area = ds["contact_area"].values
    if area[-1] > 0:
        return -1, ""
    last = int(area.argmax())
    return last, f" at t = {format_quantity(float(ds['time'][last]), 's')}"


def _unbroken(text: str) -> str:
    """Put no-break spaces between numbers and units, within "t = 1 s", and after ±."""
    spaces = r"(?<=[±=]) (?=\d)|(?<=\bt) (?==)|(?<=\d) (?=[a-zA-Zµ²]{1,4}\b)"
    return re.sub(spaces, "\N{NO-BREAK SPACE}", text)


def _without_fields(ds: xr.Dataset) -> str:
    if "pressure" in ds:
        return "The bodies do not touch at any instant whose fields are stored: there is no map."
    return (
        "No fields are stored with this result, so there are no map, no sections and no outlines. "
        "Run again with output.fields: all, or with a list, to have them."
    )


#: Words of the button that changes the colours of the map.
_OWN_SCALE = "A scale for each"
_SCALES = {"data_each": _OWN_SCALE, "data_all": "One scale for all"}


def _map(maps: Maps) -> Element:
    count = len(maps.snapshots)
    slider = element(
        "input",
        type="range",
        id="slider",
        min="0",
        max=str(count - 1),
        step="1",
        value=str(maps.start),
        aria_label="Place of the pressure map in the run",
    )
    controls = element(
        "div",
        element("button", "Play", type="button", id="play"),
        slider,
        element("output", "", id="instant", for_="slider", data_title="map"),
        element("button", _OWN_SCALE, type="button", id="map-scale", **_SCALES),
        class_="controls",
    )
    account = element("span", "", data_note="map")
    caption = element("figcaption", account, f". {map_remarks(maps)}")
    return element(
        "figure", controls, element("div", "", id="map", class_="plot"), caption, class_="map"
    )


def _lines(maps: Maps, lines: Lines, title: str) -> Element:
    return element(
        "figure",
        element("p", title, class_="panel-title"),
        element("div", "", id=lines.name, class_="plot"),
        _download("Download (CSV)", f"{lines.name}.csv", lines_csv(maps, lines)),
    )


def _scale_button(ds: xr.Dataset) -> Element | None:
    """Button that shows the other scale of time or speed, where there is one."""
    axis = along_run([ds])
    if not axis.has_choice:
        return None
    shown, name = LINEAR if axis.scale == "linear" else LOGARITHMIC, axis.quantity.lower()
    words = {
        "data_linear": f"Show linear {name}",
        "data_log": f"Show logarithmic {name}",
    }
    text = words["data_log" if shown == LINEAR else "data_linear"]
    return element("button", text, type="button", id="time-scale", data_shown=shown, **words)


def panel(figure: Figure) -> Element:
    """Place of an interactive figure below its title."""
    about = figure.layout.meta
    note = element("span", f" ({about['note']})") if about["note"] else None
    return element(
        "div",
        element("p", about["title"], note, class_="panel-title"),
        element("div", "", id=about["name"], class_="plot"),
    )


def _loop(figure: Figure) -> Element:
    about = figure.layout.meta
    return element(
        "figure",
        element("p", about["title"], class_="panel-title"),
        element("div", "", id=about["name"], class_="plot"),
        element("figcaption", about["note"]),
    )


def _download(text: str, name: str, content: str) -> Element:
    source = f"data:text/csv;charset=utf-8,{quote(content)}"
    return element("a", text, class_="download", download=name, href=source)


def lines_csv(maps: Maps, lines: Lines) -> str:
    """Write positions and a column for each instant [SI], with the place of a moving line."""
    other = "y" if lines.along == "x" else "x"
    places = [f", {other} = {at!r} m" if maps.moves else "" for at in lines.crossings]
    heads = [
        f"{lines.quantity.lower()} at {each.time!r} {each.axis.unit}{place} [{lines.si}]"
        for each, place in zip(maps.snapshots, places or [""] * len(maps.maps), strict=True)
    ]
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow([f"{lines.along} [m]", *heads])
    columns = [lines.positions.tolist(), *(values.tolist() for values in lines.values)]
    writer.writerows(zip(*columns, strict=True))
    return file.getvalue()
