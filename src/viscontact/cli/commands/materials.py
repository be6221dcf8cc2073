"""`material`: list, show, draw and write materials."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from viscontact.cli.commands.drawing import Width
from viscontact.cli.declared import argument, option
from viscontact.cli.terminal.messages import refuse

if TYPE_CHECKING:  # heavy, and only to name its type
    from viscontact.cli.material.material_files import MaterialOptions

Which = Annotated[
    str | None,
    argument(
        metavar="[NAME|FILE]",
        help="A shipped material, a case file, a measured table, or a card of Abaqus, Ansys or "
        "LS-DYNA; by default the shipped materials are listed.",
    ),
]
Output = Annotated[
    Path | None,
    option(
        "-o",
        "--output",
        metavar="FILE",
        help="Figure (.png, .pdf or .svg); with --to, the file to write.",
    ),
]
Form = Annotated[
    str | None,
    option("--to", metavar="FORM", help="Write the material in this form: abaqus, ansys or csv."),
]
Test = Annotated[
    str | None,
    option(
        "--data",
        metavar="TEST",
        help="Kind of test of a table: shear (G, 1/G), uniaxial (E, 1/E) or deviatoric (Phi); "
        "needed where the headings do not state it.",
    ),
]
PoissonRatio = Annotated[
    float | None,
    option(
        "--poisson-ratio", metavar="NU", help="Constant Poisson's ratio, for a table or a card."
    ),
]
BulkModulus = Annotated[
    str | None,
    option("--bulk-modulus", metavar="K", help="Elastic bulk modulus instead, e.g. '4 GPa'."),
]
Stress = Annotated[
    str | None,
    option(
        "--stress",
        metavar="S",
        help="Stress of a creep test given as strain, e.g. '5 MPa'; of several tests in the table, "
        "the one at this stress is read.",
    ),
]
Columns = Annotated[
    str | None,
    option(
        "--columns",
        metavar="NAMES",
        help="Names of all columns of a table without a header, as 'time [s], G [MPa]', with "
        "nothing for one that is not read; or the quantities of some, as 'E_1=relaxation_modulus'.",
    ),
]
SetNumber = Annotated[
    float | None, option("--set", metavar="N", help="Number of the set in a table.")
]
ModulusUnit = Annotated[
    str | None,
    option(
        "--modulus-unit", metavar="UNIT", help="Unit of a card's moduli; MPa by default with --to."
    ),
]
TimeUnit = Annotated[
    str | None,
    option("--time-unit", metavar="UNIT", help="Unit of a card's times; s by default with --to."),
]
TemperatureUnit = Annotated[
    str | None,
    option(
        "--temperature-unit",
        metavar="UNIT",
        help="Unit of the temperatures in a card's shift: degC or K.",
    ),
]
Temperature = Annotated[
    str | None,
    option(
        "--temperature",
        metavar="T",
        help="Show or write the law at this temperature, e.g. '40 degC', by its shift.",
    ),
]
Name = Annotated[
    str | None,
    option("--name", metavar="NAME", help="Name or number of a material in a card."),
]


def material(
    which: Which = None,
    output: Output = None,
    width: Width = None,
    to: Form = None,
    data: Test = None,
    poisson_ratio: PoissonRatio = None,
    bulk_modulus: BulkModulus = None,
    number: SetNumber = None,
    stress: Stress = None,
    columns: Columns = None,
    modulus_unit: ModulusUnit = None,
    time_unit: TimeUnit = None,
    temperature_unit: TemperatureUnit = None,
    name: Name = None,
    temperature: Temperature = None,
) -> None:
    """Show creep and relaxation of a material and its source, or write it for another program."""
    from viscontact.cli.material.material_files import MaterialOptions

    typed = MaterialOptions(
        data=data,
        poisson_ratio=poisson_ratio,
        bulk_modulus=bulk_modulus,
        set=number,
        stress=stress,
        columns=columns,
        modulus_unit=modulus_unit,
        time_unit=time_unit,
        temperature_unit=temperature_unit,
        name=name,
        temperature=temperature,
    )
    _show_or_write(which, output, width, to, typed)


def _show_or_write(
    which: str | None,
    output: Path | None,
    width: str | None,
    to: str | None,
    typed: MaterialOptions,
) -> None:
    from viscontact.cli.material.material_files import at_temperature, find_material
    from viscontact.cli.material.material_tables import list_library, show_material
    from viscontact.cli.material.material_writing import FORMS, write_material
    from viscontact.cli.results.figure_files import chosen_width

    if to is not None and to not in FORMS:
        refuse(f"--to: must be one of {', '.join(FORMS)}, got {to!r}")
    drawn = output is not None and to is None
    page = chosen_width(width, drawn=drawn, switch="-o FIG.png")
    if which is None:
        if to is not None:
            refuse(f"--to {to}: name one material, e.g. pmma-paper")
        list_library(output)
        return
    shown = at_temperature(find_material(which, typed, writes=to is not None), typed.temperature)
    if to is None:
        show_material(shown, output, page)
    else:
        write_material(shown, to, typed, output)
