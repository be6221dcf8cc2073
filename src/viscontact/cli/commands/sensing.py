"""`sensitivity`: what the result of a case depends on."""

from __future__ import annotations

from typing import Annotated

from viscontact.cli.commands.study_options import Instant, study
from viscontact.cli.declared import option

Outputs = Annotated[
    str,
    option("--of", metavar="SCALAR,...", help="Outputs, e.g. peak_pressure,approach."),
]
Inputs = Annotated[
    list[str] | None,
    option(
        "--change",
        metavar="KEY",
        help="Input, e.g. indenter.radius; repeated for each. By default all numbers of bodies, "
        "load and motion.",
    ),
]
Scatter = Annotated[
    list[str] | None,
    option(
        "--scatter",
        metavar="KEY=LOW:HIGH[:log|:normal]",
        help="Input that scatters between two bounds (normal: 95 % of it), e.g. "
        "indenter.radius='4.98 mm:5.02 mm' or '5 mm ± 0.02 mm'; repeated for each. Numbers with a "
        "tolerance in the case scatter as well.",
    ),
]
Samples = Annotated[
    int,
    option(
        "--samples",
        metavar="N",
        help="Number of samples, a power of two; with d inputs they take N (d + 2) runs.",
    ),
]
Seed = Annotated[int, option("--seed", metavar="S", help="Seed of the samples.")]
Step = Annotated[
    float, option("--step", metavar="PART", help="Relative step of an input, up to 0.5.")
]


@study("viscontact.cli.studies.sensitivity")
def sensitivity(
    of: Outputs,
    change: Inputs = None,
    scatter: Scatter = None,
    samples: Samples = 64,
    seed: Seed = 0,
    at: Instant = "worst",
    step: Step = 0.1,
) -> None:
    """Find how much scalars of the result depend on each number of a case.

    The elasticity is the relative change of an output per relative change of an input; the error of
    each is stated. DIR gets the runs, sensitivity.nc and report.html.
    """
