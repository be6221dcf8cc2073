"""Text files of instruments, imitated: what they write above, beside and between their columns."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from viscontact.tables import Table, read_table

#: Two rows of an oscillation: angular frequency [rad/s], storage and loss modulus [Pa].
SWEEP = ((10.0, 289.2, 9.17), (1.0, 178.5, 41.5))


def table(folder: Path, text: str, encoding: str = "utf-8", **options: object) -> Table:
    path = folder / "export.txt"
    path.write_bytes(text.encode(encoding))
    return read_table(path, **options)


def refusal(folder: Path, text: str, **options: object) -> str:
    with pytest.raises(ValueError, match=r".") as refused:
        table(folder, text, **options)
    return str(refused.value)


def lines(*rows: str) -> str:
    return "\n".join(rows) + "\n"


def require_sweep(found: Table) -> None:
    expected = np.array(SWEEP).T
    for name, values in zip(
        ("angular_frequency", "storage_modulus", "loss_modulus"), expected, strict=True
    ):
        np.testing.assert_allclose(found[name], values, rtol=1e-12)


def test_step_of_trios_is_read_below_its_sections(tmp_path: Path) -> None:
    text = lines(
        "Filename\tgel.tri",
        "Instrument name\tHR 20",
        "Sample density\t1.0 g/cm^3",
        "[Parameters]",
        "Temperature\t25 °C",
        "[step]",
        "Frequency sweep - 1",
        "Angular frequency\tStorage modulus\tLoss modulus\tTan(delta)\tTemperature\tStep time",
        "rad/s\tPa\tPa\t\t°C\ts",
        *(f"{w}\t{g}\t{h}\t{h / g}\t25.0\t{k}" for k, (w, g, h) in enumerate(SWEEP)),
    )
    found = table(tmp_path, text)
    require_sweep(found)
    assert found.lines.tolist() == [10, 11]
    assert found.left_out == ("Step time",)


def test_two_steps_of_trios_with_other_columns_are_refused_with_their_lines(tmp_path: Path) -> None:
    text = lines(
        "[step]",
        "Stress relaxation",
        "Step time\tModulus\tTemperature",
        "s\tPa\t°C",
        "1\t200\t25",
        "[step]",
        "Frequency sweep",
        "Angular frequency\tStorage modulus\tLoss modulus",
        "rad/s\tPa\tPa",
        "1\t200\t20",
    )
    said = refusal(tmp_path, text)
    assert "several tables, with headings in the lines 3, 8; save the one that is meant" in said


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-8-sig", "cp1252"])
def test_intervals_of_rheocompass_are_one_table(encoding: str, tmp_path: Path) -> None:
    def interval(temperature: str) -> list[str]:
        return [
            "Interval data:\tPoint No.\tAngular Frequency\tStorage Modulus\tLoss Modulus"
            "\tTemperature\tStatus",
            "\t\t\t\t\t\t",
            "\t\t[rad/s]\t[Pa]\t[Pa]\t[°C]\t",
            *(
                f"\t{k}\t{w}\t{g}\t{h}\t{temperature}\tDy_auto".replace(".", ",")
                for k, (w, g, h) in enumerate(SWEEP, start=1)
            ),
            "",
        ]

    text = lines(
        "Project:\tgel",
        "Test:\tgel A",
        "Result:\tFrequency sweep 1",
        "Interval and data points:\t2\t2\t2",
        *interval("20.0"),
        "Result:\tFrequency sweep 2",
        *interval("40.0"),
    )
    found = table(tmp_path, text, encoding)
    assert found["temperature"].tolist() == [293.15, 293.15, 313.15, 313.15]
    assert found.lines.tolist() == [8, 9, 15, 16]
    for one in found.sets():
        require_sweep(one)


def test_magnitude_and_phase_of_rspace_are_storage_and_loss(tmp_path: Path) -> None:
    rows = [
        ";".join(
            f"{value:.17g}"
            for value in (w / (2 * math.pi), math.hypot(g, h), math.degrees(math.atan2(h, g)), 25)
        )
        for w, g, h in SWEEP
    ]
    heading = "Frequency(Hz);Complex modulus (G*)(Pa);Phase angle(°);Temperature(°C)"
    for text in (lines(heading, *rows), lines(heading, *(row.replace(".", ",") for row in rows))):
        found = table(tmp_path, text)
        require_sweep(found)
        assert found.data == "shear"
    said = refusal(tmp_path, lines(heading, "1;10;-3;25"))
    assert "export.txt:2: column 'Phase angle(°)': a phase angle lies between 0 and 90" in said


def test_magnitude_beside_storage_and_loss_is_left_out(tmp_path: Path) -> None:
    found = table(
        tmp_path,
        lines("f [Hz],G' [Pa],G'' [Pa],|G*| [Pa],delta [deg],tan delta", "1,3,4,5,,1.3333"),
    )
    assert found["storage_modulus"].tolist() == [3.0]
    assert found.left_out == ("|G*| [Pa]", "delta [deg]")
    phase = table(tmp_path, lines("f [Hz],E' [Pa],δ [°]", "1,3,45"))
    np.testing.assert_allclose(phase["loss_modulus"], [3.0], rtol=1e-15)
    assert table(tmp_path, lines("t [s],δ [um]", "1,3"))["approach"].tolist() == [3e-6]


def test_heading_of_proteus_is_the_last_of_its_comments(tmp_path: Path) -> None:
    text = lines(
        "#EXPORTTYPE: DATA ALL",
        "#FORMAT: NETZSCH5",
        "#SEPARATOR: SEMICOLON",
        "#MTYPE: DMA",
        "#SAMPLE: gel;7",
        "##Temp./°C;f/Hz;E'/MPa;E''/MPa;tan d",
        *(f"  20.0;{w / (2 * math.pi):.12g};{g};{h};{h / g:.6g}" for w, g, h in SWEEP),
    )
    for encoding in ("cp1252", "utf-8"):
        found = table(tmp_path, text, encoding)
        np.testing.assert_allclose(found["storage_modulus"], [289.2e6, 178.5e6], rtol=1e-12)
        assert found["temperature"].tolist() == [293.15, 293.15]
        assert found.data == "uniaxial"


def test_curve_of_stare_is_read_at_blanks(tmp_path: Path) -> None:
    text = lines(
        "Curve Name:",
        "  gel, DMA 1",
        "Curve Values:",
        "  Index             t            Ts    Storage modulus",
        "     []           [s]          [°C]              [MPa]",
        "      0             0       20.0000             289.20",
        "      1             1       20.1000             178.50",
        "Results:",
    )
    assert "export.txt:8 has 1 entries" in refusal(tmp_path, text)
    found = table(tmp_path, text.removesuffix("Results:\n"))
    assert found["storage_modulus"].tolist() == [289.2e6, 178.5e6]
    assert found.left_out == ("Index", "Ts")


def test_signals_of_a_q800_are_listed_above_its_numbers(tmp_path: Path) -> None:
    text = lines(
        "CLOSED\t1",
        "Version\t2.0",
        "Instrument\tDMA Q800 V21.3",
        "Nsig\t4",
        "Sig1\tTime (min)",
        "Sig2\tTemperature (°C)",
        "Sig3\tRelaxation Modulus (MPa)",
        "Sig4\tStrain (%)",
        "Date\t2024-05-01",
        "OrgFile\tC:\\TA\\Data\\gel.001",
        "StartOfData",
        "0.1\t25.0\t300.5\t0.1",
        "1.0\t25.1\t200.25\t0.1",
    )
    found = table(tmp_path, text)
    assert found["time"].tolist() == [6.0, 60.0]
    assert found["relaxation_modulus"].tolist() == [300.5e6, 200.25e6]
    assert found.lines.tolist() == [12, 13]


def test_columns_of_jpk_are_named_in_comments(tmp_path: Path) -> None:
    text = lines(
        "# iDisplay: 1.0",
        "# springConstant: 0.06",
        "# columns: time height vDeflection force",
        "# units: s m V nN",
        "0.0 5e-6 0.01 0.0",
        "0.1 4e-6 0.02 1.5",
    )
    found = table(tmp_path, text)
    assert found["time"].tolist() == [0.0, 0.1]
    np.testing.assert_allclose(found["force"], [0.0, 1.5e-9], rtol=1e-15)


def test_names_of_nanoscope_are_given_by_the_user(tmp_path: Path) -> None:
    text = lines("Calc_Ramp_Ex_nm\tDefl_nm_Ex", "0.0\t0.1", "1.5\t0.2")
    assert "none of the columns 'Calc_Ramp_Ex_nm', 'Defl_nm_Ex' is known" in refusal(tmp_path, text)
    found = table(tmp_path, text, columns="position [nm], deflection [nm]")
    np.testing.assert_allclose(found["position"], [0.0, 1.5e-9], rtol=1e-15)
    meant = table(
        tmp_path, text.replace("Ex_nm", "Ex [nm]"), columns="Calc_Ramp_Ex=position, Defl_nm_Ex="
    )
    assert list(meant.columns) == ["position"]


def test_raw_data_of_bluehill_are_quoted(tmp_path: Path) -> None:
    text = lines(
        '"Results Table 1"',
        '"","Maximum Load (N)","Comment"',
        '"1","12.5","gel"',
        "",
        '"Time","Extension","Load"',
        '"(s)","(mm)","(N)"',
        '"0.000","0.0000","0.01"',
        '"0.100","0.0010","0.25"',
    )
    found = table(tmp_path, text)
    assert (found["time"].tolist(), found["force"].tolist()) == ([0.0, 0.1], [0.01, 0.25])
    assert found.left_out == ("Extension",)
    driven = table(tmp_path, text, columns="Extension=approach")
    np.testing.assert_allclose(driven["approach"], [0.0, 1e-6], rtol=1e-15)


def test_series_of_testxpert_have_decimal_commas(tmp_path: Path) -> None:
    text = lines(
        '"Prüfer";"N.N."',
        '"Vorkraft";0,1;"N"',
        '"Prüfzeit";"Standardkraft";"Standardweg"',
        '"s";"N";"mm"',
        "0,00;0,10;0,000",
        "0,02;0,35;0,001",
    )
    for encoding in ("cp1252", "utf-8", "utf-16"):
        found = table(tmp_path, text, encoding)
        assert (found["time"].tolist(), found["force"].tolist()) == ([0.0, 0.02], [0.1, 0.35])


def test_acquisition_of_mts_is_read_below_its_dates(tmp_path: Path) -> None:
    text = lines(
        "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A",
        "",
        "Data Acquisition: Timed\t\t\tTime:\t3.5\tSec\t5/1/2024 11:47:32 AM",
        "Running Time\tAxial Displacement\tAxial Force",
        "Sec\tmm\tN",
        "0.1\t-0.01\t0.5",
        "0.2\t-0.02\t0.75",
    )
    found = table(tmp_path, text)
    assert (found["time"].tolist(), found["force"].tolist()) == ([0.1, 0.2], [0.5, 0.75])


def test_file_of_reptate_begins_with_its_parameters(tmp_path: Path) -> None:
    rows = [f"{w}       {g}    {h}    -0.0079" for w, g, h in SWEEP]
    parameters = "T=0;Mw=94.9;chem=PI;origin=A;label=B;PDI=1.03;"
    for gap in ("\t", "   "):
        heading = (f"Freq{gap}G'{gap}G\"{gap}Temp", f"rad/s{gap}Pa{gap}Pa{gap}°C")
        body = rows if gap == "   " else ["\t".join(row.split()) for row in rows]
        require_sweep(table(tmp_path, lines(parameters, *heading, *body)))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "Report\nRun;7\nFoo [s];Bar [Pa]\n1;2\n2;3\n",
            "no line names a known quantity; line 3 looks most like a heading, with 'Foo [s]', "
            "'Bar [Pa]'",
        ),
        (
            "Report\nRun\t7\nTime\tForce\n1\t2\n2\t3\n",
            "export.txt:3: column 'Time': has no unit; write e.g. 'Time [s]', or a second row",
        ),
        ("# nothing here\n1 2\n2 3\n", "export.txt:2: there is no header"),
    ],
)
def test_refusal_names_the_line_that_looks_most_like_a_heading(
    text: str, said: str, tmp_path: Path
) -> None:
    assert said in refusal(tmp_path, text)


@pytest.mark.parametrize(
    ("columns", "said"),
    [
        ("time [s], force [N]", "columns: 2 names, but export.txt has 3 columns; name each"),
        ("time [s], , strength [N]", "columns: 'strength [N]' names no known quantity"),
        (" , , ", "columns: names no column"),
        ("x=force, y=", "columns: export.txt has no column 'x'"),
    ],
)
def test_names_that_do_not_fit_the_table_are_refused(
    columns: str, said: str, tmp_path: Path
) -> None:
    text = "t [s],a [m],b [N]\n0,0,0\n" if "=" in columns else "0,0,0\n0.5,0,1\n"
    assert said in refusal(tmp_path, text, columns=columns)


def test_given_names_stand_in_place_of_a_heading(tmp_path: Path) -> None:
    for text in ("0,0,0\n0.5,0,15\n", "Zeit,Weg,Kraft\nsek,um,p\n\n0,0,0\n0.5,0,15\n"):
        found = table(tmp_path, text, columns="time [s], , force [nN]")
        assert found["time"].tolist() == [0.0, 0.5]
        np.testing.assert_allclose(found["force"], [0.0, 15e-9], rtol=1e-15)
        assert found.left_out == ()
