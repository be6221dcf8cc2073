"""Facts on an indenter, written next to its drawing."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from textwrap import wrap

from viscontact.bodies.indenters import (
    CombinedIndenter,
    HeightMap,
    Indenter,
    Paraboloid,
    PlacedIndenter,
    Roller,
    Sphere,
)
from viscontact.bodies.indenters.cross_section import Cut
from viscontact.results.argument_table import argument_rows, in_plain_words
from viscontact.results.descriptions import describe
from viscontact.units.formatting import format_compact, readable_unit

# Position at which the drop of an unbounded profile is stated.
_BEFORE_END = 0.9
_KEPT = "\N{NO-BREAK SPACE}"


def facts(
    indenter: Indenter,
    sections: tuple[Cut, Cut],
    levels: Sequence[float],
    contact: tuple[float, float, float, float] | None,
    shaded: str,
) -> Iterator[str]:
    """Yield the facts on an indenter that its drawing does not show, one per line; lengths [m]."""
    yield from _names(indenter, sections[0])
    yield from _ends(sections)
    if not isinstance(indenter, Sphere | Paraboloid | Roller):
        for axis, curvature in zip("xy", indenter.curvatures, strict=True):
            if curvature > 0:
                yield f"radius of curvature along {axis} {length(1 / curvature)}"
    if levels:
        unit = readable_unit("m", levels)
        numbers = ", ".join(format_compact(float(unit(level)), 2) for level in levels)
        yield f"thin lines: gap of {numbers} {unit.symbol}"
    if contact is not None:
        along, across = (length(extent, digits=3) for extent in contact[2:])
        drawn = sections[0].position
        if contact[2] > 2 * (drawn[-1] - drawn[0]):  # a strip, of which a part is drawn
            yield f"shaded: {shaded}, {across} wide"
        else:
            yield f"shaded: extent of the {shaded}, {along} × {across}"


def in_lines(texts: Iterator[str], characters: int) -> str:
    """Break facts into lines of limited length, continuation lines indented."""
    lines = []
    for text in texts:
        # No line break between a number and its unit.
        kept = re.sub(r"(?<=\d) (?=[^\d×])| (?==)|(?<==) ", _KEPT, text)
        lines += wrap(kept, characters, subsequent_indent="   ")
    return "\n".join(lines).replace(_KEPT, " ")


def length(value: float, digits: int = 4) -> str:
    """Length in a readable unit, with a typographic minus sign."""
    unit = readable_unit("m", value)
    return _with_sign(f"{format_compact(float(unit(value)), digits)} {unit.symbol}")


def _names(indenter: Indenter, along: Cut) -> Iterator[str]:
    """Names and sizes of the parts of a body."""
    if isinstance(indenter, CombinedIndenter):
        yield from _names(indenter.parts[0], along)
        for part in indenter.parts[1:]:
            first, *others = _names(part, along)
            yield from (f"+ {first}", *others)
    elif isinstance(indenter, PlacedIndenter):
        yield from _names(indenter.body, along)
        if indenter.angle:
            yield f"turned by {format_compact(math.degrees(indenter.angle))}°"
        for axis, far in (("x", indenter.x), ("y", indenter.y)):
            if far:
                yield f"moved by {length(far)} along {axis}"
    elif isinstance(indenter, HeightMap):
        columns, rows = indenter.height.shape
        yield f"Height map, {columns} × {rows} points"
    else:
        yield _with_sizes(indenter)
        if isinstance(indenter, Roller):
            yield _drop_note(indenter, float(along.position[-1]))


def _with_sizes(indenter: Indenter) -> str:
    if isinstance(indenter, Paraboloid) and math.isinf(indenter.radius_x):
        return f"Cylinder along x, radius {length(indenter.radius_y)}"
    kind = in_plain_words(type(indenter).__name__).capitalize()
    sizes = dict(list(argument_rows(describe(indenter)))[1:])
    if isinstance(indenter, Roller):
        kind += f", {in_plain_words(type(indenter.line).__name__)}"
        sizes.pop("profile", None)
    texts = (f"{name.removeprefix('profile ')} {value}" for name, value in sizes.items())
    return ", ".join([kind, *texts])


def _drop_note(roller: Roller, edge: float) -> str:
    """Drop of the generating line at its ends, or at the ends of the drawing."""
    drop = float(roller.drop(min(roller.end * (1 - 1e-12), edge)))
    if drop == 0:
        return "straight along x"
    if roller.end > edge:
        return f"profile drop at x = ±{length(edge)}: {length(drop, digits=3)}"
    if float(roller.drop(roller.end)) < math.inf and drop < roller.radius:
        return f"profile drop at the ends: {length(drop, digits=3)}"
    near = _BEFORE_END * roller.end
    receded = length(float(roller.drop(near)), digits=3)
    return f"profile drop at x = ±{length(near)}: {receded}"


def _ends(sections: tuple[Cut, Cut]) -> Iterator[str]:
    """Ends of the body, and the directions in which it continues beyond the drawing."""
    cuts = dict(zip("xy", sections, strict=True))
    ends = [f"{axis} = {_places(cut)}" for axis, cut in cuts.items() if cut.ends]
    if ends:
        yield f"dashed: ends at {', '.join(ends)}"
    beyond = [axis for axis, cut in cuts.items() if not cut.ends]
    if beyond:
        yield f"continues beyond the drawing along {' and '.join(beyond)}"


def _places(section: Cut) -> str:
    # The middle of an even mesh is zero up to rounding.
    least = 1e-6 * float(section.position[-1])
    ends = [end if abs(end) > least else 0.0 for end in section.ends]
    if len(ends) == 2 and abs(ends[0] + ends[1]) <= 1e-9 * ends[1]:
        return f"±{length(ends[1])}"
    unit = readable_unit("m", ends)
    places = ", ".join(_with_sign(format_compact(float(unit(end)), 4)) for end in ends)
    return f"{places} {unit.symbol}"


def _with_sign(number: str) -> str:
    return number.replace("-", "\N{MINUS SIGN}")
