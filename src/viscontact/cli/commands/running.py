"""`run` and `check`."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

from viscontact.cli.commands.drawing import Width
from viscontact.cli.commands.study_options import (
    CaseFile,
    Jobs,
    Overwrite,
    QuietRun,
    Resume,
    Scheduler,
    Settings,
)
from viscontact.cli.declared import argument, option
from viscontact.cli.quick_imports import quick_imports
from viscontact.cli.terminal.interruption import watched_interruption
from viscontact.cli.terminal.log import logged
from viscontact.cli.terminal.messages import INTERRUPTED, refuse, stop
from viscontact.runs.processes.request import RunRequest


class Method(StrEnum):
    """Kinds of random points."""

    SOBOL = "sobol"
    LATIN_HYPERCUBE = "latin-hypercube"


CaseFiles = Annotated[list[Path], argument(metavar="CASE.yaml...", help="Case file, or several.")]
Output = Annotated[
    Path | None,
    option(
        "-o",
        "--output",
        metavar="DIR",
        help="Run directory; by default CASE/ next to the case file. Several runs get a directory "
        "each in DIR.",
    ),
]
Varied = Annotated[
    list[str] | None,
    option(
        "--vary",
        metavar="KEY=VALUE,VALUE,...",
        help="One run for each value, e.g. load.force=5kN,10kN; if repeated, one for each "
        "combination.",
    ),
]
Zipped = Annotated[
    bool, option("--zip", help="Pair the values of several --vary, in place of combinations.")
]
PlanTable = Annotated[
    Path | None,
    option(
        "--table",
        metavar="FILE.csv",
        help="One run for each row, CSV or spreadsheet; the headings are keys with units, e.g. "
        "'load.force [N]'.",
    ),
]
Sample = Annotated[
    int | None,
    option("--sample", min=1, metavar="N", help="N runs at points that fill the ranges evenly."),
]
Ranges = Annotated[
    list[str] | None,
    option(
        "--range",
        metavar="KEY=LOW:HIGH[:log]",
        help="Range of a key for --sample, e.g. load.force='5 kN:20 kN:log'; if repeated, a range "
        "for each key.",
    ),
]
Seed = Annotated[
    int | None,
    option("--seed", min=0, metavar="S", help="Seed of --sample; 0 if not given."),
]
SamplingMethod = Annotated[
    Method | None,
    option("--method", help="Points of --sample: a scrambled Sobol sequence if not given."),
]
Array = Annotated[
    Path | None,
    option(
        "--array",
        metavar="FILE.sbatch",
        help="Start nothing, but write a job array for SLURM (FILE.sbatch) or PBS (FILE.pbs); -j "
        "limits its tasks at the same time.",
    ),
]
TaskNumber = Annotated[
    int | None,
    option(
        "--task",
        metavar="N",
        help="Compute run N, from 0, of a manifest: run --task N DIR/runs.jsonl.",
    ),
]
Verbose = Annotated[
    int,
    option(
        "--verbose",
        "-v",
        count=True,
        show_default=False,
        help="Print the choice of the grid and other steps of the work; -vv prints each time step.",
    ),
]
Threads = Annotated[int, option(min=1, help="Number of threads of a Fourier transform.")]


def run(
    cases: CaseFiles,
    output: Output = None,
    overwrite: Overwrite = False,
    resume: Resume = False,
    settings: Settings = None,
    varied: Varied = None,
    zipped: Zipped = False,
    table: PlanTable = None,
    sample: Sample = None,
    ranges: Ranges = None,
    seed: Seed = None,
    method: SamplingMethod = None,
    array: Array = None,
    task: TaskNumber = None,
    jobs: Jobs = None,
    scheduler: Scheduler = None,
    threads: Threads = 1,
    quiet: QuietRun = False,
    verbose: Verbose = 0,
) -> None:
    """Run a case and write its result to a directory; several runs get a directory each.

    Several runs:  viscontact run my.yaml --vary load.force=5kN,10kN,20kN -j 2 -o forces
    """
    if resume and overwrite:
        refuse("--resume continues runs and --overwrite starts them again: give one of them")
    common = RunRequest(cases[0], output, overwrite, resume, tuple(settings or ()), threads, quiet)
    several = (varied, zipped or None, table, sample, ranges, seed, method, array, task, scheduler)
    is_single = (
        len(cases) == 1 and cases[0].suffix != ".jsonl" and several.count(None) == len(several)
    )
    try:
        with watched_interruption() as interruption, logged(verbose):
            # An import that is interrupted may end in any error: the request waits for its end.
            if is_single:
                with interruption.postponed(), quick_imports():
                    from viscontact.cli.run.execution import execute
                execute(common)
                return
            with interruption.postponed():
                from viscontact.cli.sweep.execution import execute_several
                from viscontact.cli.sweep.plan_options import PlanOptions
                from viscontact.cli.sweep.request import ManyRequest
            options = PlanOptions(
                tuple(varied or ()),
                zipped,
                table,
                sample,
                tuple(ranges or ()),
                seed,
                None if method is None else method.value,
            )
            execute_several(
                ManyRequest(tuple(cases), common, options, jobs, scheduler, array, task)
            )
    except KeyboardInterrupt:
        stop("interrupted", code=INTERRUPTED)


def check(
    case: CaseFile,
    figure: Annotated[
        Path | None,
        argument(metavar="FIG.png", help="With --plot: the figure; by default CASE-indenter.png."),
    ] = None,
    plot: Annotated[bool, option("--plot", help="Draw the indenter as well.")] = False,
    width: Width = None,
    settings: Settings = None,
    verbose: Verbose = 0,
) -> None:
    """Check a case, and estimate its size, its computing time and its results."""
    with quick_imports():
        from viscontact.cli.run.check import print_forecast
        from viscontact.runs.execution.prepared_case import prepare

    if figure is not None and not plot:
        refuse(f"{figure}: a picture goes with --plot, as in: check {case} --plot {figure}")
    page = None
    if plot or width is not None:  # figures take a second to import
        from viscontact.cli.results.figure_files import chosen_width

        page = chosen_width(width, drawn=plot, switch="--plot")
    with logged(verbose):
        prepared = prepare(case, settings or [], roughly=True)
        expected = print_forecast(prepared)
    if plot:
        from viscontact.cli.run.drawing import draw_body

        draw_body(prepared, expected, figure, page)
