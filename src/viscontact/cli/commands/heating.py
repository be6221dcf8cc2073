"""`heat`: temperatures of a rolling body."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from viscontact.cli.commands.drawing import Picture
from viscontact.cli.commands.showing import RunDirectory
from viscontact.cli.declared import option

Cooling = Annotated[
    str,
    option("--cooling", metavar="H", help="Heat transfer coefficient, e.g. '10 W/m2/K'."),
]
Ambient = Annotated[
    str, option("--ambient", metavar="T", help="Temperature of the air, e.g. '23 degC'.")
]
Area = Annotated[
    str | None,
    option(
        "--area",
        metavar="A",
        help="Cooled area, e.g. '0.1 m2'; by default circumference times length of a covered roll.",
    ),
]
Thickness = Annotated[
    str | None,
    option(
        "--thickness", metavar="T", help="Of the cover, e.g. '8 mm'; by default that of the case."
    ),
]
Conductivity = Annotated[
    str | None,
    option(
        "--conductivity",
        metavar="K",
        help="Thermal conductivity, e.g. '0.2 W/m/K', for the temperature through the cover.",
    ),
]
Core = Annotated[
    str | None,
    option(
        "--core-temperature",
        metavar="T",
        help="Temperature below the cover, e.g. '40 degC'; by default the core is insulated.",
    ),
]
Capacity = Annotated[
    str | None,
    option("--heat-capacity", metavar="C", help="E.g. '1800 J/kg/K', for the heating over time."),
]
Density = Annotated[
    str | None,
    option("--density", metavar="RHO", help="E.g. '1150 kg/m3', for the heating over time."),
]
Speeds = Annotated[
    list[str] | None,
    option(
        "--speed", metavar="V", help="Speed such as '0.5 m/s'; repeated; by default those of DIR."
    ),
]
Report = Annotated[
    Path | None, option("--report", metavar="PAGE.html", help="Write a report with figures.")
]


def heat(
    directory: RunDirectory,
    cooling: Cooling,
    ambient: Ambient,
    area: Area = None,
    thickness: Thickness = None,
    conductivity: Conductivity = None,
    core_temperature: Core = None,
    heat_capacity: Capacity = None,
    density: Density = None,
    speed: Speeds = None,
    output: Picture = None,
    report: Report = None,
) -> None:
    """Find how hot a rolling body becomes by its own loss, from a run in steady motion.

    All balances of power and cooling at each speed, whether they are stable, and the speed of
    thermal runaway; no contact is solved again. The materials that creep must have a shift. The
    figure is the temperature over speed.
    """
    from viscontact.cli.results.heat import print_heat

    texts = {
        "cooling": cooling,
        "ambient": ambient,
        "area": area,
        "thickness": thickness,
        "conductivity": conductivity,
        "core_temperature": core_temperature,
        "heat_capacity": heat_capacity,
        "density": density,
    }
    print_heat(directory, texts, speed or (), figure=output, page=report)
