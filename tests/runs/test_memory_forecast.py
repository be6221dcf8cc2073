"""The memory that `check` announces, against what processes of the operating system take."""

from __future__ import annotations

import os
import platform
import subprocess
import sys

import pytest

from closeness import close_to

#: A creeping sphere on many cells; the memory of the process before and after a run on a few.
RUN = """
import viscontact as vc
from viscontact.mechanics.problem.problem import Problem
from viscontact.runs.run_memory import PROGRAM, freed_memory, run_memory
from viscontact.simulation.transient.setup import prepare_run

def resident(key):
    lines = open("/proc/self/status").read().splitlines()
    return 1024 * int(next(line for line in lines if line.startswith(key)).split()[1])

def problem(cells):
    spring, series = vc.Zener(1e6, 1e6, 1e6), vc.CreepSeries(5e-7, [2e-7] * 5, [0.1, 1, 3, 10, 30])
    power = vc.PowerLaw(5e-7, 0.3, 1.0, instant=2e-7)
    law = {{"series": series, "sum": power}}.get("{kind}", spring)
    material = vc.Material(law, poisson_ratio=0.4)
    if "{kind}" == "layers":
        steel = vc.Material(vc.Elastic(5e6), poisson_ratio=0.3)
        material = vc.Layered([vc.Layer(1e-3, material)], base=steel)
    aside = 0.0 if "{kind}" == "symmetric" else 2e-6
    across = 0.0 if "{kind}" == "half" else aside / 2
    load = vc.step(0.08, eccentricity_x=aside, eccentricity_y=across)
    times, grip = vc.uniform_times(2.0, 4), {{}}
    if "{kind}".startswith("pulled"):
        ratio = 0.2 if "coupled" in "{kind}" else 0.5
        material, load = vc.Material(spring, poisson_ratio=ratio), vc.step(0.08)
        across = 0.005 if "aside" in "{kind}" else 0.0
        pull = vc.TangentialHistory([0.5, 2.0], force_x=[0, 0.01], force_y=[0, across])
        grip = {{"friction": vc.Friction(0.3), "tangential": pull}}
        if "layers" in "{kind}":
            steel = vc.Material(vc.Elastic(5e6), poisson_ratio=0.3)
            base = steel if "aside" in "{kind}" else "rigid"
            material = vc.Layered([vc.Layer(1e-3, material)], base=base)
            grip["friction"] = vc.Friction(0.3, coupling="coupled" in "{kind}")
    if "{kind}" == "rolled":
        material, load = vc.Material(spring, poisson_ratio=0.5), vc.step(0.08)
        path = vc.Travel([0.5, 2.0], x=[0, 2e-5], creepage=0.01)
        grip = {{"friction": vc.Friction(0.3), "motion": path}}
    grid = vc.Grid((cells, cells), (2e-3, 2e-3))
    return Problem(vc.Sphere(0.01), material, load, grid, times, **grip)

def march(cells):
    given = problem(cells)
    what = given.indenter, given.material, given.load, given.grid, given.times
    along = {{"friction": given.friction, "tangential": given.tangential, "motion": given.motion}}
    for _ in vc.march(*what, **along):
        pass

march(64)
before = resident("VmRSS")
march({cells})
run = prepare_run(problem({cells}))
grips = run.problem.friction is not None
announced, freed = run_memory(run), freed_memory(run.grid, run.mirrored, under_friction=grips)
print(resident("VmHWM") - before, announced - PROGRAM, freed)
"""

#: Every array of more than 64 kB is given back to the system when it is freed.
GIVEN_BACK = {"GLIBC_TUNABLES": "glibc.malloc.mmap_threshold=65536:glibc.malloc.mmap_max=1000000"}


def memory(kind: str, cells: int, **environment: str) -> tuple[float, float, float]:
    """Bytes that a run takes, bytes announced, and those of freed arrays among these."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", RUN.format(kind=kind, cells=cells)],
        check=True,
        capture_output=True,
        text=True,
        env=os.environ | environment,
    )
    taken, announced, freed = map(float, done.stdout.split())
    return taken, announced, freed


measured = pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="measures with glibc")


@pytest.mark.slow
@measured
@pytest.mark.parametrize(
    ("kind", "cells", "most"),
    [
        ("spring", 1024, 216),
        ("series", 1024, 280),
        ("symmetric", 1024, None),
        ("half", 2048, None),
        ("sum", 1024, None),
        ("layers", 1024, None),
        ("pulled", 1024, None),
        ("pulled aside", 1024, None),
        ("pulled, coupled", 768, None),
        ("pulled aside layers", 768, None),
        ("rolled", 768, None),
    ],
)
def test_announced_memory_is_what_a_run_takes(kind: str, cells: int, most: int | None) -> None:
    """Within 10 %; without symmetry at most 200 bytes a cell and 16 for each term of the law."""
    taken, announced, freed = memory(kind, cells, **GIVEN_BACK)
    assert taken == close_to(announced - freed, rel=0.1)
    if most is not None:
        # Buffers of libraries, about 10 MB here, do not grow with the cells.
        assert taken < most * cells**2 + 2e7


@pytest.mark.slow
@measured
@pytest.mark.parametrize(
    ("kind", "cells"),
    [
        *((kind, 1024) for kind in ("spring", "series", "symmetric", "sum", "layers")),
        *((kind, 1024) for kind in ("pulled", "pulled aside", "pulled, coupled")),
        *((kind, 3072) for kind in ("spring", "symmetric")),
    ],
)
def test_announced_memory_is_enough_with_freed_arrays(kind: str, cells: int) -> None:
    """All are kept or none: measured 0.94 to 1.07 of what is announced, or 0.84 to 0.93.

    Of 3072² cells they are 5 to 7 %; there 0.86 of it was seen once, on a busy machine. Too much
    announced harms less than too little.
    """
    taken, announced, freed = memory(kind, cells)
    assert 0.85 * (announced - freed) < taken < 1.1 * announced
    if (kind, cells) == ("spring", 3072):
        assert taken < 216 * cells**2 + 2e7
