"""Verification cases: passing, failing, and their table."""

import csv
import math
from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest

from campaigns import tried
from closeness import close_to
from returned import some
from viscontact.backend.errors import ConvergenceError
from viscontact.bodies.materials.material import Material
from viscontact.cli import main
from viscontact.laws import Zener
from viscontact.verify import CASES, Case, Comparison, Quantity, run_cases, write_table
from viscontact.verify.case import observed_order, run_case
from viscontact.verify.creeping import G, all_bodies, zener
from viscontact.verify.growing import _step

#: Those that take long in their fast form, or whose law or load a shorter case has as well.
LONG = (
    *("approach triangle", "approach haversine", "force haversines", "contact lost"),
    *("flat punch, harmonic", "TabulatedRelaxation", "TabulatedCreep", "FractionalZener"),
    *("cylinder from rest", "reciprocating wave", "under a ramp", "force triangle"),
    *("force, CreepSeries", "force, RelaxationSeries", "force, Maxwell", "force, Burgers"),
    "sudden force, PowerLaw",
    *("slow steady", "fast steady motion, V", "moving wave in full contact"),
    *("Tabor number 0.1", "Tabor number 0.5", "Tabor number 0.7", "Tabor number 1"),
    *("that adheres, shortest range", "that adheres, long range", "that adheres, on a stage"),
    *("Hertz's pressure", "parabolic pressure", "conical pressure", "moving wave of pressure"),
    *("long roller that drives", "work of a cycle"),
    *("cylinder that adheres", "waves that adhere", "punch that adheres", "receding edge"),
)

#: Those whose finest form takes longest, and the like of which are computed in full: in a whole
#: campaign only.
LONGEST = ("cylinder that adheres", "Tabor number 0.5", "Tabor number 0.7")[: tried(3, 0)]

BALL = CASES[0]


def off_by(error, name="a ball"):
    """A case whose error falls from 4 to 1 times a given one."""

    def compare(level):
        return (Comparison(1.0, 1.0 + error, 4 * error / level),)

    return Case(name, "Hertz 1882", (Quantity("approach", "m", 0.1, 0.01),), (1, 2, 4), compare)


def named(cases):
    return [pytest.param(case, id=case.name) for case in some(cases)]


def passed(case, *, fast):
    """Results of a case, all of which are within their bounds."""
    results = run_case(case, fast=fast)
    assert len(results) == len(case.quantities) > 0
    assert [result for result in results if not result.passed] == []
    return results


@pytest.mark.parametrize(
    "case", named([case for case in CASES if not any(part in case.name for part in LONG)])
)
def test_case_is_within_its_fast_bounds(case):
    passed(case, fast=True)


def has_smooth_order(case, quantity):
    """True for what is of second order; the sub-cell rim is of order one to two."""
    smooth = quantity in ("approach", "force", "residual displacement")
    return smooth and "punch" not in case.name


@pytest.mark.slow
@pytest.mark.parametrize("case", named(CASES))
def test_case_is_within_its_bounds_with_the_expected_order(case):
    """The fast form, too, of which a long case is computed here only."""
    once = replace(case, compare=cache(case.compare))
    passed(once, fast=True)
    is_longest = any(part in case.name for part in LONGEST)
    orders = {
        result.quantity: result.order
        for result in ([] if is_longest else passed(once, fast=False))
        # There is no order where the error is that of the solver's tolerance.
        if has_smooth_order(case, result.quantity) and not math.isnan(result.order)
    }
    assert {name: order for name, order in orders.items() if not 1.6 < order < 2.6} == {}


def test_many_cases_state_an_order():
    smooth = [
        (case.name, quantity.name)
        for case in CASES
        for quantity in case.quantities
        if has_smooth_order(case, quantity.name) and quantity.has_order and len(case.levels) > 1
    ]
    assert len(smooth) > 20


def test_every_law_has_its_case():
    names = {body.name for body in all_bodies()}
    assert names >= {
        *("Elastic", "Maxwell", "Zener", "Burgers", "CreepSeries", "RelaxationSeries"),
        *("PowerLaw", "FractionalMaxwell", "FractionalZener"),
        *("TabulatedCreep", "TabulatedRelaxation"),
    }
    assert len({case.name for case in CASES}) == len(CASES)


