"""What the README and the page on what the package does show works, to the printed digits."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import viscontact as vc
from closeness import close_to
from returned import some
from viscontact.case import read_case

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
WHAT_IT_DOES = (ROOT / "docs/about/what-it-does.md").read_text(encoding="utf-8")


def block(page: str, language: str) -> str:
    found = re.findall(rf"```{language}\n(.*?)```", page, re.DOTALL)
    assert len(found) == 1
    return str(found[0])


def test_the_python_example_prints_what_it_says(capsys: pytest.CaptureFixture[str]) -> None:
    source = block(README, "python")
    said = re.findall(r"# \[(\S+) (\S+)\]", source)
    exec(compile(source, "README.md", "exec"), {})
    printed = re.findall(r"\[ *(\S+) +(\S+) *\]", capsys.readouterr().out)
    for ours, theirs in some(zip(printed, said, strict=True)):
        for value, digits in zip(ours, theirs, strict=True):
            assert float(value) == close_to(float(digits), rel=5e-3)


def test_the_case_is_read_and_runs(tmp_path: Path) -> None:
    path = tmp_path / "afm.yaml"
    path.write_text(block(WHAT_IT_DOES, "yaml"), encoding="utf-8")
    case = read_case(path)
    ds = vc.simulate(
        case.indenter,
        case.material,
        case.load,
        times=case.times,
        fields="none",
    )
    assert float(ds.force.max()) == close_to(1e-9, rel=1e-6)
    assert ds.outcome.values[-1] == vc.Outcome.NO_CONTACT
    # A creeping body does not give back all the work.
    assert ds.work.values[-1] > 0.1 * float(ds.work.max())


def row(text: str, *beginning: str) -> list[str]:
    """The cells of a table's row that begins so; a cell that is left empty is the one above."""
    above: list[str] = []
    for line in text.splitlines():
        if not line.startswith("|"):
            above = []
            continue
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        cells = [cell or last for cell, last in zip(cells, above or cells, strict=False)]
        above = cells
        if cells[: len(beginning)] == list(beginning):
            return cells
    raise AssertionError(f"no row {beginning}")


#: Where the README's errors are from: its row, and case, reference and quantity on the page.
CREEPING_ROW = "creeping sphere: Maxwell (errors), Zener 256², 120 steps (time)"
PERIODIC_ROW = "periodic: waves (errors), rough plane 1024² (time)"
CREEPING = "ball under a sudden force, Maxwell", "Lee & Radok 1960"
ROLLER = "eccentric roller, sudden force, PMMA", "Lee & Radok 1960, correspondence"
ERRORS = [
    ("sphere, 512² cells", 2, ("sphere", "Hertz 1882", "approach")),
    ("sphere, 512² cells", 3, ("sphere", "Hertz 1882", "central pressure")),
    (CREEPING_ROW, 2, (*CREEPING, "approach")),
    (
        CREEPING_ROW,
        3,
        (*CREEPING, "central pressure"),
    ),
    ("pressed and let go", 2, ("force triangle, Maxwell", "Ting 1966", "approach")),
    (
        PERIODIC_ROW,
        2,
        ("straight waves, periodic", "Westergaard 1939", "approach"),
    ),
    (
        PERIODIC_ROW,
        3,
        ("straight waves, periodic", "Westergaard 1939", "pressure"),
    ),
    ("the roller above, 120 steps", 2, (*ROLLER, "approach")),
]


@pytest.mark.parametrize(("problem", "column", "case"), ERRORS)
def test_errors_in_the_readme_are_those_that_were_verified(
    problem: str, column: int, case: tuple[str, ...]
) -> None:
    page = (ROOT / "docs/verification.md").read_text(encoding="utf-8")
    # One digit is shown.
    assert float(row(README, problem)[column]) == close_to(float(row(page, *case)[5]), rel=0.2)


@pytest.mark.parametrize(
    ("problem", "beginning", "columns"),
    [
        ("sphere, 512² cells", ("free sphere 512²", "1e-8"), (2, 4)),
        (
            CREEPING_ROW,
            ("Zener sphere 256², 120 steps", "1e-8"),
            (2, 4),
        ),
        (
            PERIODIC_ROW,
            ("rough plane, periodic, 1024²", "1e-8"),
            (2, 4),
        ),
    ],
)
def test_times_in_the_readme_are_those_that_were_measured(
    problem: str, beginning: tuple[str, ...], columns: tuple[int, ...]
) -> None:
    benchmarks = (ROOT / "benchmarks/README.md").read_text(encoding="utf-8")
    measured = [float(row(benchmarks, *beginning)[column].split()[0]) for column in columns]
    ours = row(README, problem)
    shown = [float(ours[4]), *(float(word) for word in re.findall(r" (\d+\.?\d*)", ours[5]))]
    assert shown == close_to(measured, rel=0.02)


def test_the_pictures_of_the_readme_are_there() -> None:
    pictures = re.findall(r'<img [^>]*src="([^"]+)"', README)
    assert len(pictures) == 5
    assert all((ROOT / picture).exists() for picture in pictures)


def test_the_rollers_time_in_the_readme_is_the_one_that_was_measured() -> None:
    benchmarks = (ROOT / "benchmarks/README.md").read_text(encoding="utf-8")
    ours = row(README, "the roller above, 120 steps")
    measured = re.findall(r"^ +75 +1e-08 +ducc0 +(\S+) .* (\d+) +(\d+)$", benchmarks, re.MULTILINE)
    ((seconds, published, times_as_long),) = measured
    assert ours[4] == seconds
    assert re.findall(r"(\d+) times", ours[5]) == [times_as_long]
    assert float(published) / float(seconds) == close_to(float(times_as_long), rel=0.02)
