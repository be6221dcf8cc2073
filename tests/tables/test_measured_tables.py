"""Measured tables: files of instruments, and refusals with line and column."""

from __future__ import annotations

import math
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import strategies as st

from closeness import close_to
from random_examples import given_few_or_many
from viscontact.laws import TabulatedCreep
from viscontact.tables import Table, read_table

# As exported: names, then units; 1 Hz is 2π rad/s and 0 °C is 273.15 K.
DMA = "f,E_stor,E_loss,T,Set\nHz, MPa, MPa, C, -\n0.5,8000.5,93,-50,0\n10,9000,218,-49.9,0\n"
PLAIN = "time [s], creep_compliance [1/MPa]\n1, 0.5\n10, 0.75\n"


def table(folder: Path, content: str | bytes, name: str = "data.csv", **options: object) -> Table:
    path = folder / name
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return read_table(path, **options)


def test_dma_export_of_two_header_rows_is_read_in_si(tmp_path: Path) -> None:
    found = table(tmp_path, DMA)
    assert found.data == "uniaxial"
    np.testing.assert_allclose(found["angular_frequency"], [math.pi, 20 * math.pi], rtol=1e-15)
    assert found["storage_modulus"].tolist() == [8000.5e6, 9e9]
    assert found["loss_modulus"].tolist() == [93e6, 218e6]
    assert found["temperature"].tolist() == [223.15, 223.25]
    assert found["set"].tolist() == [0.0, 0.0]
    assert found.lines.tolist() == [3, 4]
    assert found.headings["storage_modulus"] == "E_stor"
    # A row of units may end before the columns that have none.
    assert table(tmp_path, DMA.replace(", C, -\n", ", C\n"))["set"].tolist() == [0.0, 0.0]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252", "latin-1"])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_encoding_separator_and_line_ends_do_not_matter(
    encoding: str, separator: str, end: str, tmp_path: Path
) -> None:
    text = end.join(
        separator.join(row)
        for row in (("Zeit", "E'(t)", "Temperatur"), ("min", "MPa", "°C"), ("0.5", "2", "20"))
    )
    found = table(tmp_path, text.encode(encoding))
    assert {name: values.tolist() for name, values in found.columns.items()} == {
        "time": [30.0],
        "storage_modulus": [2e6],
        "temperature": [293.15],
    }


@pytest.mark.parametrize("separator", [";", "\t"])
def test_decimal_commas_are_read_where_commas_do_not_separate(
    separator: str, tmp_path: Path
) -> None:
    rows = ("t [ms]", "J [1/GPa]"), ("0,5", "1,25e1"), ("2", ",5")
    found = table(tmp_path, "\n".join(separator.join(row) for row in rows))
    assert found["time"].tolist() == [5e-4, 2e-3]
    np.testing.assert_allclose(found["creep_compliance"], [1.25e-8, 5e-10], rtol=1e-15)


def test_commas_before_blanks_separate(tmp_path: Path) -> None:
    """Columns that are set below each other, with a cell that is no number."""
    rows = "time [s],   E [MPa], remark\n1,          2.5,     5 s\n10,         2.0,     8 s\n"
    found = table(tmp_path, rows)
    assert found["time"].tolist() == [1.0, 10.0]
    assert found["relaxation_modulus"].tolist() == [2.5e6, 2e6]


def test_commas_in_headings_do_not_separate_where_semicolons_do(tmp_path: Path) -> None:
    found = table(tmp_path, "strain, total [%];t [s];D [1/MPa]\n1,5;2,5;3\n")
    assert found["time"].tolist() == [2.5]
    assert found.left_out == ("strain, total [%]",)


