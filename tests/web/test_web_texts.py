"""Texts of the page: labels, file names, dark drawings, problems."""

from __future__ import annotations

from pathlib import Path

from viscontact.web.cases.case_reader import filled
from viscontact.web.workspace.naming import _layers, file_stem, label_of
from viscontact.web.workspace.pictures import on_dark
from viscontact.web.workspace.problems import InputProblem, problem_of


def test_label_of_a_run_states_what_differs_from_the_first() -> None:
    first = {"load": {"force": "1 N"}, "grid": {"shape": [8, 8]}}
    found = label_of("Ball", {"load": {"force": "2 N"}}, first, {"Ball"})
    assert found == "Ball, force 2 N, without grid"
    assert label_of("Ball", first, first, {"Ball"}) == "Ball (2)"
    titled = {"title": "Ball", **first, "load": {"force": "2 N"}}
    assert label_of("Ball", titled, first, {"Ball"}) == "Ball, force 2 N"


def test_file_name_has_letters_digits_and_hyphens_only() -> None:
    assert file_stem("Ball, force 2.5 N", "coarse") == "ball-force-2-5-n-coarse"
    long = file_stem(f"Ball {'x' * 300}, force 2.5 N", "")
    assert (len(long) <= 80, long[:6], long[-12:]) == (True, "ball-x", "-force-2-5-n")


def test_layers_are_named_by_the_uppermost() -> None:
    assert _layers([{"thickness": "8 mm", "material": "epdm-70-25c"}]) == "8 mm epdm-70-25c"


def test_lightness_is_inverted_on_a_dark_page() -> None:
    found = on_dark(b'<svg ><path style="fill: #ffffff; stroke: #000000"/></svg>')
    assert found == b'<svg fill="#ffffff" ><path style="fill: #1f1f1f; stroke: #ffffff"/></svg>'


def test_problem_has_message_key_and_line() -> None:
    found = problem_of("a/case.yaml:6: load.force: cannot read it", Path("a/case.yaml"))
    assert found == InputProblem(message="cannot read it", path="load.force", line=6)
    found = problem_of("a/case.yaml: a/pmma.csv: no such file", Path("a/case.yaml"))
    assert found == InputProblem(message="pmma.csv: no such file", path="", line=None)


def test_empty_values_of_the_form_are_left_out() -> None:
    values = {"title": "", "load": {"force": "1 N", "tilt_x": None}, "grid": {}}
    assert filled(values) == {"load": {"force": "1 N"}}
