"""Quantities in words become SI numbers, SI numbers readable words; what is wrong is explained."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np
import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

import viscontact
from closeness import close_to
from viscontact.results.stated_errors import is_rounding_tilt
from viscontact.units.common_units import COMMON_UNITS
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.formatting import format_number, format_quantity, readable_unit
from viscontact.units.parsing import parse_quantity


# Values from the definitions of the units (SI brochure, 9th edition; the inch is 25.4 mm and the
# pound-force 4.4482216152605 N exactly).
@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("5 mm", "length", 0.005),
        ("9.565mm", "length", 0.009565),
        ("-4.78 mm", "length", -0.00478),
        ("3 µm", "length", 3e-6),
        ("1 in", "length", 0.0254),
        ("10kN", "force", 1e4),
        ("1 lbf", "force", 4.4482216152605),
        ("2 min", "time", 120.0),
        ("1.5e3 s", "time", 1500.0),
        ("1 h", "time", 3600.0),
        ("180 deg", "angle", math.pi),
        ("1 mrad", "angle", 1e-3),
        ("1800 MPa", "pressure", 1.8e9),
        ("2 N/mm^2", "pressure", 2e6),
        ("2 mm2", "area", 2e-6),
        ("2 N/mm2", "pressure", 2e6),
        ("5.545e-4 / MPa", "compliance", 5.545e-10),
        ("5.545e-4 1/MPa", "compliance", 5.545e-10),
        ("5.545e-4 MPa^-1", "compliance", 5.545e-10),
        ("5.545e-4 MPa⁻¹", "compliance", 5.545e-10),
        ("10 GPa s", "viscosity", 1e10),
        ("10 GPa·s", "viscosity", 1e10),
        ("1e-6 / (MPa s)", "fluidity", 1e-12),
        ("50 kHz", "frequency", 5e4),
        ("60 rpm", "angular frequency", 2 * math.pi),
        ("60 degC", "temperature", 333.15),
        ("-40 °F", "temperature", 233.15),  # where both scales meet
        ("0 K", "temperature", 0.0),
        ("51.6 degC", "temperature difference", 51.6),
        ("18 degF", "temperature difference", 10.0),
        ("80 kJ/mol", "molar energy", 8e4),
    ],
)
def test_quantity_in_words_is_its_si_value(text: str, dimension: str, value: float) -> None:
    # a few last digits: π and the pound are not exact in binary
    assert parse_quantity(text, dimension) == close_to(value, rel=4e-16)


def test_a_length_in_millimetres_is_exactly_the_number_that_a_script_writes() -> None:
    assert parse_quantity("9.565 mm", "length") == 0.009565
    assert parse_quantity("4.7825 mm", "length") == 0.0047825


@pytest.mark.parametrize(
    ("text", "dimension", "said"),
    [
        ("10 MPa", "force", "cannot read '10 MPa' as a force (got a pressure); write e.g. '10 kN'"),
        ("3 kg", "force", "got a mass"),
        ("20 degC", "length", "got a temperature"),
        ("5 %", "angle", "got a plain ratio"),
        ("5 mm", "temperature", "got a length"),
        ("20 degree_Reaumur", "temperature", "got a temperature"),
        ("10 Hz", "angular frequency", "got a frequency or a rate"),
        ("10 rad/s", "frequency", "got an angular frequency"),
        ("10", "force", "10 has no unit; a force is expected; write e.g. '10 kN'"),
        ("kN", "force", "no number in front"),
        ("10 Kn", "force", "unknown unit 'Kn' (did you mean 'kN'?)"),
        ("5 mm!", "length", "unknown unit 'mm!'"),
        ("1,5 mm", "length", "write a decimal point"),
        ("nan N", "force", "not a finite number"),
        ("-inf N", "force", "not a finite number"),
        ("1e999 N", "force", "not a finite number"),
        ("1e99999999999 N", "force", "not a finite number"),
        ("", "time", "no number in front"),
    ],
)
def test_unreadable_quantity_is_explained(text: str, dimension: str, said: str) -> None:
    with pytest.raises(ValueError, match=r".") as refusal:
        parse_quantity(text, dimension)
    assert said in str(refusal.value)


@pytest.mark.parametrize("text", ["5 9**9**9", "5 m**9**9**9**9", "5 " + "m*" * 40 + "m"])
def test_unit_that_would_be_evaluated_for_ever_is_refused_at_once(text: str) -> None:
    with pytest.raises(ValueError, match="unknown unit"):
        parse_quantity(text, "length")


@given(text=st.text(max_size=30), dimension=st.sampled_from(sorted(DIMENSIONS)))
def test_any_text_is_a_finite_number_or_a_value_error(text: str, dimension: str) -> None:
    value = 0.0
    with suppress(ValueError):
        value = parse_quantity(text, dimension)
    assert math.isfinite(value)


@pytest.mark.parametrize(
    ("value", "unit", "words"),
    [
        (1.672e-4, "m", "167.2 µm"),
        (0.009565, "m", "9.565 mm"),
        (1.083e-4, "m2", "108.3 mm²"),
        (1.2e-14, "m2", "0.012 µm²"),  # from 1e4 nm² on
        (0.9e-14, "m2", "9000 nm²"),
        (7e-7, "m2", "0.7 mm²"),
        (2.596e-17, "J", "25.96 aJ"),  # a tip of 20 nm pressed 10 nm deep
        (3e-11, "N", "30 pN"),
        (4e-10, "m", "0.4 nm"),
        (152.2e6, "Pa", "152.2 MPa"),
        (10e3, "N", "10 kN"),
        (1000.0, "s", "1000 s"),
        (7200.0 * 10, "s", "20 h"),
        (0.949e-3, "rad", "949 µrad"),
        (0.0, "Pa", "0 Pa"),
        (7.0, "1", "7"),
    ],
)
def test_si_number_in_words(value: float, unit: str, words: str) -> None:
    assert format_quantity(value, unit) == words


def test_values_that_differ_by_rounding_print_alike() -> None:
    apart = (4.7825 * (1 - 1e-12), 4.7825 * (1 + 1e-12))
    assert len({f"{value:.4g}" for value in apart}) == 2
    assert len({format_number(value) for value in apart}) == 1


@given(
    value=st.floats(min_value=1e-8, max_value=9e9),
    unit=st.sampled_from(["m", "m2", "N", "Pa", "J", "rad"]),
)
def test_readable_unit_and_number_give_the_value_back(value: float, unit: str) -> None:
    readable = readable_unit(unit, value)
    printed = float(format_number(value / readable.factor, 6))
    # six digits printed: half of the sixth is lost
    assert printed * readable.factor == close_to(value, rel=5.1e-6)


def test_tilt_is_rounding_by_what_it_moves_not_by_its_size() -> None:
    # A tip of a microscope: 1e-8 rad lift the ends of 20 nm by 1e-16 m, of a depth of 1 nm.
    assert is_rounding_tilt([1e-8], contact_length=[20e-9], approach=[1e-9])
    # A long roller pressed lightly: 5e-10 rad lift the ends of 1 m by 0.25 nm, of 10 nm.
    assert not is_rounding_tilt([np.nan, -5e-10], contact_length=[0.0, 1.0], approach=[0, 1e-8])


def test_pint_is_imported_only_for_a_unit_that_is_not_common() -> None:
    code = (
        "import sys\nfrom viscontact.units.parsing import parse_quantity\n"
        "for text in ('5 mm', '2 um', '2 furlong'):\n"
        "    print(parse_quantity(text, 'length'), 'pint' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    imported = [line.split()[1] for line in done.stdout.splitlines()]
    assert imported == ["False", "False", "True"]


@pytest.mark.parametrize("unit", COMMON_UNITS)
def test_common_unit_has_the_value_and_dimension_that_pint_gives(unit: str) -> None:
    factor, base = COMMON_UNITS[unit]
    one = pint.get_application_registry()(unit if unit[0] != "/" else f"1 {unit}").to_base_units()
    assert (float(one.magnitude), str(one.units)) == (factor, base)


# A number that is formatted by so many digits and followed by an SI unit: "1.04e-09 m".
RAW = re.compile(r":(?:\.\d+)?[eg]\} /?(?:m|s|N|Pa)\b")
# What a law gives may be NaN; a file in bare numbers is read back; a film's length is asked for;
# the headings of a table of SI numbers are in SI.
MAY_BE_RAW = {
    "problem_checks.py",
    "material_writing.py",
    "animation.py",
    "page.py",
    "history_csv.py",
}


def test_messages_give_lengths_times_forces_and_pressures_in_readable_units() -> None:
    package = Path(viscontact.__file__).parent
    found = [
        f"{path.relative_to(package)}:{number}: {line.strip()}"
        for path in sorted(package.rglob("*.py"))
        if path.name not in MAY_BE_RAW and not {"reference", "verify"} & set(path.parts)
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)
        if RAW.search(line) and ">>>" not in line
    ]
    assert found == []