@pytest.mark.parametrize(
    "header",
    ["time [s], D [1/MPa]", "Time (s), D(t) (1/MPa)", "t/s, D / MPa^-1", "time in s,D in MPa⁻¹",
     '"time, [s]", "D [1/MPa]"', "t,D\ns,1/MPa", "t,D\n[s],[1/MPa]", "TIME [s],D [ 1/MPa ],,"],
)  # fmt: skip
def test_units_are_found_wherever_instruments_write_them(header: str, tmp_path: Path) -> None:
    columns = {"time, [s]": "time"} if '"' in header else None
    end = ",," if header.endswith(",,") else ""
    found = table(tmp_path, f"# a comment\n\n{header}\n% another\n3,4{end}\n", columns=columns)
    assert (found["time"].tolist(), found["creep_compliance"].tolist()) == ([3.0], [4e-6])
    assert found.data == "uniaxial"


@pytest.mark.parametrize(
    ("name", "unit", "quantity", "data"),
    [
        ("J", "1/Pa", "creep_compliance", "shear"),
        ("D(t)", "1/Pa", "creep_compliance", "uniaxial"),
        ("Φ", "1/Pa", "creep_compliance", "deviatoric"),
        ("creep compliance", "1/Pa", "creep_compliance", None),
        ("G", "Pa", "relaxation_modulus", "shear"),
        ("E(t)", "Pa", "relaxation_modulus", "uniaxial"),
        ("E_relax", "Pa", "relaxation_modulus", "uniaxial"),
        ("relaxation_modulus", "Pa", "relaxation_modulus", None),
        ("G'", "Pa", "storage_modulus", "shear"),
        ("G″", "Pa", "loss_modulus", "shear"),
        ('E"', "Pa", "loss_modulus", "uniaxial"),
        ("Storage Modulus", "Pa", "storage_modulus", None),
        ("tan(δ)", None, "loss_tangent", None),
        ("P", "N", "force", None),
        ("h", "m", "approach", None),
        ("tilt_x", "rad", "tilt_x", None),
    ],
)
def test_name_gives_the_quantity_and_its_test(
    name: str, unit: str | None, quantity: str, data: str | None, tmp_path: Path
) -> None:
    heading = name if unit is None else f"{name} [{unit}]"
    found = table(tmp_path, f"t [s]\t{heading}\n1\t2\n")
    assert found[quantity].tolist() == [2.0]
    assert found.data == data


@pytest.mark.parametrize(
    ("heading", "value"),
    [
        ("f [Hz]", 2 * math.pi),
        ("f [kHz]", 2e3 * math.pi),
        ("f [rad/s]", 1.0),
        ("f [1/s]", 2 * math.pi),
        ("omega [rad/s]", 1.0),
        ("ω [1/s]", 1.0),
        ("frequency [rpm]", 2 * math.pi / 60),
    ],
)
def test_frequency_arrives_in_radians_per_second(
    heading: str, value: float, tmp_path: Path
) -> None:
    found = table(tmp_path, f"{heading}\tG' [Pa]\n1\t2\n")
    np.testing.assert_allclose(found["angular_frequency"], [value], rtol=1e-12)


def test_logarithms_of_shift_factors_are_undone(tmp_path: Path) -> None:
    found = table(tmp_path, "T,log_aT\nC,-\n100,-2\n20,3\n")
    np.testing.assert_allclose(found["shift_factor"], [1e-2, 1e3], rtol=1e-14)
    natural = table(tmp_path, "T [K], ln_aT\n300, 1\n")
    np.testing.assert_allclose(natural["shift_factor"], [math.e], rtol=1e-15)


def test_length_in_millimetres_is_the_number_that_a_script_writes(tmp_path: Path) -> None:
    assert table(tmp_path, "time [s], approach [mm]\n1, 9.565\n")["approach"][0] == 0.009565


def test_unknown_columns_are_left_out_whatever_they_hold(tmp_path: Path) -> None:
    found = table(tmp_path, "t [s], remark, strain [%], D [1/Pa]\n1, good, x, 2\n")
    assert found.left_out == ("remark", "strain [%]")
    assert list(found.columns) == ["time", "creep_compliance"]
    with pytest.raises(ValueError, match=r"column force is missing; there are time .*'remark'"):
        found["force"]


