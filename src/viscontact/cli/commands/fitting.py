"""`fit`: identify a law from measured values."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

from viscontact.cli.commands import study_options
from viscontact.cli.commands.drawing import Width
from viscontact.cli.commands.study_options import Settings
from viscontact.cli.declared import argument, option


class Answer(StrEnum):
    """Answer to a question."""

    YES = "yes"
    NO = "no"


Tables = Annotated[
    list[Path],
    argument(
        metavar="FILE.csv...",
        help="Measured values, CSV or spreadsheet (as tests.xlsx#Sheet2); the headings name the "
        "quantities and units. Or a force curve of an instrument (.jpk-force, .h5). Several "
        "indentations, a directory of them, or a map are fitted one by one, to a table; with "
        "--case all together.",
    ),
]
Test = Annotated[
    str | None,
    option(
        "--data",
        metavar="TEST",
        help="Kind of test: shear (G, 1/G), uniaxial (E, 1/E) or deviatoric (Phi); needed where "
        "the headings do not state it.",
    ),
]
PoissonRatio = Annotated[
    float | None,
    option("--poisson-ratio", metavar="NU", help="Constant Poisson's ratio of the body."),
]
BulkModulus = Annotated[
    str | None,
    option("--bulk-modulus", metavar="K", help="Elastic bulk modulus instead, e.g. '4 GPa'."),
]
Terms = Annotated[
    int | None,
    option("--terms", metavar="N", help="Largest number of terms; by default as few as needed."),
]
Fluid = Annotated[bool, option("--fluid", help="The material is a fluid: it flows at long times.")]
Weight = Annotated[
    list[str] | None,
    option(
        "--weight",
        metavar="COLUMN=W",
        help="Weight of storage or loss in the fit, e.g. storage=2; 1 for the other one. By "
        "default the inverse of their scatter.",
    ),
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
        help="Names of all columns of a table without a header, as 'time [s], force [nN]', with "
        "nothing for one that is not read; or the quantities of some, as 'u=approach'.",
    ),
]
Reference = Annotated[
    str | None,
    option(
        "--reference",
        metavar="T",
        help="Temperature of the master curve, e.g. '23 degC'; by default the set nearest 20 degC, "
        "or the first temperature of a test in which it varied.",
    ),
]
Temperature = Annotated[
    str | None,
    option("--temperature", metavar="T", help="Print the law at this temperature instead."),
]
Vertical = Annotated[
    str | None,
    option(
        "--vertical",
        metavar="none|rubber|found",
        help="Vertical shift of several temperatures: none; as T times density; or found. By "
        "default found from storage and loss, and none of one modulus or compliance alone.",
    ),
]
Expansion = Annotated[
    float | None,
    option(
        "--expansion",
        metavar="X",
        help="Thermal expansion in volume, for the density of --vertical rubber [1/K].",
    ),
]
Shift = Annotated[
    str | None,
    option(
        "--shift",
        metavar="arrhenius|wlf|table",
        help="Rule of the shift of a test whose temperature varies; by default Arrhenius or WLF, "
        "whichever describes it better.",
    ),
]
ThermalStrain = Annotated[
    Answer | None,
    option(
        "--thermal-strain",
        metavar="yes|no",
        help="Find thermal expansion in the strain of such a creep test, or take none; by default "
        "where the strain shows it.",
    ),
]
Body = Annotated[
    str | None,
    option(
        "--indenter",
        metavar="SHAPE",
        help="Indenter of an indentation record: 'sphere 5 um' (radius), 'paraboloid 40 nm' "
        "(radius of its tip), 'cone 70 deg' (half angle), 'pyramid 35 deg' (of four faces, from "
        "the axis to a face), berkovich, vickers, cube-corner, or 'punch 2 um' (radius).",
    ),
]
Thickness = Annotated[
    str | None,
    option(
        "--thickness",
        metavar="H",
        help="Thickness of a film that is bonded to a rigid base, e.g. '20 um'; by default the "
        "sample is as deep as a half-space.",
    ),
]
SpringConstant = Annotated[
    str | None,
    option(
        "--spring-constant",
        metavar="K",
        help="Spring constant of the cantilever, e.g. '0.1 N/m', for a force curve: columns time, "
        "position, and deflection or force; files of instruments mostly state their own.",
    ),
]
Sensitivity = Annotated[
    str | None,
    option(
        "--sensitivity",
        metavar="S",
        help="Deflection per signal of a force curve in volts, e.g. '50 nm/V'.",
    ),
]
Reach = Annotated[
    float | None,
    option(
        "--reach",
        metavar="PART",
        help="Part of the largest deflection that the first search of the contact point of a force "
        "curve uses, between 0 and 1; by default 0.3.",
    ),
]
Until = Annotated[
    str | None,
    option(
        "--until",
        metavar="PART",
        help="Part of an indentation that is fitted: up to the end of 'loading', of 'hold', to the "
        "'end', or up to a time, e.g. '2.5 s'. By default the whole record; loading and hold where "
        "the force becomes negative during retraction.",
    ),
]
LawName = Annotated[
    str | None,
    option(
        "--law",
        metavar="LAW",
        help="Law for an indentation record: elastic, maxwell, zener, burgers, creep-series, "
        "power-law or power-law-with-instant; by default zener.",
    ),
]
Adheres = Annotated[
    bool,
    option(
        "--adhesion",
        help="Fit the work of adhesion, its range, modulus and contact point to approach and "
        "retraction of a force curve: a sphere on an elastic body.",
    ),
]
ReferenceTime = Annotated[
    str | None,
    option(
        "--reference-time",
        metavar="T",
        help="Time at which a power law states its compliance, e.g. '1 s', so that several "
        "curves can be compared; by default the length of the record.",
    ),
]
TablePath = Annotated[
    Path | None,
    option(
        "--table",
        metavar="OUT.csv",
        help="Table of the fits of several curves, with intervals and failures; by default "
        "fits.csv.",
    ),
]
Figure = Annotated[
    Path | None,
    option("-o", "--output", metavar="FIG.png", help="Figure: .png, .pdf or .svg."),
]
Section = Annotated[
    Path | None,
    option("--yaml", metavar="OUT.yaml", help="Also write the material section to this file."),
]
_BY_RUNS = "Any body, by runs of a case"
CasePath = Annotated[
    Path | None,
    option(
        "--case",
        metavar="CASE.yaml",
        help="Case of the experiment; columns time, and force or approach or both.",
        panel=_BY_RUNS,
    ),
]
Changes = Annotated[
    list[str] | None,
    option(
        "--change",
        metavar="KEY=LOW:HIGH[:log]",
        help="Range of an unknown, e.g. material.shear_modulus='1 MPa:1 GPa:log'; repeated for "
        "each.",
        panel=_BY_RUNS,
    ),
]
Drive = Annotated[
    str | None,
    option(
        "--drive",
        metavar="force|approach|case",
        help="What the runs prescribe: a column, or the load of the case. The other quantity is "
        "fitted.",
        panel=_BY_RUNS,
    ),
]
ContactPoint = Annotated[
    str | None,
    option(
        "--contact-point",
        metavar="LOW:HIGH",
        help="Range of the reading of the approach at first touch, e.g. '-5 um:5 um'.",
        panel=_BY_RUNS,
    ),
]
MachineStiffness = Annotated[
    str | None,
    option(
        "--machine-stiffness",
        metavar="LOW:HIGH[:log]",
        help="Range of the stiffness of the machine, e.g. '1 kN/mm:100 kN/mm:log'.",
        panel=_BY_RUNS,
    ),
]
Rows = Annotated[
    int | None,
    option(
        "--rows",
        min=5,
        metavar="N",
        help="Most rows of a record, and steps of its run; longer ones are averaged. By default "
        "60.",
        panel=_BY_RUNS,
    ),
]
Report = Annotated[
    Path | None,
    option(
        "--report",
        metavar="OUT.html",
        help="Also write a page with values, records and residuals.",
        panel=_BY_RUNS,
    ),
]
Runs = Annotated[int | None, study_options.runs("Most runs.", _BY_RUNS)]
Jobs = Annotated[int | None, study_options.jobs(_BY_RUNS)]
Scheduler = Annotated[str | None, study_options.scheduler(_BY_RUNS)]
Resume = Annotated[bool, study_options.resume("Continue an interrupted fit.", _BY_RUNS)]
Overwrite = Annotated[
    bool, study_options.overwrite("Replace the runs of an interrupted fit.", _BY_RUNS)
]
Quiet = Annotated[bool, study_options.quiet(panel=_BY_RUNS)]


def fit(
    files: Tables,
    data: Test = None,
    poisson_ratio: PoissonRatio = None,
    bulk_modulus: BulkModulus = None,
    terms: Terms = None,
    fluid: Fluid = False,
    weight: Weight = None,
    stress: Stress = None,
    columns: Columns = None,
    reference: Reference = None,
    temperature: Temperature = None,
    vertical: Vertical = None,
    expansion: Expansion = None,
    shift: Shift = None,
    thermal_strain: ThermalStrain = None,
    indenter: Body = None,
    thickness: Thickness = None,
    adhesion: Adheres = False,
    spring_constant: SpringConstant = None,
    sensitivity: Sensitivity = None,
    reach: Reach = None,
    until: Until = None,
    law: LawName = None,
    reference_time: ReferenceTime = None,
    table: TablePath = None,
    output: Figure = None,
    width: Width = None,
    section: Section = None,
    case: CasePath = None,
    change: Changes = None,
    drive: Drive = None,
    contact_point: ContactPoint = None,
    machine_stiffness: MachineStiffness = None,
    settings: Settings = None,
    rows: Rows = None,
    runs: Runs = None,
    report: Report = None,
    jobs: Jobs = None,
    scheduler: Scheduler = None,
    resume: Resume = False,
    overwrite: Overwrite = False,
    quiet: Quiet = False,
) -> None:
    """Fit a law to measured creep, relaxation, oscillation or indentation.

    Measurements at several temperatures are joined to a master curve, and the shift factors are
    printed; of a test whose temperature varied, law and shift are found together. In a force curve,
    contact point and baseline are found together with the law, or with --adhesion from approach
    and retraction together with the work of adhesion; many curves, as curves/*.csv, give
    one table and histograms of their values. With --case, values of a case are fitted to records by
    runs of the case.
    """
    from viscontact.cli.material.fit_options import FitArguments
    from viscontact.cli.material.fit_report import report_fit
    from viscontact.cli.results.figure_files import chosen_width

    typed = dict(locals())
    page = chosen_width(width, drawn=output is not None, switch="-o FIG.png")
    if case is not None:
        from viscontact.cli.studies.case_fit import execute_case_fit

        execute_case_fit(typed, page)
        return
    from viscontact.cli.material.case_options import refuse_without_case
    from viscontact.cli.material.curve_files import curve_files, holds_several

    curves = curve_files(files)
    several = holds_several(curves)
    refuse_without_case(typed, curves, several=several)
    arguments = FitArguments.of(typed)
    if several:  # workers take a tenth of a second to import
        from viscontact.cli.material.fit_batch import report_fits

        report_fits(curves, arguments, output, table, width=page, jobs=jobs, quiet=quiet)
        return
    report_fit(curves[0], arguments, output, section, width=page)
