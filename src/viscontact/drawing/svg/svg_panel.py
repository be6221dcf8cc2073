"""Small drawings in SVG, in the colour of the text around them: for light pages and dark ones."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Literal
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Bools, Floats, Integers
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.look import BLUE
from viscontact.drawing.svg.html import element
from viscontact.drawing.svg.svg_axes import AxisScale, linear

_Path = list[tuple[float, float]]

WIDTH, _HEIGHT = 222, 158
_LEFT, _RIGHT, _TOP, _BOTTOM = 46, 12, 24, 36
#: Least and largest height of the axes of a map [px].
_HEIGHTS = 28.0, 190.0
#: Inside the axes [px].
ROOM = WIDTH - _LEFT - _RIGHT, _HEIGHT - _TOP - _BOTTOM
#: Width of a letter, about [px].
_LETTER = 6.2
_INK, _FAINT = "currentColor", "0.65"
#: Points of a path within this distance of the line between their neighbours are left out [px].
_FLAT = 0.03


@dataclass(frozen=True)
class SvgCurve:
    """Curve over the axes."""

    x: ArrayLike  # points [SI]; a gap where one is not finite
    y: ArrayLike
    #: A body is filled up to the top, the ground down to the bottom; a rim is a closed curve.
    kind: Literal["line", "body", "ground", "dots", "rim"] = "line"
    colour: str = BLUE
    dashed: bool = False


@dataclass(frozen=True, eq=False)
class ColouredCells:
    """Cells over the axes, in colours by their bands."""

    x: Floats  # centres at equal distances, but for the last [SI], shape (nx,)
    y: Floats  # shape (ny,)
    bands: Integers  # numbers of the colours, -1 for none; shape (nx, ny)
    colours: Sequence[str]


def panel(
    heading: str,
    x: AxisScale,
    y: AxisScale,
    marks: Iterable[SvgCurve],
    *,
    cells: ColouredCells | None = None,
    aside: str = "",
    height: int = _HEIGHT,
) -> Element:
    """Drawing of cells and curves over two axes; `height` in pixels."""
    frame = _Frame(x, y, height)
    parts = [] if cells is None else list(frame.areas(cells))
    parts += [part for mark in marks for part in frame.drawn(mark)]
    head = _text(4, 13, heading, font_weight="600")
    note = _text(WIDTH - _RIGHT, 13, aside, text_anchor="end", fill_opacity=_FAINT)
    return element(
        "svg",
        head,
        note if aside else None,
        *parts,
        *frame.axes(),
        viewBox=f"0 0 {WIDTH} {height}",
        width=str(WIDTH),
        height=str(height),
        role="img",
        aria_label=f"{heading}: {y.label} over {x.label}",
        style="font:11px system-ui,sans-serif;overflow:visible;max-width:100%",
        fill=_INK,
    )


def map_panel(
    heading: str,
    limits: tuple[tuple[float, float], tuple[float, float]],
    cells: ColouredCells,
    *,
    marks: Iterable[SvgCurve] = (),
    aside: str = "",
    stretch: float = 1.0,
    note: str = "",
) -> Element:
    """Map between limits of x and y [m], with a stretch of y; very low ones are stretched more."""
    x, y = limits
    height = ROOM[0] * stretch * (y[1] - y[0]) / (x[1] - x[0])
    # Room at both sides of a high map.
    more = max(height / _HEIGHTS[1] - 1.0, 0.0) * (x[1] - x[0]) / 2
    along = linear("x", "m", x[0] - more, x[1] + more)
    return panel(
        heading,
        replace(along, label="; ".join(filter(None, (along.label, note)))),
        linear("y", "m", *y, 3),
        marks,
        cells=cells,
        aside=aside,
        height=round(_TOP + _BOTTOM + min(max(height, _HEIGHTS[0]), _HEIGHTS[1])),
    )


@dataclass(frozen=True)
class _Frame:
    x: AxisScale
    y: AxisScale
    height: int

    @property
    def bottom(self) -> float:
        return self.height - _BOTTOM

    def across(self, places: Floats) -> Floats:
        return _LEFT + places * (WIDTH - _LEFT - _RIGHT)

    def up(self, places: Floats) -> Floats:
        return self.bottom - places * (self.bottom - _TOP)

    def areas(self, cells: ColouredCells) -> Iterable[Element]:
        """The cells of each colour, those next to each other in a row as one stroke."""
        across, up = self.across(self.x.place(cells.x)), self.up(self.y.place(cells.y))
        wide, high = (
            abs(float(at[1] - at[0])) if at.size > 1 else whole
            for at, whole in ((across, float(ROOM[0])), (up, self.bottom - _TOP))
        )
        for band, colour in enumerate(cells.colours):
            strokes = [
                f"M{across[run.start] - wide / 2:.1f},{at:.1f}h{(run.stop - run.start) * wide:.1f}"
                for at, row in zip(up, (cells.bands == band).T, strict=True)
                for run in _runs(row)
            ]
            look = {"stroke": colour, "stroke_width": f"{high + 0.1:.2f}", "class_": "cells"}
            if strokes:
                path = "".join(strokes)
                yield element("path", d=path, shape_rendering="crispEdges", **look)

    def drawn(self, mark: SvgCurve) -> Iterable[Element]:
        if mark.kind == "rim":
            across, up = self.across(self.x.place(mark.x)), self.up(self.y.place(mark.y))
            path = _path(list(zip(across.tolist(), up.tolist(), strict=True)))
            yield element("path", d=f"{path}Z", fill="none", stroke=_INK, class_="rim")
            return
        x, y = np.broadcast_arrays(self.x.place(mark.x), self.y.place(mark.y))
        inside = np.isfinite(x) & np.isfinite(y) & (x > -1e-9) & (x < 1 + 1e-9)
        across, up = self.across(x), self.up(np.clip(y, 0.0, 1.0))
        if mark.kind == "dots":
            for px, py in zip(across[inside], up[inside], strict=True):
                yield element("circle", cx=f"{px:.1f}", cy=f"{py:.1f}", r="2.2", fill=mark.colour)
            return
        if mark.kind != "line":
            yield self._fill_below([_thin(across[run], up[run]) for run in _runs(inside)], mark)
        if mark.kind != "ground":
            # Up to the first point beyond, which lies on the edge.
            near = inside & (_with_neighbours(y <= 1.0) & _with_neighbours(y >= 0.0))
            yield self._outline([_thin(across[run], up[run]) for run in _runs(near)], mark)

    def _fill_below(self, runs: list[_Path], mark: SvgCurve) -> Element:
        edge = _TOP if mark.kind == "body" else self.bottom
        closed = "".join(_path(run) + f"V{edge:g}H{run[0][0]:.1f}Z" for run in runs)
        return element("path", d=closed, fill_opacity="0.16" if mark.kind == "body" else "0.07")

    def _outline(self, runs: list[_Path], mark: SvgCurve) -> Element:
        is_body = mark.kind == "body"
        return element(
            "path",
            d="".join(self._outline_with_walls(run) if is_body else _path(run) for run in runs),
            fill="none",
            stroke=_INK if is_body else mark.colour,
            stroke_width="1.6",
            stroke_linejoin="round",
            class_="outline" if is_body else "curve",
            **({"stroke_dasharray": "4 3"} if mark.dashed else {}),
        )

    def _outline_with_walls(self, run: _Path) -> str:
        """The outline of a body with the walls at its ends."""
        (first, _), (last, _) = run[0], run[-1]
        before = f"M{first:.1f},{_TOP}V" if first > _LEFT + 1 else "M"
        after = f"V{_TOP}" if last < WIDTH - _RIGHT - 1 else ""
        path = _path(run)
        return (path if before == "M" else f"{before}{run[0][1]:.1f}L{path[1:]}") + after

    def axes(self) -> Iterable[Element]:
        """The axes' lines, ticks and labels."""
        low, right = self.bottom, WIDTH - _RIGHT
        yield _line(f"M{_LEFT},{_TOP}V{low}H{right}")
        for at, text in self._readable(self.x.ticks):
            yield _line(f"M{at:.1f},{low}v3")
            yield _text(at, low + 14, text, text_anchor="middle", class_="x-tick")
        for place, text in self.y.ticks:
            at = float(self.up(np.array(place)))
            yield _line(f"M{_LEFT},{at:.1f}h-3")
            yield _text(_LEFT - 6, at + 3.5, text, text_anchor="end", class_="y-tick")
        middle = (_LEFT + right) / 2
        yield _text(
            middle, self.height - 6, self.x.label, text_anchor="middle", fill_opacity=_FAINT
        )
        turned = f"rotate(-90 10 {(_TOP + low) / 2:g})"
        yield _text(
            *(10, (_TOP + low) / 2 + 3, self.y.label),
            text_anchor="middle",
            transform=turned,
            fill_opacity=_FAINT,
        )

    def _readable(self, ticks: Iterable[tuple[float, str]]) -> Iterable[tuple[float, str]]:
        """Ticks along the bottom whose labels do not touch."""
        free = -math.inf
        for place, text in ticks:
            at, half = float(self.across(np.array(place))), 0.5 * _LETTER * len(text)
            if at - half > free:
                yield at, text
                free = at + half + _LETTER / 2


