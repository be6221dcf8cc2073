"""What the README and the page on what the package does show works, to the printed digits."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import viscontact as vc
from viscontact.case import read_case

ROOT = Path(__file__).parent.parent
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
    printed = re.findall(r"\[ *(\S+) +(\S+)\]", capsys.readouterr().out)
    for ours, theirs in zip(printed, said, strict=True):
        for value, digits in zip(ours, theirs, strict=True):
            assert float(value) == pytest.approx(float(digits), rel=5e-3)


def test_the_case_is_read_and_runs(tmp_path: Path) -> None:
    path = tmp_path / "afm.yaml"
    path.write_text(block(WHAT_IT_DOES, "yaml"), encoding="utf-8")
    case = read_case(path)
    ds = vc.simulate(case.indenter, case.material, case.load, times=case.times, fields="none")
    assert float(ds.force.max()) == pytest.approx(1e-9, rel=1e-6)
    assert ds.outcome.values[-1] == vc.Outcome.NO_CONTACT
    # A creeping body does not give back all the work.
    assert ds.work.values[-1] > 0.1 * float(ds.work.max())
