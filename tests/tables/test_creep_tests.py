"""Creep data as datasheets give them: creep modulus, and strain at a stress (ISO 899-1)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from viscontact.tables import Table, read_table

# ISO 899-1:2017, 3.5: the tensile-creep modulus is the stress over the strain at the time.
COMPLIANCE = [1 / 2000e6, 1 / 1600e6]
COLUMN = "time [h];stress [MPa];strain [%]\n1;5;0,25\n10;5;0,3125\n1;10;0,6\n10;10;0,8\n"
HEADINGS = "time [h], strain at 5 MPa [%], strain at 10 MPa [%]\n1, 0.25, 0.6\n10, 0.3125, 0.8\n"


def read(folder: Path, text: str, **options: object) -> Table:
    path = folder / "creep.csv"
    path.write_text(text, encoding="utf-8")
    return read_table(path, **options)


@pytest.mark.parametrize(
    ("text", "stress"),
    [
        ("time [h], creep modulus [MPa]\n1, 2000\n10, 1600\n", None),
        ("time [h], E_c [GPa]\n1, 2.0\n10, 1.6\n", None),
        ("t;Kriechmodul\nh;N/mm²\n1;2000\n10;1600\n", None),
        ("time [h], tensile creep modulus (5 MPa) [MPa]\n1, 2000\n10, 1600\n", None),
        ("time [h], strain at 5 MPa [%]\n1, 0.25\n10, 0.3125\n", None),
        ("time [h], ε(σ = 5 N/mm²) [mm/m]\n1, 2.5\n10, 3.125\n", None),
        ("time;Dehnung bei 5 MPa\nh;%\n1;0,25\n10;0,3125\n", None),
        ("time [h], strain [-]\n1, 0.0025\n10, 0.003125\n", 5e6),
        (COLUMN, 5e6),
        (HEADINGS, 5e6),
        ("time [h], stress [MPa], strain [%]\n1, 5.02, 0.251\n10, 4.98, 0.31125\n", None),
    ],
)
def test_each_form_is_the_compliance_of_the_same_test(
    text: str, stress: float | None, tmp_path: Path
) -> None:
    found = read(tmp_path, text, stress=stress)
    assert found.data == "uniaxial"
    assert found["time"].tolist() == [3600.0, 36000.0]
    np.testing.assert_allclose(found["creep_compliance"], COMPLIANCE, rtol=1e-12)
    assert set(found.columns) == {"time", "creep_compliance"}


@pytest.mark.parametrize("text", [COLUMN, HEADINGS])
def test_of_several_stresses_the_chosen_one_is_read(text: str, tmp_path: Path) -> None:
    found = read(tmp_path, text, stress=10e6)
    np.testing.assert_allclose(found["creep_compliance"], [0.6e-9, 0.8e-9], rtol=1e-12)
    with pytest.raises(ValueError, match=r"holds tests at 5 MPa, 10 MPa; choose one"):
        read(tmp_path, text)
    with pytest.raises(ValueError, match=r"no test at 7 MPa; there are 5 MPa, 10 MPa"):
        read(tmp_path, text, stress=7e6)


def test_rows_at_a_stress_keep_their_lines_in_the_file(tmp_path: Path) -> None:
    assert read(tmp_path, COLUMN, stress=10e6).lines.tolist() == [4, 5]


def test_shear_strain_over_shear_stress_is_the_shear_compliance(tmp_path: Path) -> None:
    found = read(tmp_path, "time [s], shear strain [1], shear stress [kPa]\n1, 0.5, 2\n")
    assert found.data == "shear"
    assert found["creep_compliance"].tolist() == [2.5e-4]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("time [h], strain [%]\n1, 0.25\n", r"'strain \[%\]' needs the stress of the test"),
        ("time [h], strain\n1, 0.25\n", "a strain has one of the units .* it has none"),
        ("time [h], strain [mm]\n1, 0.25\n", "a strain has one of the units .* got 'mm'"),
        ("time [h], E_c [MPa]\n1, 0\n", r"creep.csv:2: column 'E_c .MPa.': '0' is no modulus"),
        ("time [h], E_c [mm]\n1, 2\n", "column 'E_c .mm.'"),
        ("time [h], stress [MPa], strain [%]\n1, 0, 0.2\n", "has a 0"),
        (
            "time [s], D [1/GPa], E_c [GPa]\n1, 1, 1\n",
            r"'D .1/GPa.' and 'E_c .GPa.' are both creep_compliance",
        ),
    ],
)
def test_creep_tests_that_cannot_be_read_are_refused(text: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=said):
        read(tmp_path, text)


def test_a_stress_without_a_strain_is_refused(tmp_path: Path) -> None:
    said = r"no strain of a creep test; there are 'time .s.', 'D .1/GPa.'; leave the stress out"
    with pytest.raises(ValueError, match=said):
        read(tmp_path, "time [s], D [1/GPa]\n1, 1\n", stress=5e6)


def test_the_strain_amplitude_of_an_oscillation_is_left_out(tmp_path: Path) -> None:
    """Instruments export it without a unit beside the moduli; it is no creep test."""
    found = read(tmp_path, "f [Hz], strain, G' [Pa], G'' [Pa]\n1, 0.1, 5, 2\n")
    assert found.left_out == ("strain",)
    assert found.data == "shear"


def test_a_missing_quantity_is_refused_with_the_headings_that_are_not_known(tmp_path: Path) -> None:
    table = read(tmp_path, "time [s], stiffness [MPa]\n1, 5\n")
    with pytest.raises(ValueError, match=r"there are time \('time \[s\]'\); not known: 'stiff"):
        _ = table["creep_compliance"]


@pytest.mark.parametrize("start", [b"PK\x03\x04\x14\x00", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"])
def test_a_spreadsheet_named_as_a_text_is_refused_with_what_to_do(
    start: bytes, tmp_path: Path
) -> None:
    path = tmp_path / "creep.csv"
    path.write_bytes(start + bytes(100))
    with pytest.raises(ValueError, match=r"creep.csv: a spreadsheet .*; the name of a spreadsheet"):
        read_table(path)


# Findley's law ε = σ (D_0 + D_1 t^n), linear in the stress: the compliance is known at each time.
HOURS = np.array([1.0, 10.0, 100.0, 1000.0])
FINDLEY = 1e-9 * (0.4 + 0.05 * (3600 * HOURS) ** 0.2)


def isochronous(first: str, second: str, *, comma: bool = False) -> str:
    """Curves of four times with points at 0, 2, 4 ... 10 MPa, or at 0, 0.5 ... 2.5 %."""
    if first == "stress":
        levels = np.arange(0.0, 11.0, 2.0)
        rows = [[at, *(100 * at * 1e6 * FINDLEY)] for at in levels]
        units = "MPa", "%"
    else:
        rows = [[strain, *(0.01 * strain / FINDLEY / 1e6)] for strain in np.arange(0, 3, 0.5)]
        units = "%", "MPa"
    heads = [f"{first} [{units[0]}]", *(f"{second}{h:g} h [{units[1]}]" for h in HOURS)]
    lines = [";".join(heads), *(";".join(f"{cell:.12g}" for cell in row) for row in rows)]
    return "\n".join(lines[:1] + [line.replace(".", "," if comma else ".") for line in lines[1:]])


@pytest.mark.parametrize("comma", [False, True])
@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("strain", "stress at "),
        ("strain", ""),
        ("stress", "strain at "),
        ("stress", "Dehnung nach "),
    ],
)
def test_isochronous_curves_give_the_compliance_at_a_stress(first, second, comma, tmp_path):
    table = read(tmp_path, isochronous(first, second, comma=comma), stress=3e6)
    assert table.data == "uniaxial"
    np.testing.assert_allclose(table["time"], 3600 * HOURS, rtol=1e-14)
    np.testing.assert_allclose(table["creep_compliance"], FINDLEY, rtol=1e-10)


def test_isochronous_curves_of_a_nonlinear_material_give_the_secant_at_the_stress(tmp_path):
    text = "strain [%],stress at 100 h [MPa],stress at 1 h [MPa]\n0.5,4,5\n1,7,9\n2,,15\n"
    table = read(tmp_path, text, stress=6e6)  # 0.5 % + 1/4 of 0.5 % at 1 h, + 2/3 at 100 h
    assert table["time"].tolist() == [3600.0, 360000.0]
    np.testing.assert_allclose(
        table["creep_compliance"], [0.00625 / 6e6, 0.005 * (1 + 2 / 3) / 6e6], rtol=1e-12
    )


def test_isochronous_curve_begins_at_the_origin(tmp_path):
    text = "strain [%],stress at 1 h [MPa]\n0.5,4\n1,7\n"
    table = read(tmp_path, text, stress=1e6)  # a quarter of the way to the first point
    np.testing.assert_allclose(table["creep_compliance"], [0.00125 / 1e6], rtol=1e-12)


@pytest.mark.parametrize(
    ("text", "stress", "why"),
    [
        ("strain [%],stress at 1 h [MPa]\n1,5\n", None, "need the stress at which the creep is"),
        ("strain [%],stress at 1 h [MPa]\n1,5\n", 6e6, "ends at 5 MPa; 6 MPa lies outside"),
        ("strain [%],stress at 1 h [MPa]\n1,5\n2,4\n", 3e6, "must increase from row to row"),
        ("strain [mm],stress at 1 h [MPa]\n1,5\n", 3e6, "a strain has one of the units"),
        ("strain [%],stress at 1 h [mm]\n1,5\n", 3e6, "cannot read 'mm' as a pressure"),
        ("strain [%],stress at 1 h [MPa]\n1,x\n", 3e6, "creep.csv:2: column 'stress at 1 h [MPa]'"),
        # A point beside decimal commas may separate thousands: 7.500 may be 7500.
        ("strain [%];stress at 1 h [MPa]\n0.5;4\n1;7,5\n", 3e6, "got '0.5' in a file of decimal"),
        ("strain [%];stress at 1 h [MPa]\n+,5e0;7.500\n", 3e6, "got '7.500' in a file of decimal"),
    ],
)
def test_faulty_isochronous_curves_are_refused(text, stress, why, tmp_path):
    with pytest.raises(ValueError, match=r"creep\.csv") as caught:
        read(tmp_path, text, stress=stress)
    assert why in str(caught.value)