def _runs(inside: Bools) -> list[slice]:
    """Stretches of points that hang together."""
    steps = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(int)))
    return [slice(a, b) for a, b in zip(steps[::2].tolist(), steps[1::2].tolist(), strict=True)]


def _with_neighbours(where: Bools) -> Bools:
    """Mask of points and their neighbours."""
    wider = where.copy()
    wider[1:] |= where[:-1]
    wider[:-1] |= where[1:]
    return wider


def _thin(x: Floats, y: Floats) -> _Path:
    """Leave out points on straight stretches, from the last point kept to the next."""
    kept = [0]
    for k in range(1, x.size - 1):
        a, b = kept[-1], k + 1
        inner = slice(a + 1, b)
        width = float(x[b] - x[a])
        if abs(width) < 1e-9:
            kept.append(k)
            continue
        chord = y[a] + (y[b] - y[a]) * (x[inner] - x[a]) / width
        if np.abs(chord - y[inner]).max() > _FLAT:
            kept.append(k)
    return [(float(x[k]), float(y[k])) for k in [*kept, x.size - 1]]


def _path(points: _Path) -> str:
    first, *rest = (f"{x:.1f},{y:.1f}" for x, y in points)
    return f"M{first}" + (f"L{' '.join(rest)}" if rest else "")


def _line(path: str) -> Element:
    return element("path", d=path, fill="none", stroke=_INK, stroke_opacity="0.55")


def _text(x: float, y: float, text: str, **how: str) -> Element:
    return element("text", text, x=f"{x:.1f}", y=f"{y:.1f}", **how)
