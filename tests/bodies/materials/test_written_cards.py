"""Cards of Abaqus and Ansys are written so that they read back."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viscontact as vc
from bodies.materials.card_texts import IN_MPA, IN_SI
from closeness import close_to
from viscontact.bodies.materials.cards import (
    Card,
    read_abaqus,
    read_ansys,
    write_abaqus,
    write_ansys,
)
from viscontact.laws import TabulatedShift

Writer = Callable[..., str]
WRITERS = pytest.mark.parametrize(
    ("write", "reader"), [(write_abaqus, read_abaqus), (write_ansys, read_ansys)]
)


def back(folder: Path, card: Card, write: Writer, reader: Callable[..., Any], **units: Any) -> Card:
    path = folder / "back.txt"
    path.write_text(write(card, **units), encoding="ascii")
    units.pop("moduli", None)
    [found] = reader(path, **units)
    assert isinstance(found, Card)
    return found


@WRITERS
@pytest.mark.parametrize("volume", [{"poisson_ratio": 0.38}, {"bulk_modulus": 4e9}])
@pytest.mark.parametrize(
    "law",
    [
        vc.Elastic(1e9),
        vc.Maxwell(1e9, 1e10),
        vc.Zener(1e9, 2e9, 1e10),
        vc.Burgers(1e9, 1e12, 2e9, 1e10),
        vc.CreepSeries(5.545e-10, [6.17e-11, 8.38e-11], [10.0, 133.87]),
        vc.RelaxationSeries(1e6, [1e9, 2e8, 3e7, 4e6], [1e-3, 0.1, 10.0, 1e4]),
    ],
)
def test_series_law_is_the_same_after_a_card(
    law: vc.Law, volume: dict[str, float], write: Writer, reader: Any, tmp_path: Path
) -> None:
    card = Card("A-1", vc.Material(law, **volume))
    found = back(tmp_path, card, write, reader, modulus_unit="MPa", time_unit="min")
    t = np.geomspace(1e-4, 1e5, 40)
    # 13 digits or more are printed; what is left in the end is 1e-3 of the modulus at once.
    np.testing.assert_allclose(found.material.law.relaxation(t), law.relaxation(t), rtol=1e-9)
    np.testing.assert_allclose(found.material.law(t), law(t), rtol=1e-9)
    if isinstance(law, vc.Elastic):
        return  # its bulk modulus is its Poisson's ratio
    for name, value in volume.items():
        assert getattr(found.material, name) == close_to(value, rel=1e-12)
    j, k = (m.contact_compliance()(t) for m in (found.material, card.material))
    np.testing.assert_allclose(j, k, rtol=1e-9)


@settings(max_examples=100, deadline=None)
@given(
    st.lists(st.tuples(st.floats(1e-3, 1e3), st.floats(1e-12, 1e12)), min_size=1, max_size=20),
    st.floats(1e-2, 1e3),
    st.floats(-0.9, 0.49),
    st.booleans(),
    st.sampled_from([(write_abaqus, read_abaqus), (write_ansys, read_ansys)]),
    st.sampled_from(["instantaneous", "long term"]),
)
def test_any_series_is_read_back_to_its_printed_digits(
    tmp_path_factory: pytest.TempPathFactory,
    terms: list[tuple[float, float]],
    equilibrium: float,
    ratio: float,
    elastic_bulk: bool,
    programs: tuple[Writer, Any],
    moduli: str,
) -> None:
    strengths, times = zip(*terms, strict=True)
    law = vc.RelaxationSeries(equilibrium, strengths, times)
    at_once = law.relaxation(0.0)
    bulk = 2 * at_once * (1 + ratio) / (3 * (1 - 2 * ratio))
    volume = {"bulk_modulus": bulk} if elastic_bulk else {"poisson_ratio": ratio}
    card = Card("x", vc.Material(law, **volume))
    options = {**IN_SI, "moduli": moduli} if programs[0] is write_abaqus else IN_SI
    found = back(tmp_path_factory.getbasetemp(), card, *programs, **options).material
    assert isinstance(found.law, vc.RelaxationSeries)
    # 13 digits of each weight, of which the end is what they leave of 1.
    loss = 20 * 1e-13 * (at_once / equilibrium)
    assert found.law.equilibrium == close_to(equilibrium, rel=loss)
    np.testing.assert_allclose(found.law.moduli, strengths, rtol=loss)
    np.testing.assert_allclose(found.law.times, times, rtol=1e-12)
    if elastic_bulk:
        # E and nu hold K by 1 - 2 nu only; long-term ones are nearer to 1/2.
        bound = loss + 1e-12 * (bulk / equilibrium + 1)
        assert found.bulk_modulus == close_to(bulk, rel=bound)
    else:
        assert found.poisson_ratio == close_to(ratio, rel=1e-12)


@WRITERS
def test_shift_is_the_same_after_a_card(write: Writer, reader: Any, tmp_path: Path) -> None:
    material = vc.Material(vc.Zener(1e9, 2e9, 1e10), 0.3)
    card = Card("1", material, vc.WLF(298.15, 17.44, 51.6))
    found = back(tmp_path, card, write, reader, **IN_MPA, temperature_unit="degC")
    assert found.shift == card.shift
    with pytest.raises(ValueError, match="give temperature_unit"):
        write(card, **IN_MPA)
    table = Card("1", material, TabulatedShift([280.0, 300.0], [10.0, 1.0]))
    with pytest.raises(ValueError, match="got TabulatedShift; fit one"):
        write(table, **IN_MPA, temperature_unit="K")


@WRITERS
@pytest.mark.parametrize("unit", ["K", "degF"])
def test_arrhenius_shift_is_the_same_after_a_card(
    write: Writer, reader: Any, unit: str, tmp_path: Path
) -> None:
    card = Card("1", vc.Material(vc.Zener(1e9, 2e9, 1e10), 0.3), vc.Arrhenius(293.15, 8e4))
    if write is write_ansys and unit != "K":
        with pytest.raises(ValueError, match="absolute temperatures"):
            write(card, **IN_MPA, temperature_unit=unit)
        return
    found = back(tmp_path, card, write, reader, **IN_MPA, temperature_unit=unit)
    assert isinstance(found.shift, vc.Arrhenius)
    assert found.shift.activation_energy == close_to(8e4, rel=1e-14)
    assert found.shift.reference_temperature == close_to(293.15, rel=1e-14)
    assert found.notes == ()


@pytest.mark.parametrize("volume", [{"poisson_ratio": 0.5}, {"poisson_ratio": 0.3}])
@pytest.mark.parametrize(
    "law",
    [
        vc.TabulatedCreep([0.0, 1.0, 10.0], [1e-9, 2e-9, 2.5e-9]),
        vc.TabulatedCreep([0.0, 1.0, 10.0], [1e-9, 2e-9, 2.5e-9], beyond="last"),
        vc.TabulatedRelaxation([0.0, 1.0, 10.0], [3e9, 2e9, 1e9]),
        vc.TabulatedRelaxation([0.5, 1.0, 10.0], [3e9, 2e9, 1e9], beyond="last"),
    ],
)
def test_table_is_written_as_test_data_and_read_back(
    law: vc.Law, volume: dict[str, float], tmp_path: Path
) -> None:
    card = Card("T", vc.Material(law, **volume))
    found = back(tmp_path, card, write_abaqus, read_abaqus, **IN_MPA).material
    t = np.array([0.0, 0.3, 0.5, 1.0, 5.0, 10.0, 50.0])
    assert type(found.law) is type(law)
    assert found.poisson_ratio == volume["poisson_ratio"]
    # A table is the same to the digits, and what is interconverted from creep. Creep by relaxation
    # has the error it tells, some 1e-5, which depends on where the table begins.
    inverted = 2 * (law.inversion_error + found.law.inversion_error)
    creep = isinstance(law, vc.TabulatedCreep)
    np.testing.assert_allclose(found.law(t), law(t), rtol=1e-9 if creep else inverted)
    np.testing.assert_allclose(found.law.relaxation(t), law.relaxation(t), rtol=1e-9)


def test_what_is_no_series_is_refused_with_a_remedy() -> None:
    fractional = Card("F", vc.Material(vc.FractionalZener(3e6, 1e6, 2.0, 0.5), 0.5))
    table = Card("T", vc.Material(vc.TabulatedCreep([1.0, 2.0], [1e-9, 2e-9]), 0.5))
    for write, card in (
        (write_abaqus, fractional),
        (write_ansys, fractional),
        (write_ansys, table),
    ):
        with pytest.raises(ValueError, match=r"takes a Prony series.* fit one first"):
            write(card, **IN_MPA)
    sloped = vc.TabulatedCreep([1.0, 2.0], [1e-9, 2e-9], before="slope")
    with pytest.raises(ValueError, match="needs the instantaneous modulus"):
        write_abaqus(Card("T", vc.Material(sloped, 0.5)), **IN_MPA)
    with pytest.raises(ValueError, match="instant"):  # a Kelvin body has no modulus at once
        write_ansys(Card("K", vc.Material(vc.CreepSeries(0.0, [1e-9], [1.0]), 0.5)), **IN_MPA)
    fluid = Card("M", vc.Material(vc.Maxwell(1e9, 1e9), 0.5))
    with pytest.raises(ValueError, match="a fluid has no long-term moduli"):
        write_abaqus(fluid, **IN_MPA, moduli="long term")
    with pytest.raises(ValueError, match="moduli: must be"):
        write_abaqus(fluid, **IN_MPA, moduli="short")
    with pytest.raises(ValueError, match="1 to 80 plain characters"):
        write_abaqus(Card("x\n*STEP", fluid.material), **IN_MPA)
    with pytest.raises(ValueError, match="number must be a whole number >= 1"):
        write_ansys(fluid, **IN_MPA, number=0)


def test_fields_of_abaqus_are_no_wider_than_it_reads() -> None:
    law = vc.RelaxationSeries(1 / 3e-7, [1e9 / 7, 2e-5 / 9], [1 / 3e-9, 1e17 / 7])
    text = write_abaqus(Card("odd name", vc.Material(law, 1 / 3)), **IN_MPA)
    assert '*MATERIAL, NAME="odd name"\n' in text
    data = [line for line in text.splitlines() if not line.startswith("*")]
    assert max(len(field) for line in data for field in line.split(", ")) <= 20
    assert text.isascii()
