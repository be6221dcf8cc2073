"""`viscontact material` of measured tables and cards, and written as cards and tables."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.bodies.materials import library
from viscontact.case import read_case, read_material
from viscontact.cli import main
from viscontact.cli.material.material_files import MaterialOptions, find_material
from viscontact.laws import SeriesLaw

RELAXATION = "t,E_relax\ns,MPa\n1,3000\n10,2400\n100,1500\n"
# As an instrument writes that begins with the slowest cycle.
FALLING = "t,E_relax,T,Set\ns,MPa,C,-\n100,1500,20,0\n10,2400,20,0\n1,3000,20,0\n1,9,40,1\n"
CREEP = "time [s]; creep_compliance [1/GPa]\n0; 0,2\n10; 0,3\n1000; 0,5\n"
FREQUENCY = "f,E_stor,E_loss\nHz,MPa,MPa\n1,100,10\n10,200,20\n"
ABAQUS = """\
*Material, name=A
*Density
1.2e-9,
*Elastic, moduli=INSTANTANEOUS
3000., 0.5
*Viscoelastic, time=PRONY
0.5, 0., 10.
*Trs
25., 17.44, 51.6
*Material, name=B
*Elastic
6., 0.5
"""
ANSYS = "MP,EX,2,3000\nMP,PRXY,2,0.5\nTB,PRONY,2,1,1,SHEAR\nTBDATA,1,0.5,10\n"
DYNA = "*MAT_VISCOELASTIC\n         4  1.05E-09    2000.0       2.0       1.0       0.1\n"
RADIOSS = "#RADIOSS STARTER\n/MAT/LAW34/1\nrubber\n"
FREQUENCY_CARD = """\
*ELASTIC
10., 0.49
*VISCOELASTIC, FREQUENCY=TABULAR
0.05, -0.2, 0., 0., 0.01
0.15, -0.8, 0., 0., 0.1
0.30, -1.6, 0., 0., 1.0
"""
CASE = """\
indenter: {shape: sphere, radius: 10 mm}
load: {kind: ramp, force: 1 N, duration: 1 s}
time: {end: 2 s, steps: 4}
"""
IN_MPA = ["--modulus-unit", "MPa", "--time-unit", "s"]
READ = MaterialOptions(modulus_unit="MPa", time_unit="s")
SERIES = [n for n in library.names() if isinstance(vc.shipped_material(n).law, SeriesLaw)]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    files = {"relax.csv": RELAXATION, "falling.csv": FALLING, "creep.txt": CREEP,
             "dma.csv": FREQUENCY, "two.dat": ABAQUS, "ansys.txt": ANSYS, "six.k": DYNA,
             "x.rad": RADIOSS, "f.inp": FREQUENCY_CARD}  # fmt: skip
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def values(printed: str) -> list[list[str]]:
    """Return the cells of the table below its heading."""
    below = printed[printed.rindex("─") + 1 :]
    return [line.split()[:5] for line in below.splitlines() if line.strip()]


def test_a_table_is_shown_at_its_own_times(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["material", "relax.csv", "--poisson-ratio", "0.25"]) == 0
    printed = capsys.readouterr().out
    assert "relax.csv: TabulatedRelaxation, Poisson's ratio 0.25" in printed
    assert "range         1 s to 100 s" in printed
    rows = {" ".join(row[:2]): row[3] for row in values(printed)}
    # G = E / (2 (1 + nu)), in MPa
    assert [rows["1 s"], rows["10 s"], rows["100 s"]] == ["1200", "960.0", "600.0"]
    assert printed.count("not measured") == 2  # a decade more on either side


def test_a_table_whose_times_fall_is_the_same_from_its_end(
    capsys: pytest.CaptureFixture[str],
) -> None:
    main(["material", "relax.csv", "--poisson-ratio", "0.25"])
    risen = capsys.readouterr().out
    assert main(["material", "falling.csv", "--poisson-ratio", "0.25", "--set", "0"]) == 0
    assert capsys.readouterr().out == risen.replace("relax.csv", "falling.csv")


def test_measured_rows_are_the_points_of_the_figure_and_their_times_its_range(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shown = find_material("creep.txt", MaterialOptions(data="uniaxial", poisson_ratio=0.3))
    [points] = shown.points
    assert points.quantity == "creep_compliance"
    assert points.at.tolist() == [10.0, 1000.0]  # the row at 0 has no place on a log axis
    np.testing.assert_allclose(points.values, 1.3 * np.array([3e-10, 5e-10]), rtol=1e-14)
    assert shown.measured == (0.0, 1000.0)
    command = ["material", "creep.txt", "--data", "uniaxial", "--poisson-ratio", "0.3"]
    assert main([*command, "-o", "law.png"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "law.png"
    assert (folder / "law.png").stat().st_size > 5000


def test_a_card_is_shown_with_what_it_leaves_out(capsys: pytest.CaptureFixture[str]) -> None:
    command = ["material", "two.dat", *IN_MPA, "--temperature-unit", "degC", "--name", "A"]
    assert main(command) == 0
    printed = capsys.readouterr().out
    assert "two.dat: RelaxationSeries, Poisson's ratio 0.5" in printed
    assert "material      A" in printed
    assert "25 °C; times shift by WLF, C1 = 17.44 and C2 = 51.6 K" in printed
    assert "note          two.dat:2: *DENSITY is not used" in printed
    rows = {" ".join(row[:2]): row[3] for row in values(printed)}
    # 1000 MPa (1 + exp(-t / 10 s)) / 2
    assert rows["10 s"] == f"{500 * (1 + np.exp(-1.0)):.1f}"


def test_a_card_is_recognised_by_its_content(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["material", "ansys.txt", *IN_MPA]) == 0
    assert "ansys.txt: RelaxationSeries, Poisson's ratio 0.5" in capsys.readouterr().out


def test_a_card_of_ls_dyna_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["material", "six.k", *IN_MPA]) == 0
    printed = capsys.readouterr().out
    assert "six.k: RelaxationSeries, bulk modulus 2 GPa" in printed
    rows = {" ".join(row[:2]): row[3] for row in values(printed)}
    # 1 MPa (1 + exp(-0.1 t / s))
    assert rows["10 s"] == f"{1 + np.exp(-1.0):.3f}"


@pytest.mark.parametrize("options", [[], IN_MPA])
def test_file_of_a_program_that_is_not_read_is_refused_by_its_name(
    options: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["material", "x.rad", *options]) == 2
    assert "x.rad: is an input file of Radioss, which is not read" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("file", "said"),
    [
        ("x.rad", "material.file: x.rad: is an input file of Radioss, which is not read; give its"),
        ("six.k", "material.file: six.k: is a material card; give law: card, with modulus_unit"),
    ],
)
def test_card_that_a_case_names_as_a_table_is_recognised(
    file: str, said: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    material = f"material: {{law: table, file: {file}, poisson_ratio: 0.3}}\n"
    (folder / "case.yaml").write_text(CASE + material, encoding="utf-8")
    assert main(["check", "case.yaml"]) == 2
    assert said in capsys.readouterr().err


def test_fit_to_a_card_that_misses_it_is_a_warning_of_the_run(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    card = "material: {law: card, file: f.inp, modulus_unit: MPa, time_unit: s}\n"
    (folder / "case.yaml").write_text(CASE + card, encoding="utf-8")
    assert main(["check", "case.yaml"]) == 0
    printed = " ".join("".join(capsys.readouterr()).split())
    assert "f.inp:3: the fit misses storage" in printed
    assert "note: f.inp:3: the law is a relaxation series of 2 terms, fitted to 3" in printed


def test_check_names_the_unused_entries_of_a_card(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    card = "{law: card, file: two.dat, modulus_unit: MPa, time_unit: s, temperature_unit: degC"
    (folder / "case.yaml").write_text(f"{CASE}material: {card}, name: A}}\n", encoding="utf-8")
    assert main(["check", "case.yaml"]) == 0
    assert "note: two.dat:2: *DENSITY is not used" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["relax.csv"], "relax.csv: give --poisson-ratio (e.g. 0.38) or --bulk-modulus (e.g. '4 G"),
        (["relax.csv", "--poisson-ratio", "0.6"], "--poisson-ratio: must be less than or equal to"),
        (["relax.csv", "--bulk-modulus", "4 mm"], "--bulk-modulus: cannot read '4 mm'"),
        (["relax.csv", "--data", "shear", "--poisson-ratio", "0.3"], "--data: shear contradicts"),
        (["relax.csv", "--data", "sheer"], "--data: unknown value 'sheer'; did you mean 'shear'?"),
        (["relax.csv", "--name", "A"], "relax.csv: is a table, to which --name does not apply"),
        (["creep.txt", "--poisson-ratio", "0.3"], "creep.txt: the headings do not say what kind"),
        (["falling.csv", "--poisson-ratio", "0.3"], "say which with --set: 0 (20 °C), 1 (40 °C)"),
        (["falling.csv", "--poisson-ratio", "0.3", "--set", "7"], "has no set 7; 0 (20 °C), 1"),
        (["dma.csv", "--poisson-ratio", "0.3"], "`viscontact fit dma.csv` finds the law"),
        (["two.dat"], "two.dat: cards do not state their units; add e.g. --modulus-unit MPa"),
        (["two.dat", *IN_MPA, "--name", "A"], "two.dat:8: has temperatures, and cards do not say"),
        (["two.dat", *IN_MPA, "--name", "A"], "give --temperature-unit, e.g. 'degC'"),
        (
            ["two.dat", *IN_MPA, "--temperature-unit", "K"],
            "has several materials; choose one with --name: 'A', 'B'",
        ),
        (["ansys.txt", "--modulus-unit", "mm", "--time-unit", "s"], "--modulus-unit: cannot read"),
        (["ansys.txt", *IN_MPA, "--poisson-ratio", "0.3"], "--poisson-ratio: is given in the card"),
        (["ansys.txt", *IN_MPA, "--data", "shear"], "is a card, to which --data does not apply"),
        (["pmma-paper", "--poisson-ratio", "0.3"], "is a shipped material, to which --poisson-rat"),
        (["pmma-paper", *IN_MPA], "to which --modulus-unit does not apply"),
        (["no.csv"], "no such file no.csv"),
        (["no.inp"], "no such file no.inp"),
        (["pmma-paper", "-o", "pmma.inp"], "-o alone is a figure (.png, .pdf or .svg); add --to a"),
        (
            ["pmma-paper", "--to", "abaqus", "-o", "p.png"],
            "p.png: with --to, -o is the file",
        ),
        (["pmma-paper", "--to", "nastran"], "--to: must be one of abaqus, ansys, csv, got 'nas"),
        (["pmma-paper", "--to", "csv", "--time-unit", "m"], "--time-unit: cannot read 'm'"),
        (["pmma-paper", "--to", "csv", "-o", "no/p.csv"], "no/p.csv: No such file"),
        (["--to", "csv"], "--to csv: name one material"),
        (["ansys.txt", *IN_MPA, "--to", "csv", "-o", "ansys.txt"], "is the input file"),
    ],
)
def test_refusals_name_the_option_on_one_line_with_exit_code_2(
    folder: Path, arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = sorted(path.name for path in folder.iterdir())
    assert main(["material", *arguments]) == 2
    printed = capsys.readouterr()
    assert message in printed.err
    assert len(printed.err.splitlines()) == 1
    assert printed.out == ""
    assert sorted(path.name for path in folder.iterdir()) == before


def test_a_noisy_table_is_refused_at_its_line_with_what_fits_it(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "noisy.csv").write_text(RELAXATION.replace("2400", "3001"), encoding="utf-8")
    assert main(["material", "noisy.csv", "--poisson-ratio", "0.3"]) == 2
    said = capsys.readouterr().err
    assert said.startswith("noisy.csv:4: column 'E_relax': must not grow")
    assert said.strip().endswith("`viscontact fit noisy.csv` does")


@pytest.mark.parametrize("content", [b"", b"\x00\x01\xff", b"1,2\n3,4\n", b"*Elastic\n", b"TB,\n"])
@pytest.mark.parametrize("name", ["any.csv", "any.inp", "any.dat", "any.yaml", "any"])
def test_a_file_that_is_none_of_these_is_refused(
    folder: Path, name: str, content: bytes, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / name).write_bytes(content)
    assert main(["material", name, *([] if name.endswith("yaml") else IN_MPA)]) == 2
    assert "any" in capsys.readouterr().err


@pytest.mark.parametrize("name", SERIES)
@pytest.mark.parametrize(("form", "file"), [("abaqus", "law.inp"), ("ansys", "law.mac")])
def test_a_shipped_series_is_the_same_after_a_card(
    name: str, form: str, file: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["material", name, "--to", form, "-o", file]) == 0
    assert capsys.readouterr().out.strip() == file
    given, found = vc.shipped_material(name), find_material(file, READ).material
    t = np.geomspace(*find_material(name, MaterialOptions()).span(), 40)
    np.testing.assert_allclose(found.law(t), given.law(t), rtol=1e-8)
    j, k = (each.contact_compliance()(t) for each in (found, given))
    np.testing.assert_allclose(j, k, rtol=1e-8)


@pytest.mark.parametrize(("form", "file"), [("abaqus", "a.inp"), ("ansys", "a.mac")])
def test_a_card_shows_the_numbers_of_what_it_was_written_from(
    form: str, file: str, capsys: pytest.CaptureFixture[str]
) -> None:
    units = ["--modulus-unit", "kPa", "--time-unit", "min"]
    main(["material", "pmma-paper"])
    given = {tuple(row[:2]): row[2:] for row in values(capsys.readouterr().out)}
    assert main(["material", "pmma-paper", "--to", form, *units, "-o", file]) == 0
    assert main(["material", file, *units]) == 0
    printed = values(capsys.readouterr().out)
    found = {tuple(row[:2]): row[2:] for row in printed}
    shared = [time for time in given if time in found]
    assert len(shared) >= 5
    assert [found[time][:3] for time in shared] == [given[time][:3] for time in shared]


def test_a_card_keeps_its_shift_when_it_is_written_for_the_other_program(folder: Path) -> None:
    units = [*IN_MPA, "--temperature-unit", "degC"]
    command = ["material", "two.dat", *units, "--name", "A", "--to", "ansys", "-o", "a.mac"]
    assert main(command) == 0
    typed = MaterialOptions(modulus_unit="MPa", time_unit="s", temperature_unit="degC")
    assert find_material("a.mac", typed).shift == vc.WLF(298.15, 17.44, 51.6)


@pytest.mark.parametrize("unit", ["MPa", "N/mm^2", "psi"])
def test_a_law_written_as_csv_is_the_same_in_a_case(folder: Path, unit: str) -> None:
    command = ["material", "pmma-paper", "--to", "csv", "-o", "law.csv"]
    assert main([*command, "--modulus-unit", unit, "--time-unit", "min"]) == 0
    given = vc.shipped_material("pmma-paper")
    for quantity in ("creep_compliance", "relaxation_modulus"):
        table = f"law: table, file: law.csv, quantity: {quantity}, data: shear, poisson_ratio: 0.38"
        (folder / "case.yaml").write_text(f"{CASE}material: {{{table}}}\n", encoding="utf-8")
        found = read_case("case.yaml").material
        assert found.poisson_ratio == 0.38
        own = np.array(found.law.times)
        assert found.law.measured_until == close_to(1000.0, rel=1e-11)
        if quantity == "creep_compliance":
            np.testing.assert_allclose(found.law(own), given.law(own), rtol=1e-10)
        between = np.sqrt(own[1:-1] * own[2:])
        # Cubics over 1/20 of a decade: h^4/384 of the fourth derivative in ln t, 1e-6 here.
        np.testing.assert_allclose(found.law(between), given.law(between), rtol=2e-5)


def test_a_table_written_as_csv_is_the_same_table(folder: Path) -> None:
    command = ["material", "creep.txt", "--data", "shear", "--bulk-modulus", "40 GPa"]
    assert main([*command, "--to", "csv", "-o", "law.csv"]) == 0
    assert "bulk_modulus: 4e+10 Pa" in (folder / "law.csv").read_text(encoding="utf-8")
    found = find_material("law.csv", MaterialOptions(bulk_modulus="40 GPa")).material.law
    options = MaterialOptions(data="shear", bulk_modulus="40 GPa")
    given = find_material("creep.txt", options).material.law
    assert isinstance(found, vc.TabulatedCreep)
    assert found.times == given.times
    np.testing.assert_allclose(found.compliance, given.compliance, rtol=1e-11)


def test_a_fluid_written_as_csv_ends_before_its_modulus_is_nothing(folder: Path) -> None:
    (folder / "m.yaml").write_text(
        "{law: maxwell, shear_modulus: 1 GPa, viscosity: 1 GPa s, poisson_ratio: 0.3}\n",
        encoding="utf-8",
    )
    assert main(["material", "m.yaml", "--to", "csv", "-o", "law.csv"]) == 0
    rows = vc.read_table("law.csv")
    t = rows["time"]
    np.testing.assert_allclose(rows["creep_compliance"], (1 + t) / 1e9, rtol=1e-11)
    np.testing.assert_allclose(rows["relaxation_modulus"], 1e9 * np.exp(-t), rtol=1e-10)
    assert t[-1] == close_to(-np.log(1e-9), rel=0.13)  # within a twentieth of a decade


def test_what_is_no_series_is_refused_with_a_remedy_that_works(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    law = "law: fractional-zener\nshear_modulus: 3 MPa\nequilibrium_modulus: 1 MPa\ntime: 2 s\n"
    (folder / "f.yaml").write_text(f"{law}exponent: 0.5\npoisson_ratio: 0.5\n", encoding="utf-8")
    assert main(["material", "f.yaml", "--to", "ansys"]) == 2
    said = capsys.readouterr().err
    assert "takes a Prony series, and FractionalZener is none; fit one first: viscontact" in said
    assert main(["material", "f.yaml", "--to", "csv", "-o", "law.csv"]) == 0
    assert main(["fit", "law.csv", "--poisson-ratio", "0.5", "--yaml", "series.yaml"]) == 0
    assert main(["material", "series.yaml", "--to", "ansys", "-o", "law.mac"]) == 0
    t = np.geomspace(0.01, 100.0, 20)
    given, found = read_material("f.yaml").law, find_material("law.mac", READ).material.law
    # As many exponentials as the fit needs for 1 %.
    np.testing.assert_allclose(found.relaxation(t), given.relaxation(t), rtol=0.02)


def test_without_a_file_the_card_alone_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    command = ["material", "ansys.txt", *IN_MPA, "--to", "abaqus"]
    assert main(command) == 0
    assert capsys.readouterr().out.splitlines()[1:] == [
        '*MATERIAL, NAME="2"',
        "*ELASTIC, MODULI=INSTANTANEOUS",
        "3000.0, 0.5",
        "*VISCOELASTIC, TIME=PRONY",
        "0.5, 0.0, 10.0",
    ]