def test_columns_argument_names_unknown_quantities(tmp_path: Path) -> None:
    text = "f [Hz], E [Pa], displacement [um], t [s]\n1, 2, 3, 4\n"
    stated = {"E": "storage_modulus", "displacement [um]": "approach", "t": None}
    found = table(tmp_path, text, columns=stated)
    assert list(found.columns) == ["angular_frequency", "storage_modulus", "approach"]
    assert found.data == "uniaxial"
    assert found["approach"].tolist() == [3e-6]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "data.csv is empty"),
        ("# only comments\n\n", "data.csv is empty"),
        ("time [s], D [1/Pa]\n", "has a header and no rows"),
        ("time,D\ns,1/Pa\n", "has a header and no rows"),
        ("1, 2\n3, 4\n", "data.csv:1: there is no header"),
        ("foo, bar\n3, 4\n", "none of the columns 'foo', 'bar' is known; names are e.g. time, "),
        ("time, D\n3, 4\n", "data.csv:1: column 'time': has no unit; write e.g. 'time [s]'"),
        ("time, D\n, \n3, 4", "column 'time': has no unit"),
        ("time, D\ns, -\n3, 4", "data.csv:2: column 'D': has no unit"),
        ("time [s], D [MPa]\n1, 2\n", "column 'D [MPa]': cannot read 'MPa' as a compliance (got"),
        ("time,D\ns,MPa\n1, 2\n", "data.csv:2: column 'D': cannot read 'MPa' as a compliance"),
        ("time [s], T [s]\n1, 2\n", "cannot read 's' as a temperature (got a time)"),
        ("time [s], Set [m]\n1, 2\n", "set has no unit, got 'm'"),
        ("omega [Hz], G' [Pa]\n1, 2\n", "an angular frequency is in rad/s, got 'Hz'"),
        ("omega [s], G' [Pa]\n1, 2\n", "cannot read 's' as a frequency"),
        ("f [Hz], E [Pa]\n1, 2\n", "'E [Pa]' is ambiguous with a frequency"),
        ("f [Hz], J [1/Pa]\n1, 2\n", "'J [1/Pa]' is ambiguous with a frequency"),
        ("t [s], time [ms]\n1, 2\n", "'t [s]' and 'time [ms]' are both time"),
        ("f [Hz], E' [Pa], G'' [Pa]\n1, 2, 3\n", "different tests, \"E' [Pa]\" (uniaxial) and"),
        ("t [s], relaxaton_modulus [Pa]\n1, 2\n", "did you mean 'relaxation_modulus'?"),
        ("time [s], D [1/Pa]\n1, 2\n3, nan\n", "data.csv:3: column 'D [1/Pa]': must be a finite"),
        ("time [s], D [1/Pa]\n1, inf\n", "data.csv:2: column 'D [1/Pa]': must be a finite number"),
        ("time [s], D [1/Pa]\n1, 1e999\n", "'1e999' is beyond all numbers"),
        ("T [K], log_aT\n1, 400\n", "'400' is beyond all numbers"),
        ("time [s], D [1/Pa]\n1, 2\n3, x\n", "data.csv:3: column 'D [1/Pa]': 'x' is not a number"),
        ("time [s], D [1/Pa]\n1, 1_0\n", "'1_0' is not a number"),
        ("time [s], D [1/Pa]\n1, \n", "data.csv:2: column 'D [1/Pa]': the cell is empty"),
        ("time [s], D [1/Pa]\n\n1, 2\n3\n", "data.csv:4 has 1 entries, the header 2"),
        ("time [s], D [1/Pa]\n0,5, 1\n", "has 3 entries, the header 2; decimal commas need semi"),
        ("time [s]; D [1/Pa]\n0,5; 1.234,5\n", "got '1.234,5' in a file of decimal commas"),
        ("time [s]; D [1/Pa]\n0,5; 1.5\n", "data.csv:2: column 'D [1/Pa]': got '1.5' in a file of"),
        (b"time [s], D\x00", "is no text file"),
        (b"\xff\xfet", "is no text file"),
        (bytes(range(256)), "is no text file"),
    ],
)  # fmt: skip
def test_errors_name_line_and_column(text: str | bytes, said: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r".") as refusal:
        table(tmp_path, text)
    assert said in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_missing_file_and_directory_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="no such file"):
        read_table(tmp_path / "none.csv")
    with pytest.raises(ValueError, match="is a directory"):
        read_table(tmp_path)
    if Path("/dev/zero").exists():
        with pytest.raises(ValueError, match="is no file"):
            read_table("/dev/zero")


