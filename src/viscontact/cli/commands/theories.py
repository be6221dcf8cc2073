"""`theory`: contact area and friction of a rough surface by Persson's theory."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from viscontact.cli.declared import argument, option

SurfaceFile = Annotated[
    Path, argument(metavar="SURFACE", help="Height map, in any format that a case takes.")
]
Body = Annotated[
    str,
    option(
        "--material", metavar="NAME|FILE", help="A shipped material, or a file of one (a case)."
    ),
]
Pressures = Annotated[
    list[str],
    option("--pressure", metavar="P", help="Nominal pressure, e.g. '0.3 MPa'; repeated."),
]
Held = Annotated[
    str | None,
    option("--time", metavar="T", help="For which the pressure is held, e.g. '1 h'."),
]
Speeds = Annotated[
    list[str] | None,
    option("--speed", metavar="V", help="Sliding speed, e.g. '1 mm/s'; repeated."),
]
Along = Annotated[str, option("--along", metavar="x|y", help="Direction of the sliding.")]
Spacing = Annotated[
    str | None,
    option("--spacing", metavar="D", help="Of the points, if the file does not state it."),
]
HeightUnit = Annotated[
    str | None,
    option("--height-unit", metavar="U", help="Of the heights, if the file has none."),
]
Periodic = Annotated[
    bool, option("--periodic", help="The map repeats itself: no window is needed.")
]
Picture = Annotated[
    Path | None,
    option("-o", "--output", metavar="FIGURE", help="Figure over speed (.png, .pdf, .svg)."),
]


def theory(
    surface: SurfaceFile,
    material: Body,
    pressure: Pressures,
    time: Held = None,
    speed: Speeds = None,
    along: Along = "y",
    spacing: Spacing = None,
    height_unit: HeightUnit = None,
    periodic: Periodic = False,
    output: Picture = None,
) -> None:
    """Estimate contact area and hysteresis friction of a rough surface from its power spectrum.

    Persson's theory, for surfaces that are too large to compute. No contact is solved: at small
    loads the computed area is about 1.3 times as large, and the friction has the order only.
    """
    from viscontact.cli.material.rough_theory import RoughSliding, print_theory

    print_theory(
        RoughSliding(surface, material, tuple(pressure), time, tuple(speed or ()), along),
        {"spacing": spacing, "height_unit": height_unit},
        periodic=periodic,
        figure=output,
    )
