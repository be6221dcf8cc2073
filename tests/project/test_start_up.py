"""What is imported before it is needed: nothing, which is what makes the start quick."""

from __future__ import annotations

import gc
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from urllib.request import urlopen

import pytest

import viscontact
from viscontact.cli import main
from viscontact.cli.shell import command_for

EXAMPLES = Path(viscontact.__file__).parent / "case" / "examples"
CASE = EXAMPLES / "roller-dogbone-e05.yaml"
# Not pydantic, which newer versions of Typer read options with.
HEAVY = ("numpy", "scipy", "xarray", "netCDF4", "pint", "matplotlib", "viscontact.backend._core")
# a third of a second together, on a machine of 2026
SLOW_PARTS = ("scipy.interpolate", "scipy.optimize", "scipy.special", "scipy.ndimage", "xarray")
# Where ducc0 is installed, SciPy's transforms are not used; they import its special functions.
TRANSFORMS = ("scipy.fft",) if find_spec("ducc0") else ()
COMPUTES = (
    *(SLOW_PARTS if TRANSFORMS else ("xarray",)),
    *TRANSFORMS,
    "pandas",
    "pint",
    "matplotlib",
)

FIRST_STEP = """
from viscontact.cli import main
from viscontact.simulation.transient.stepper import Stepper

class FirstStep(BaseException):
    pass

def stop(*_):
    raise FirstStep

Stepper.trial = stop
try:
    main(["run", {case!r}, "-o", {directory!r}])
except FirstStep:
    pass
else:
    raise AssertionError("the run has made no step")
"""