@pytest.mark.parametrize(
    ("columns", "said"),
    [({"x": "time"}, "has no column 'x'"), ({"D": "strength"}, "'strength' is no quantity")],
)
def test_bad_meaning_of_a_column_is_refused(
    columns: dict[str, str], said: str, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=said):
        table(tmp_path, PLAIN.replace("creep_compliance", "D"), columns=columns)


def test_file_beyond_bounds_is_refused_unread(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viscontact.tables.splitting.MOST_ROWS", 2)
    with pytest.raises(ValueError, match="more than 2 rows"):
        table(tmp_path, PLAIN)
    monkeypatch.setattr("viscontact.tables.text._LARGEST_FILE", 20)
    with pytest.raises(ValueError, match="larger than"):
        table(tmp_path, PLAIN)


def test_sets_are_separated_by_their_number_in_the_files_order(tmp_path: Path) -> None:
    rows = "".join(f"{t},{9 - t},{s},{T}\n" for t, s, T in [(2, 7, 20), (1, 7, 20.2), (1, 3, 50)])
    first, second = table(tmp_path, f"t [s],E [Pa],Set,T [degC]\n{rows}").sets()
    assert (first.set_number, second.set_number) == (7.0, 3.0)
    assert first["time"].tolist() == [2.0, 1.0]
    assert first.temperature == close_to(293.25, abs=1e-12)
    assert second.lines.tolist() == [4]


def test_sets_without_numbers_are_separated_by_gaps_in_temperature(tmp_path: Path) -> None:
    temperatures = [20.0, 20.3, -50.0, -49.8, 19.9]
    rows = "".join(f"{i + 1},{T}\n" for i, T in enumerate(temperatures))
    near = "".join(f"{i},{20 + 3 * i}\n" for i in range(4))
    assert len(table(tmp_path, f"t [s],T [degC]\n{near}").sets()) == 4
    cold, warm = table(tmp_path, f"t [s],T [degC]\n{rows}").sets()
    assert cold["time"].tolist() == [3.0, 4.0]
    assert warm["time"].tolist() == [1.0, 2.0, 5.0]
    assert cold.set_number is None
    creeping = "".join(f"{i + 1},{0.5 * i}\n" for i in range(20))
    ramp = table(tmp_path, f"t [s],T [degC]\n{creeping}")
    with pytest.raises(ValueError, match="number the sets in a column Set"):
        ramp.sets()
    with pytest.raises(ValueError, match="are no single one"):
        _ = ramp.temperature
    [alone] = table(tmp_path, PLAIN).sets()
    assert alone.temperature is None
    assert alone.set_number is None


def test_one_test_under_a_varying_temperature_is_no_set_of_isotherms(tmp_path: Path) -> None:
    def of(
        times: list[float], celsius: list[float], heads: str = "t [s],J [1/MPa],T [degC]"
    ) -> Table:
        rows = "".join(f"{t},{1 + t},{T}\n" for t, T in zip(times, celsius, strict=True))
        return table(tmp_path, f"{heads}\n{rows}")

    steps = [20.0, 20.0, 20.0, 27.0, 27.0, 27.0]
    one = of([1, 2, 3, 4, 5, 6], steps)
    assert one.has_varying_temperature
    with pytest.raises(ValueError, match="is one test whose temperature varies from 20 to 27 °C"):
        one.sets()
    # Times that begin again, sets that take turns, and oscillations are sets.
    assert len(of([1, 2, 3, 1, 2, 3], steps).sets()) == 2
    assert len(of([1, 2, 3, 4, 5, 6], [20.0, 27.0] * 3).sets()) == 2
    three = [20.0, 20.0, 27.0, 27.0, 34.0, 34.0]
    assert len(of([1, 2, 1, 2, 1, 2], three).sets()) == 3
    with pytest.raises(ValueError, match=r"data.csv:5: time goes from 3 s back to 2.5 s, and goes"):
        of([1, 2, 3, 2.5, 4, 5], three).sets()
    assert not of([1, 2, 3, 4, 5, 6], steps, "t [s],G' [MPa],T [degC]").has_varying_temperature
    assert not of([1, 2, 3, 4, 5, 6], [20.0, 20.4, 20.2] * 2).has_varying_temperature


def test_refusal_of_a_row_names_its_line(tmp_path: Path) -> None:
    found = table(tmp_path, "time [s], J [1/Pa]\n# here is a comment\n1, 2\n2, 3\n3, 1\n")
    with pytest.raises(ValueError, match="row 2") as refusal:
        TabulatedCreep(found["time"].tolist(), found["creep_compliance"].tolist())
    assert "line 5 of data.csv: must not fall" in found.located(refusal.value)


def test_columns_cannot_be_written_to(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="read-only"):
        table(tmp_path, PLAIN)["time"][0] = 3.0


@given_few_or_many(
    100,
    200,
    st.lists(st.floats(-1e30, 1e30, allow_subnormal=False), min_size=1, max_size=5),
    st.sampled_from(["Pa", "MPa", "psi"]),
    st.booleans(),
)
def test_written_numbers_are_read_back(
    tmp_path_factory: pytest.TempPathFactory, values: list[float], unit: str, commas: bool
) -> None:
    cells = [repr(v).replace(".", ",") if commas else repr(v) for v in values]
    text = f"storage_modulus [{unit}];x\n" + "".join(f"{cell};\n" for cell in cells)
    found = table(tmp_path_factory.getbasetemp(), text, "back.csv")["storage_modulus"]
    factor = {"Pa": 1.0, "MPa": 1e6, "psi": 0.45359237 * 9.80665 / 0.0254**2}[unit]
    np.testing.assert_allclose(
        found, np.array(values) * factor, rtol=1e-15 if unit != "psi" else 1e-14
    )


TABLE = "time [s];E' [MPa];T [°C]\n0.5;3.0;20\n1.5;2.0;20\n1e5;1.0;20\n"
PIECES = st.sampled_from(
    ["time", "t", "f", "E'", "[s]", "(Pa)", " / ", "°C", "1/MPa", "MPa", "Set", "nan", "0,5", "1e5",
     "-", "#", '"', ";", ",", "\t", "\n", "\r", "x", "log_aT", "T", "[", "]", " in ", "Hz", "1.5"]
)  # fmt: skip
#: A table with a piece put in somewhere: by chance alone none of a hundred files is a table.
DAMAGED = st.builds(
    lambda at, piece: TABLE[:at] + piece + TABLE[at:],
    st.integers(0, len(TABLE)),
    st.sampled_from(["", "1", " "]) | PIECES,
)


@given_few_or_many(
    150,
    400,
    st.lists(PIECES, max_size=30).map("".join)
    | DAMAGED
    | st.text(max_size=40)
    | st.binary(max_size=40),
)
def test_any_file_is_a_finite_table_or_a_value_error(
    tmp_path_factory: pytest.TempPathFactory, content: str | bytes
) -> None:
    if isinstance(content, str):
        content = content.encode("utf-8", "surrogatepass")
    with suppress(ValueError):
        found = table(tmp_path_factory.getbasetemp(), content, "any.csv")
        assert all(np.isfinite(values).all() for values in found.columns.values())
        assert len(found) >= 1
        found.sets()