def test_creep_and_relaxation_of_each_body_are_inverse():
    """∫ J(t - t') dM(t') = 1 (Boltzmann): what the cases trust, by a plain product rule."""
    for body in some(all_bodies()):
        end = min(body.end, 300.0)
        edges = end * np.linspace(0, 1, 4001) ** 2
        modulus = body.relaxation(edges)
        lags = end - (edges[1:] + edges[:-1]) / 2
        total = body.creep(np.array([end]))[0] * modulus[0] + body.creep(lags) @ np.diff(modulus)
        assert total == close_to(1.0, abs=2e-3), body.name


def test_a_law_that_is_one_percent_off_fails():
    wrong = Material(Zener(2.02 * G, 2.02 * G, 202 * G), 0.5)
    (case,) = (case for case in CASES if case.name == "ball under a sudden force, Zener")
    twisted = replace(case, compare=partial(_step, replace(zener(), material=wrong)))
    assert not any(result.passed for result in some(run_case(twisted, fast=True)[:2]))


def test_an_error_beyond_its_bound_fails_and_order_is_the_slope():
    # At the finest of three levels the error is the given one, at the finer of two twice that.
    (full,) = run_cases(cases=[off_by(0.02)])
    assert (full.error, full.bound, full.passed) == (0.02, 0.01, False)
    assert full.order == close_to(1.0)
    (fast,) = run_cases(cases=[off_by(0.02)], fast=True)
    assert (fast.error, fast.bound, fast.passed) == (0.04, 0.1, True)


def test_no_order_is_claimed_at_the_solver_s_tolerance():
    assert math.isnan(observed_order((1, 2, 4), [1e-6, 1e-9, 1e-9]))
    assert math.isnan(observed_order((1,), [1e-3]))


def test_a_case_that_stops_is_a_failure_with_its_reason():
    def compare(level):
        raise ConvergenceError(f"stopped at {level}")

    (result,) = run_cases(cases=[replace(off_by(0.0), compare=compare)])
    assert not result.passed
    assert math.isnan(result.error)
    assert result.failure == "stopped at 1"


@pytest.fixture
def two_cases(monkeypatch):
    """The command with one real case, and one more."""

    def use(other):
        monkeypatch.setattr(
            "viscontact.cli.results.verification_table.run_cases",
            partial(run_cases, cases=[BALL, other]),
        )

    return use


def test_the_command_ends_with_0_only_if_all_pass(two_cases, capsys):
    two_cases(off_by(1e-4))
    assert main(["verify", "--fast"]) == 0
    said = capsys.readouterr()
    assert "Hertz 1882" in said.out
    assert "11.2035 µm" in said.out  # of a ball of 10 mm under 10 N, E* = 2 GPa
    assert "4 of 4 within their bounds" in said.out
    assert "case 1/2: sphere" in said.err
    two_cases(off_by(0.5, "a brick"))
    assert main(["verify", "--fast"]) == 1
    said = capsys.readouterr()
    assert "FAILED" in said.out
    assert "1 comparisons with exact solutions failed" in said.err


def test_the_table_is_written_to_the_given_file(two_cases, capsys, tmp_path):
    two_cases(off_by(1e-4))
    assert main(["verify", "--fast", "-o", str(tmp_path / "table.md")]) == 0
    lines = (tmp_path / "table.md").read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("| case | reference | quantity |")
    assert {line.count("|") for line in lines} == {10}
    assert len(lines) == 2 + 4
    assert main(["verify", "--fast", "-o", str(tmp_path / "table.csv")]) == 0
    with (tmp_path / "table.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["passed"] for row in rows] == ["True"] * 4
    assert float(rows[0]["exact"]) == close_to(1.12035e-5, rel=1e-5)


@pytest.mark.parametrize("name", ["table.txt", "missing/table.md"])
def test_a_bad_file_for_the_table_is_refused_before_any_run(name, tmp_path, capsys):
    assert main(["verify", "-o", str(tmp_path / name)]) == 2
    said = capsys.readouterr()
    assert name in said.err
    assert said.out == ""


def test_write_table_names_the_known_suffixes(tmp_path):
    with pytest.raises(ValueError, match=r"\.md or \.csv"):
        write_table([], tmp_path / "table.html")