@pytest.mark.parametrize(
    ("code", "unwanted"),
    [
        ("import viscontact", (*HEAVY, "pydantic", "typer", "rich")),
        pytest.param(
            "from viscontact.cli import main; main(['--help'])", HEAVY, marks=pytest.mark.slow
        ),
        ("from viscontact.cli import main; main(['run', '--help'])", HEAVY),
        pytest.param(
            f"from viscontact.case import read_case; read_case({str(CASE)!r})",
            (*SLOW_PARTS, "pint"),
            marks=pytest.mark.slow,
        ),
        pytest.param(
            "from viscontact.cli import main; main(['example'])", HEAVY, marks=pytest.mark.slow
        ),
        pytest.param(
            "import viscontact as vc; vc.simulate",
            ("scipy.interpolate", "scipy.optimize", "pint", "rich"),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_start_imports_nothing_it_does_not_need(code: str, unwanted: tuple[str, ...]) -> None:
    assert imported(code, unwanted) == ""


def imported(code: str, unwanted: tuple[str, ...]) -> str:
    """Modules, of unwanted ones, that a process of its own has imported after some code."""
    run = f"{code}\nimport sys\nsys.stderr.write(' '.join(set({unwanted}) & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", run], capture_output=True, text=True, check=True)
    return done.stderr.rpartition("\n")[2]  # below the progress of a run


#: Imported after the last step of a run once: half of the time of a small one.
OF_DATASETS = ("xarray", "pandas", "dask", "pint", "asyncio", "matplotlib")
COMMAND = "from viscontact.cli import main; assert main({words!r}) == 0"
#: What a sphere at rest on one half-space, on a given grid, does without.
OF_OTHER_RUNS = tuple(
    f"viscontact.{each}"
    for each in (
        "mechanics.contact.friction.equilibrium",
        "mechanics.contact.adhesion.equilibrium",
        "mechanics.contact.steady_equilibrium",
        "mechanics.halfspace.strip_basis",
        "simulation.meshing.mesh_choice",
        "simulation.transient.event_search",
        "tables.reader",
        "case.error_messages",
        "cli.commands.fitting",
    )
)
#: Of a check also what a run needs after it.
OF_RUNS = tuple(
    f"viscontact.{each}"
    for each in (
        "simulation.transient.march",
        "simulation.accuracy.error_bars",
        "mechanics.time_integration.internal_variables",
    )
)
#: What reads unusual command lines and prints help, and what Linux states in files of its own.
OF_HELP, OF_SYSTEMS = ("typer", "click"), ("psutil",) if sys.platform == "linux" else ()
#: Subpackages of SciPy that take longest; `stats` imports most others.
OF_SCIPY = tuple(
    f"scipy.{each}" for each in ("signal", "stats", "interpolate", "optimize", "ndimage")
)


def test_a_run_and_its_tables_import_no_library_of_datasets(tmp_path: Path) -> None:
    case, run = str(EXAMPLES / "sphere-zener.yaml"), str(tmp_path / "run")
    small = ["--set", "grid.shape=[32, 32]", "--set", "time.steps=4"]
    unwanted = (*OF_DATASETS, *(SLOW_PARTS if TRANSFORMS else ()), *TRANSFORMS, "scipy.linalg")
    run_it = COMMAND.format(words=["run", case, "-o", run, *small])
    unwanted = (*unwanted, *OF_HELP, *OF_SYSTEMS)
    assert imported(run_it, (*unwanted, *OF_OTHER_RUNS)) == ""
    kinds = ("bodies.materials.material", "bodies.laws.law", "bodies.indenters.indenter")
    no_kinds = tuple(f"viscontact.{each}" for each in kinds)
    assert imported(COMMAND.format(words=["show", run]), (*unwanted, *no_kinds, "pydantic")) == ""


def test_a_fit_to_a_record_imports_no_library_of_datasets(tmp_path: Path) -> None:
    rows = [(k / 10, 20 * k, round((20 * k) ** 1.5 / 100, 3)) for k in range(20)]
    record = tmp_path / "record.csv"
    lines = ["time [s], approach [nm], force [nN]", *(", ".join(map(str, row)) for row in rows)]
    record.write_text("\n".join(lines))
    options = ["--indenter", "sphere 5 um", "--poisson-ratio", "0.5", "--law", "elastic"]
    code = f"from viscontact.cli import main; main({['fit', str(record), *options]!r})"
    unwanted = (*OF_DATASETS, *OF_HELP, *OF_SYSTEMS, *OF_SCIPY, "netCDF4", "pydantic")
    assert (
        imported(code, (*unwanted, "scipy.special", "scipy.linalg", "viscontact.runs.analysis"))
        == ""
    )


def test_a_check_imports_nothing_that_it_does_without() -> None:
    check = COMMAND.format(words=["check", str(EXAMPLES / "sphere-zener.yaml")])
    libraries = (*OF_DATASETS, *COMPUTES, *OF_HELP, *OF_SYSTEMS, "netCDF4", "scipy.linalg")
    rest = ("rich", "tomllib")
    unwanted = (*libraries, *rest, *OF_OTHER_RUNS, *OF_RUNS)
    assert imported(check, unwanted) == ""


@pytest.fixture(scope="module")
def small_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    run = tmp_path_factory.mktemp("small") / "run"
    small = ["--set", "grid.shape=[32, 32]", "--set", "time.steps=4", "-q"]
    assert main(["run", str(EXAMPLES / "sphere-zener.yaml"), "-o", str(run), *small]) == 0
    return run


@pytest.mark.slow
def test_a_drawn_history_imports_nothing_of_fits_and_exact_solutions(small_run: Path) -> None:
    words = ["plot", str(small_run), "history", "-o", str(small_run / "history.png")]
    own = ("reference.hertz", "identification.indentation", "identification.master_curve")
    unwanted = (*OF_SCIPY, "plotly", *(f"viscontact.{each}" for each in own))
    assert imported(COMMAND.format(words=words), unwanted) == ""


@pytest.mark.slow
def test_a_report_imports_nothing_of_studies_and_fits(small_run: Path) -> None:
    own = ("report.fit_page", "report.design_page", "identification.fit_quality")
    unwanted = ("scipy.signal", "scipy.stats", "typst", *(f"viscontact.{each}" for each in own))
    assert imported(COMMAND.format(words=["report", str(small_run)]), unwanted) == ""


#: Served from a process whose application, made after the first page, says what is imported.
SERVED = """
import os, sys
from viscontact.web import server

def told(*_):
    sys.stderr.write(' '.join(set({unwanted}) & set(sys.modules)))
    sys.stderr.flush()
    os._exit(0)

server._application = told
from viscontact.cli import main
main(["serve", "--no-open", "--port", "0", "--no-token", "--dir", {folder!r}])
"""


@pytest.mark.slow
def test_the_first_page_of_the_server_is_shown_before_all_else_is_imported(
    tmp_path: Path,
) -> None:
    pytest.importorskip("uvicorn")
    unwanted = ("fastapi", *HEAVY, *OF_DATASETS[:-2], "plotly", "viscontact.web.calculator")
    unwanted = tuple(each for each in unwanted if each != "numpy")  # numbers with units
    code = SERVED.format(unwanted=unwanted, folder=str(tmp_path))
    with subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as served:
        assert served.stdout
        address, *_ = served.stdout.readline().split()
        with urlopen(address) as page:
            assert b"<title>" in page.read()
        _, said = served.communicate(timeout=60)
    assert said.rpartition("\n")[2] == ""


def test_a_case_imports_the_kinds_that_it_names_only() -> None:
    kinds = ("indenters.torus", "laws.fractional_zener", "loads.travel", "materials.cards.reader")
    others = ("surfaces.reader", "series_fits.prony")
    unwanted = tuple(f"viscontact.bodies.{each}" for each in (*kinds, *others))
    code = f"from viscontact.case import read_case; read_case({str(CASE)!r})"
    assert imported(code, unwanted) == ""


@pytest.mark.slow
def test_first_step_of_a_run_imports_nothing_that_its_end_needs(tmp_path: Path) -> None:
    code = FIRST_STEP.format(case=str(CASE), directory=str(tmp_path / "run"))
    # Its output is a pipe, and no bar is drawn.
    assert imported(code, (*COMPUTES, "rich.console")) == ""


def test_collections_of_a_command_leave_out_what_was_imported() -> None:
    code = (
        "import gc, sys; from viscontact.cli import main; sys.argv[1:] = ['example']; main()\n"
        "sys.stderr.write(f'{gc.isenabled()} {gc.get_freeze_count() > 10_000}')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stderr == "True True"


def test_program_that_calls_a_command_collects_garbage_as_before() -> None:
    assert main(["example"]) == 0
    assert gc.isenabled()
    assert gc.get_freeze_count() == 0


@pytest.mark.parametrize("command", ["show", "run"])
def test_options_of_one_command_only_are_built(command: str) -> None:
    assert list(command_for([command, "--help"]).commands) == [command]
    assert len(command_for(["--help"]).commands) > 15
    assert len(command_for(["shwo"]).commands) > 15
