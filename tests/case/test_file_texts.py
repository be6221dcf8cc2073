"""Texts of case files: keys, values, spellings, and what is written back."""

from __future__ import annotations

import numpy as np
import pytest

from closeness import close_to
from viscontact.case import toml_source, yaml_source
from viscontact.case.aliases import _half, resolved, value_at
from viscontact.case.document import as_written
from viscontact.case.errors import dotted
from viscontact.case.indenters.shapes import Sphere, combined
from viscontact.case.loads.grammar import Form, read_form
from viscontact.case.loads.levels import Level, read_level
from viscontact.case.materials.layers import spelled_out
from viscontact.case.overrides import key_path
from viscontact.case.plain_names import is_plain_name
from viscontact.case.time_grid_output import (
    Output,
    early_fields,
    kept_fields,
    kept_speeds,
    with_instants,
)
from viscontact.case.tolerances import nominal
from viscontact.case.unknown_words import meanings, unknown_word
from viscontact.mechanics.time_integration.requested_times import adaptive_times


def test_diameter_is_half_as_a_radius_to_the_digit():
    ball = {"indenter": {"shape": "sphere", "diameter": "19.13 mm"}}
    assert resolved(ball).data == {"indenter": {"shape": "sphere", "radius": "9.565 mm"}}
    assert _half("19.13 mm", 0.01913) == "9.565 mm"


def test_value_at_a_path_is_none_where_there_is_none():
    assert value_at({"load": {"force": "1 N"}}, ("load", "force")) == "1 N"
    assert value_at({}, ("load", "force")) is None


@pytest.mark.parametrize("name", ["../pmma.csv", "C:pmma.csv", ".profile"])
def test_names_of_other_folders_are_not_plain(name):
    assert is_plain_name("pmma.csv")
    assert not is_plain_name(name)


def test_paths_are_as_in_the_file():
    steps = ("layers", 0, "material", "file")
    assert as_written({"layers": [{"file": "law.yaml"}]}, steps) == ("layers", 0, "file")
    assert dotted(("material", "times", 0)) == "material.times[1]"
    assert key_path("material.amplitudes[1]") == ("material", "amplitudes", 0)
    assert key_path("a..b") == ()


def test_one_shape_of_a_list_is_itself():
    assert combined([Sphere(shape="sphere", radius="5 mm")]).radius == 0.005


def test_slots_of_a_sentence_are_in_si_units():
    assert read_form("Wait for 2 min", [Form("hold", "hold|wait [for] TIME")]).slots == (120.0,)


def test_level_is_a_force_or_a_length():
    assert read_level("10 kN") == Level(10000.0, "force")
    assert read_level("-5 um").control == "approach"


def test_layer_with_a_law_has_a_material():
    spelled = spelled_out({"layers": [{"thickness": "5 mm", "law": "elastic"}]})
    assert spelled["layers"] == [{"thickness": "5 mm", "material": {"law": "elastic"}}]


def test_kept_fields_have_the_end_of_the_run():
    some = Output(fields=["0 s", "30 s"])
    assert kept_fields(some, np.array([0.0, 60.0])) == (0.0, 30.0, 60.0)
    adaptive = kept_fields(Output(), adaptive_times(10.0, tolerance=1e-3))
    assert adaptive[:3] == close_to((0.0, 0.01, 0.023713737056616554), rel=1e-12)
    assert early_fields(some, np.array([0.0, 45.0])) == (
        "output.fields ends at 30 s, before the run at 45 s; the fields of its end are kept as well"
    )
    assert with_instants(np.array([0.0, 1.0]), (0.0, 0.5)).tolist() == [0.0, 0.5, 1.0]


def test_kept_speeds_are_all_or_those_given():
    assert kept_speeds(Output(fields=["100 mm/s"]), (0.01, 0.1, 1.0)) == (0.1,)
    assert kept_speeds(Output(), (0.01, 0.1, 1.0)) == "all"


def test_numbers_with_a_tolerance_are_nominal():
    found = nominal({"indenter": {"shape": "sphere", "radius": "12 mm ± 0.02 mm"}})
    assert found.data == {"indenter": {"shape": "sphere", "radius": "12 mm"}}
    assert found.tolerances == {("indenter", "radius"): "12 mm ± 0.02 mm"}


@pytest.mark.parametrize(
    ("source", "text"),
    [(toml_source, '[load]\nforce = "10 kN"'), (yaml_source, "load:\n  force: 10 kN")],
)
def test_keys_of_a_file_have_their_lines(source, text):
    lines = {("load",): 1, ("load", "force"): 2}
    assert source.parse(text) == ({"load": {"force": "10 kN"}}, lines)


def test_unknown_words_are_answered_with_the_nearest():
    assert unknown_word("key", "nu", ["law", "poisson_ratio"]) == (
        "unknown key; did you mean 'poisson_ratio'? Allowed: law, poisson_ratio"
    )
    assert (meanings("Tau"), meanings("radius")) == ({"times": "", "time": ""}, {})


def test_comments_of_a_file_stay_when_values_change():
    text = "load:  # a step\n  force: 10 kN\n"
    changed = yaml_source.with_overrides(text, {("load", "force"): "20 kN"})
    assert changed == "load:  # a step\n  force: 20 kN\n"
    ordered = yaml_source.rewritten("b: 2 m  # long\na: 1\nc: 0", {"a": 1, "b": "3 m"})
    assert ordered == "b: 3 m  # long\na: 1\n"
    renamed = yaml_source.renamed("b: 4 m  # long", {("a",): ("b",)}, {"a": "2 m"})
    assert renamed == "a: 2 m  # long\n"
    assert yaml_source.write({"load": {"force": "20 kN"}}) == "load:\n  force: 20 kN\n"
