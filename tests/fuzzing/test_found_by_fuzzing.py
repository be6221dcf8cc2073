"""Faults found by generated input, each corrected: crashes, hangs, and memory not announced."""

from __future__ import annotations

import os
import time as clock
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pydantic
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials.cards import read_card
from viscontact.case import CaseError, read_case
from viscontact.case.loads.sentences import Sentences, split_sentences
from viscontact.cli import main
from viscontact.mechanics.problem.problem import Problem
from viscontact.mechanics.time_integration.fixed_steps import MAX_STEPS, plan_steps
from viscontact.runs import preparation
from viscontact.runs.forecast import forecast
from viscontact.simulation.transient.setup import prepare_run
from viscontact.units.parsing import parse_quantity

#: Each of these took minutes, or would have taken hours; now they take tenths of a second [s].
AT_ONCE = 5.0

RUBBER = vc.Material(vc.Zener(1e6, 1e6, 1e6), 0.5)
CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 10 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 4 N}
time: {end: 5 s, steps: 3}
grid: {shape: [16, 16], size: [3 mm, 3 mm]}
"""


@pytest.fixture(autouse=True)
def _ends_in_time() -> Iterator[None]:
    started = clock.process_time()  # of the processor, which a busy machine does not lengthen
    yield
    assert clock.process_time() - started < AT_ONCE


def refusal(path: Path, text: str) -> str:
    """Return why a case file is refused."""
    path.write_text(text, encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        read_case(path)
    return str(caught.value)


# --- text that took a time which grows with the square of its length ----------------------------


def test_blanks_within_a_unit_are_refused_at_once() -> None:
    with pytest.raises(ValueError, match="unknown unit") as caught:
        parse_quantity("5 m" + " " * 300_000 + "m", "length")
    assert len(str(caught.value)) < 300


def test_blanks_within_a_sentence_are_passed_over_at_once() -> None:
    assert split_sentences("hold" + " " * 300_000 + "for 1 s  and  wait 2 s") == [
        "hold for 1 s",
        "wait 2 s",
    ]


def test_very_many_sentences_are_refused_at_once(tmp_path: Path) -> None:
    load = "load: {kind: history, sentences: '" + "x;" * 200_000 + "'}"
    said = refusal(tmp_path / "case.yaml", CASE.replace("load: {kind: step, force: 4 N}", load))
    assert "holds 200000 sentences" in said


def test_refusal_of_many_sentences_names_the_first_ten() -> None:
    with pytest.raises(ValueError, match=r"sentence 10.*and 90 more") as caught:
        pydantic.TypeAdapter(Sentences).validate_python("; ".join(["x"] * 100))
    assert "sentence 11" not in str(caught.value)


@pytest.mark.parametrize("tail", [",x" * 50_000, ',"' * 50_000 + "x"])
def test_commas_in_a_keyword_line_are_read_at_once(tail: str, tmp_path: Path) -> None:
    card = tmp_path / "card.inp"
    card.write_text(f"*MATERIAL, NAME=a\n*ELASTIC{tail}\n1e3, 0.3\n", encoding="utf-8")
    found = read_card(card, modulus_unit="MPa", time_unit="s")
    assert found.material.law.relaxation(0.0) == close_to(1e9 / 2.6)


def test_comma_within_quotation_marks_belongs_to_the_name(tmp_path: Path) -> None:
    card = tmp_path / "card.inp"
    card.write_text('*MATERIAL, NAME="a, b"\n*ELASTIC\n1e3, 0.3\n', encoding="utf-8")
    assert read_card(card, modulus_unit="MPa", time_unit="s").name == "a, b"


_KEYS = "a: &a {" + ", ".join(f"k{number}: 0" for number in range(9_000)) + "}\n"


@pytest.mark.parametrize(
    ("name", "text", "why"),
    [
        ("case.yaml", "[" * 500_000, "nested too deeply"),
        ("case.yaml", "a: [" + "0," * 400_000 + "0]", "lines and commas"),
        ("case.yaml", "#\r" * 400_000, "lines and commas"),  # a return alone ends a line, too
        ("case.yaml", "!" * 900_000, "too long for a tag"),
        ("case.yaml", "a: &a {b: 1}\n" + "c: {<<: *a}\n" * 60, "merges more than 50"),
        # Copies of keys: many keys a few times, in one list, by a tag in place of the sign.
        ("case.yaml", _KEYS + "b: {<<: *a}\n" * 49, "merges too many keys"),
        ("case.yaml", _KEYS + f"b: {{<<: [{', '.join(['*a'] * 900)}]}}", "merges too many keys"),
        ("case.yaml", _KEYS + "b: {!!merge c: *a}\n" * 49, "merges too many keys"),
        ("case.yaml", 'title: "\\ud800"', "half a character"),
        ("case.yaml", '"\\udfff": 1', "half a character"),
        ("case.yaml", "a: " + "x" * 1_500_000, "larger than 1 MB"),
        ("case.toml", "a=1\n" + "b." * 300_000 + "c=1", "case.toml:2: a key of more than 64 parts"),
        ("case.toml", '"a" . ' * 1000 + "c=1", "a key of more than 64 parts"),
        ("case.toml", "a=" + "9" * 5000, "not valid TOML"),
    ],
)
def test_text_that_is_no_case_is_refused_at_once(
    name: str, text: str, why: str, tmp_path: Path
) -> None:
    assert why in refusal(tmp_path / name, text)


@pytest.mark.slow
def test_as_many_values_as_a_case_may_have_are_read_at_once(tmp_path: Path) -> None:
    # Entries of two are the slowest form; with five times as many the parser took ten seconds.
    assert "many" in refusal(tmp_path / "case.yaml", CASE + "many:\n" + "- [0 s, 1 N]\n" * 6_600)


def test_more_values_than_a_case_may_have_are_refused_at_once(tmp_path: Path) -> None:
    assert "lines and commas" in refusal(tmp_path / "case.yaml", "many:\n" + "- [0, 1]\n" * 33_000)


def test_many_tables_of_one_name_keep_their_lines(tmp_path: Path) -> None:
    good = "[[indenter]]\nshape = 'sphere'\nradius = '1 mm'\n" * 2_000
    said = refusal(tmp_path / "case.toml", good + "[[indenter]]\nshape = 'x'\n")
    assert "case.toml:6002: indenter[2001].shape" in said


def test_only_the_first_of_very_many_problems_are_reported(tmp_path: Path) -> None:
    said = refusal(tmp_path / "case.yaml", CASE + "".join(f"k{i}: 1\n" for i in range(1000)))
    assert said.count("\n") == 200
    assert said.endswith("and 800 more")


def test_anchor_may_be_given_anew_without_a_word(tmp_path: Path) -> None:
    case = CASE.replace("size: [3 mm, 3 mm]", "size: [&a 3 mm, &a 3 mm]")
    (tmp_path / "case.yaml").write_text(case, encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read_case(tmp_path / "case.yaml").grid is not None


# --- files that are none ----------------------------------------------------------------------


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="Windows has no such pipes")
@pytest.mark.parametrize("name", ["case.yaml", "case.toml"])
def test_pipe_is_no_case_file(name: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / name)
    with pytest.raises(CaseError, match="is no file"):
        read_case(tmp_path / name)


def test_name_that_no_file_can_have_is_refused(tmp_path: Path) -> None:
    load = 'load: {kind: history, file: "a\\0.csv"}'
    said = refusal(tmp_path / "case.yaml", CASE.replace("load: {kind: step, force: 4 N}", load))
    assert "load.file: cannot read" in said or "load.file: no such file" in said


# --- histories and steps ----------------------------------------------------------------------


def test_swings_of_millions_of_steps_are_refused() -> None:
    load = vc.harmonic(mean=2.0, amplitude=1.0, period=1.0, cycles=100_000)
    with pytest.raises(ValueError, match="fewer cycles"):
        plan_steps(np.array([0.0, 1e5]), load)
    # A run that ends within them takes only those up to its end.
    assert len(plan_steps(np.array([0.0, 2.0]), load)) < MAX_STEPS / 1000


def test_steps_over_a_hundred_decades_are_refused() -> None:
    with pytest.raises(ValueError, match="decades"):
        plan_steps(np.array([1e-60, 1.0]), vc.step(1.0))


@pytest.mark.parametrize(
    ("place", "count"),
    [
        (0.0, 5_001),
        pytest.param(0.0, 20_001, marks=pytest.mark.slow),
        pytest.param("wandering", 1_001, marks=pytest.mark.slow),
    ],
)
def test_history_of_many_points_is_prepared_at_once(place: Any, count: int) -> None:
    times, force = np.linspace(0, 5, count), 1 + np.arange(count) % 7 / 7
    where = 1e-4 * np.sin(times) if place == "wandering" else place
    load = vc.ForceHistory(times, force, eccentricity_x=where)
    run = prepare_run(Problem(vc.Sphere(0.01), RUBBER, load, None, [0.0, 5.0]))
    # Hertz at the largest force and the compliance of the end, (1 - nu)/G = 1e-6 (1 - exp(-5)/2)
    radius = (0.75 * force.max() * 0.01 * run.problem.compliance(5.0)) ** (1 / 3)
    assert run.grid.size[1] / 2 == close_to(1.3 * radius, rel=0.05)


def test_jumps_and_cycles_are_the_same_when_asked_again() -> None:
    load = vc.ForceHistory([0, 1, 1, 2, 3], [0, 1, 2, 2, 0], tilt_x=[0, 0, 0, 0, 1e-3])
    assert load.jumps.tolist() == load.jumps.tolist() == [1.0]
    assert load == vc.ForceHistory([0, 1, 1, 2, 3], [0, 1, 2, 2, 0], tilt_x=[0, 0, 0, 0, 1e-3])


# --- Python calls -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "call",
    [
        lambda: vc.HeightMap([0, 1], [0, 1], [[0, 1e308], [0, 0]]),
        lambda: vc.Sphere(1.0).gap(10**400, 0.0),
        lambda: vc.FlatPunch(1.0).gap("a", 0.0),
        lambda: vc.Roller(1.0, 1.0).gap([{}], 0.0),
        lambda: vc.Elastic(1e6)(10**400),
        lambda: vc.log_times(0.1, 1.0, 10**18),
        lambda: vc.uniform_times(1.0, 1e12),
        lambda: vc.auto_grid(vc.Sphere(1.0), [], vc.step(1.0)),
        lambda: vc.auto_grid(3, RUBBER, vc.step(1.0)),
        lambda: vc.auto_grid(vc.Sphere(1.0), RUBBER, vc.step(1.0), tolerance="fine"),
        lambda: vc.simulate(vc.Sphere(1.0), RUBBER, vc.step(1.0), tolerance=10**400),
    ],
)
def test_junk_is_refused_with_a_word(call: Callable[[], Any]) -> None:
    with pytest.raises(ValueError, match=r"\w+"):
        call()


def test_contact_between_the_coarse_points_is_found() -> None:
    # A roller whose tilted contact runs along its whole length is 200 times as long as wide.
    roller = vc.Roller(5e-3, 9.565e-3, crown_radius=0.075)
    grid = vc.auto_grid(roller, RUBBER, vc.step(approach=1e-6, tilt_x=1e-4))
    assert grid.size[0] > 100 * grid.size[1]


def test_automatic_grid_of_millions_of_cells_is_refused() -> None:
    sphere, gel = vc.Sphere(0.01), vc.Material(vc.Elastic(1e7), 0.5)
    there_and_back = [5e-3, -5e-3]
    load = vc.ForceHistory([0.0, 1.0], [4.0, 4.0], there_and_back, there_and_back)
    with pytest.raises(ValueError, match="more than an automatic grid has"):
        # A contact that moves by twenty times its size, with 400 cells across.
        vc.auto_grid(sphere, gel, load, tolerance=1e-4)


def test_mean_of_a_table_over_twenty_decades_follows_its_line() -> None:
    table = vc.TabulatedCreep([1.0, 10.0, 100.0], [1e-6, 2e-6, 3e-6])
    compliance = vc.Material(table, 0.5).contact_compliance()
    # Beyond the last row 1e-6 per decade: the mean of its logarithm from 100 to b is ln(b/100) - 1
    expected = 3e-6 + 1e-6 * (np.log(1e20 / 100) - 1) / np.log(10)
    assert compliance.mean(100.0, 1e20) == close_to(0.5 * expected, rel=1e-12)


# --- cells as narrow as no grid that a person writes ---------------------------------------------


def test_check_of_a_roller_under_next_to_no_load_is_an_estimate(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    roller = "{shape: roller, radius: 5 mm, half_length: 9.565 mm, crown_radius: 75 mm}"
    case = CASE.replace("{shape: sphere, radius: 10 mm}", roller).replace("4 N", "1.5 nN")
    (tmp_path / "case.yaml").write_text(case, encoding="utf-8")
    # The cells of the estimate are 2e7 times as long as they are wide.
    main(["check", str(tmp_path / "case.yaml")])
    said = capsys.readouterr()
    assert "unexpected" not in said.err
    assert "peak pressure" in said.out


# --- memory -----------------------------------------------------------------------------------


def test_run_that_needs_more_memory_than_is_free_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # A power of time keeps a field of every step: more than its grid alone tells.
    law = "{law: power-law, compliance: 1e-3 / MPa, exponent: 0.3, reference_time: 1 s, "
    case = CASE.replace("{law: elastic, shear_modulus: 10 MPa, ", f"{law}instant: 1e-4 / MPa, ")
    case = case.replace("poisson_ratio", "data: shear, poisson_ratio").replace(
        "steps: 3", "steps: 900"
    )
    (tmp_path / "case.yaml").write_text(case.replace("[16, 16]", "[64, 64]"), encoding="utf-8")
    monkeypatch.setattr(preparation, "available_memory", lambda: 1.55e8)
    assert main(["check", str(tmp_path / "case.yaml")]) == 2
    assert "GB of memory" in capsys.readouterr().err


def test_memory_that_is_announced_grows_with_the_steps() -> None:
    few, many = (
        forecast(
            prepare_run(
                Problem(
                    vc.Sphere(0.01), RUBBER, vc.step(1.0), vc.Grid((16, 16), (6e-3, 6e-3)), times
                )
            )
        ).memory
        for times in (np.linspace(0, 1, 11), np.linspace(0, 1, 20_001))
    )
    # A step's own scalars are a few dozen numbers.
    assert many - few > 19_990 * 8 * 30
