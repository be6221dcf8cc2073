"""`viscontact fit`: tables in, law, shift factors, section and figure out; never a traceback."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import openpyxl
import pytest

from closeness import close_to
from viscontact import reference
from viscontact.bodies.loads.clock import ReducedTime
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.materials.material import Material
from viscontact.case import read_material
from viscontact.cli import main
from viscontact.laws import WLF, Maxwell, RelaxationSeries

T = np.geomspace(0.1, 100.0, 25)
E = RelaxationSeries(1e9, [2e9, 1e9], [1.0, 30.0])
RULE = WLF(293.15, 12.0, 70.0)


def written(path: Path, heads: tuple[str, ...], *columns: np.ndarray) -> Path:
    """Write a table as a person would: one header row with units, SI or not."""
    rows = [",".join(f"{value:.9g}" for value in row) for row in zip(*columns, strict=True)]
    path.write_text("\n".join([",".join(heads), *rows]) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def relaxation(tmp_path: Path) -> Path:
    heads = ("time [s]", "E [MPa]")
    return written(tmp_path / "relaxation.csv", heads, T, E.relaxation(T) / 1e6)


@pytest.fixture
def sets(tmp_path: Path) -> Path:
    """Three temperatures; at 20 °C the law is E itself."""
    celsius = np.array([15.0, 20.0, 25.0])
    modulus = np.concatenate([E.relaxation(T / RULE.factor(c + 273.15)) for c in celsius]) / 1e6
    heads = ("time [s]", "E [MPa]", "T [°C]")
    return written(tmp_path / "sets.csv", heads, np.tile(T, 3), modulus, np.repeat(celsius, T.size))


def test_the_section_printed_and_written_is_the_law_of_the_data(relaxation, tmp_path, capsys):
    out, figure = tmp_path / "m.yaml", tmp_path / "fit.png"
    command = ["fit", str(relaxation), "--poisson-ratio", "0.3", "--yaml", str(out)]
    assert main([*command, "-o", str(figure)]) == 0
    printed = capsys.readouterr().out
    assert "RelaxationSeries of 2 terms to 25 rows of uniaxial data" in printed
    assert out.read_text(encoding="utf-8").strip() in printed
    law = read_material(out).law
    np.testing.assert_allclose(law.relaxation(T), E.relaxation(T) / 2.6, rtol=2e-3)
    assert figure.stat().st_size > 10_000


@pytest.mark.slow
def test_several_temperatures_give_shift_factors_and_the_law_at_any_of_them(sets, tmp_path, capsys):
    out = tmp_path / "m.yaml"
    command = ["fit", str(sets), "--poisson-ratio", "0.3", "--yaml", str(out)]
    assert main([*command, "-o", str(tmp_path / "master.pdf")]) == 0
    printed = capsys.readouterr().out
    assert "3 sets, shifted to 20 °C" in printed
    assert "WLF with C1 = " in printed
    [row] = [line for line in printed.splitlines() if line.strip().startswith("25.00")]
    assert float(row.split()[1]) == close_to(np.log10(RULE.factor(298.15)), abs=0.02)
    at_20 = read_material(out).law.relaxation(T)
    np.testing.assert_allclose(at_20, E.relaxation(T) / 2.6, rtol=0.01)
    assert main([*command, "--temperature", "17 degC"]) == 0
    # Between two sets ln a_T is straight, which WLF is not: 2 % of a decade, here.
    at_17 = read_material(out).law.relaxation(T)
    wanted = E.relaxation(T / RULE.factor(290.15)) / 2.6
    np.testing.assert_allclose(at_17, wanted, rtol=0.03)


@pytest.fixture
def rubber(tmp_path: Path) -> Path:
    """Storage and loss at three temperatures, proportional to T; at 20 °C the law is E itself."""
    celsius, omega = np.array([15.0, 20.0, 25.0]), np.geomspace(0.01, 10.0, 16)
    kelvin = np.repeat(celsius + 273.15, omega.size)
    frequency = np.tile(omega, 3)
    modulus = E.complex_modulus(frequency * RULE.factor(kelvin)) * kelvin / 293.15e6
    heads = ("omega [rad/s]", "E' [MPa]", "E'' [MPa]", "T [°C]")
    columns = (frequency, modulus.real, modulus.imag, kelvin - 273.15)
    return written(tmp_path / "rubber.csv", heads, *columns)


def test_the_law_file_of_several_temperatures_is_the_law_at_any_of_them(rubber, tmp_path, capsys):
    out = tmp_path / "law.yaml"
    command = ["fit", str(rubber), "--poisson-ratio", "0.3", "--yaml", str(out)]
    assert main(command) == 0
    printed = capsys.readouterr().out
    [row] = [line for line in printed.splitlines() if line.strip().startswith("25.00")]
    found = [float(each) for each in row.replace("±", " ").replace("%", "").split()]
    assert found[1] == close_to(np.log10(RULE.factor(298.15)), abs=0.005)
    assert found[3] == close_to(298.15 / 293.15, abs=0.002)
    assert "vertical shift b_T found from the sets" in printed
    material = read_material(out)
    np.testing.assert_allclose(material.law.relaxation(T), E.relaxation(T) / 2.6, rtol=0.01)
    wanted = E.relaxation(T / RULE.factor(298.15)) / 2.6 * 298.15 / 293.15
    np.testing.assert_allclose(material.at(298.15).law.relaxation(T), wanted, rtol=0.01)
    case = tmp_path / "case.yaml"
    case.write_text("material: {file: law.yaml, temperature: 25 degC}\n", encoding="utf-8")
    np.testing.assert_allclose(read_material(case).law.relaxation(T), wanted, rtol=0.01)
    assert main([*command, "--temperature", "25 degC"]) == 0
    np.testing.assert_allclose(read_material(out).law.relaxation(T), wanted, rtol=0.01)
    back = read_material(out).at(293.15)
    np.testing.assert_allclose(back.law.relaxation(T), E.relaxation(T) / 2.6, rtol=0.01)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--vertical", "rubbery"], "--vertical must be one of none, rubber, found"),
        (["--expansion", "6e-4"], "--expansion goes with --vertical rubber"),
    ],
)
def test_wrong_vertical_options_are_refused(options, said, rubber, capsys):
    assert main(["fit", str(rubber), "--poisson-ratio", "0.3", *options]) == 2
    assert said in capsys.readouterr().err


@pytest.fixture
def contradiction(tmp_path: Path) -> Path:
    """Losses on another scale than the storage."""
    omega = np.geomspace(0.01, 100.0, 25)
    modulus = E.complex_modulus(omega) / 1e6
    heads = ("omega [rad/s]", "E' [MPa]", "E'' [MPa]")
    return written(tmp_path / "dma.csv", heads, omega, modulus.real, 5 * modulus.imag)


def test_a_fit_that_misses_its_data_warns_and_says_so_in_the_written_law(
    contradiction, relaxation, tmp_path, capsys
):
    out = tmp_path / "m.yaml"
    command = ["--poisson-ratio", "0.3", "--yaml", str(out)]
    assert main(["fit", str(contradiction), *command]) == 0
    printed = capsys.readouterr()
    [warning] = printed.err.splitlines()
    assert warning.startswith("warning: the fit misses storage by ")
    assert "Kramers-Kronig" in warning
    assert "weights of the relative residuals: storage " in printed.out
    comment = "material:\n  # misfit: no series has such storage and loss together\n"
    assert out.read_text(encoding="utf-8").startswith(comment)
    assert f"warning: {read_material(out).warning}" == warning
    assert main(["fit", str(relaxation), *command]) == 0
    assert capsys.readouterr().err == ""
    assert "warning" not in out.read_text(encoding="utf-8")


def test_a_row_that_is_wrong_is_named_by_its_line_also_in_the_written_law(tmp_path, capsys):
    modulus = E.relaxation(T) / 1e6
    modulus[10] *= 1.5
    file = written(tmp_path / "r.csv", ("time [s]", "E [MPa]"), T, modulus)
    out = tmp_path / "m.yaml"
    assert main(["fit", str(file), "--poisson-ratio", "0.3", "--yaml", str(out)]) == 0
    assert "such as modulus, line 12 of r.csv, or smooth" in capsys.readouterr().err
    assert "such as modulus, line 12 of r.csv, or smooth" in read_material(out).warning


def test_weights_are_those_given_for_a_table_and_for_a_master_curve(
    contradiction, tmp_path, capsys
):
    text = contradiction.read_text(encoding="utf-8").splitlines()
    rows = [f"{row},{celsius}" for celsius in (20, 25) for row in text[1:]]
    several = tmp_path / "several.csv"
    several.write_text("\n".join([f"{text[0]},T [°C]", *rows]), encoding="utf-8")
    for file in (contradiction, several):
        command = ["fit", str(file), "--poisson-ratio", "0.3", "--weight", "storage=20"]
        assert main(command) == 0
        printed = capsys.readouterr().out
        assert "weights of the relative residuals: storage 20, loss 1\n" in printed
        [residual] = [line for line in printed.splitlines() if "relative residual " in line]
        assert float(residual.split()[2]) < 0.05


@pytest.mark.parametrize(
    ("weight", "said"),
    [
        ("storage", "--weight: 'storage' is not a weight; write e.g. storage=2"),
        ("compliance=2", "weights are those of storage and loss, got one of 'compliance'"),
        ("storage=-1", "the weight of storage must be a positive finite number, got -1"),
    ],
)
def test_weights_that_cannot_be_used_are_refused(weight, said, contradiction, capsys):
    command = ["fit", str(contradiction), "--poisson-ratio", "0.3", "--weight", weight]
    assert main(command) == 2
    assert said in capsys.readouterr().err


def test_an_indentation_record_gives_its_material(tmp_path, capsys):
    t = np.linspace(0.0, 4.0, 41)
    d = 1e-6 * np.minimum(t, 4 - t) / 2
    material = Material(Maxwell(1e6, 2e6), 0.45)
    force = reference.press_axisymmetric(
        reference.SphereProfile(5e-6),
        t,
        approach=d,
        creep_compliance=material.contact_compliance(),
    ).force
    heads = ("time [s]", "approach [um]", "force [uN]")
    file = written(tmp_path / "record.csv", heads, t, 1e6 * d, 1e6 * force)
    out = tmp_path / "m.yaml"
    command = ["fit", str(file), "--indenter", "sphere 5 um", "--law", "maxwell"]
    options = ["--poisson-ratio", "0.45", "--yaml", str(out), "-o", str(tmp_path / "i.svg")]
    assert main([*command, *options]) == 0
    assert "(95%: " in capsys.readouterr().out
    found = read_material(out)
    assert found.poisson_ratio == close_to(0.45)
    np.testing.assert_allclose(found.law(t), material.law(t), rtol=1e-3)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], "uniaxial data need --poisson-ratio"),
        (["--poisson-ratio", "0.7"], "not above 0.5, got 0.7"),
        (["--bulk-modulus", "4 mm"], "--bulk-modulus: cannot read '4 mm' as a pressure"),
        (["--bulk-modulus", "1 MPa"], "is too small"),
        (["--poisson-ratio", "0.3", "--terms", "99"], "from 0 to 12"),
        (["--data", "tensile", "--poisson-ratio", "0.3"], "one of shear, uniaxial, got 'tensile'"),
        (["--poisson-ratio", "0.3", "-o", "fit.bmp"], "choose one of these formats"),
        (["--poisson-ratio", "0.3", "--yaml", "no/such/m.yaml"], "no/such/m.yaml: "),
    ],
)
def test_what_cannot_be_done_is_refused_in_one_line(options, said, relaxation, capsys):
    assert main(["fit", str(relaxation), *options]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert said in lines[0]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--reference", "50 degC"], "within those of the sets, 288.15 to 298.15 K, got 323.15 K"),
        (["--reference", "20"], "--reference: 20 has no unit"),
        (["--temperature", "80 degC"], "between 288.15 and 298.15 K, got 353.15 K"),
    ],
)
def test_a_temperature_that_was_not_measured_is_refused(options, said, sets, capsys):
    assert main(["fit", str(sets), "--poisson-ratio", "0.3", *options]) == 2
    assert said in capsys.readouterr().err


def test_a_bad_value_is_named_by_its_line_in_the_file(tmp_path, capsys):
    modulus = E.relaxation(T) / 1e6
    modulus[4] = -modulus[4]
    file = written(tmp_path / "bad.csv", ("time [s]", "E [MPa]"), T, modulus)
    assert main(["fit", str(file), "--poisson-ratio", "0.3"]) == 2
    said = capsys.readouterr().err
    assert "bad.csv:6" in said or "line 6" in said


def test_a_file_that_is_not_there_is_refused(tmp_path, capsys):
    assert main(["fit", str(tmp_path / "no.csv"), "--data", "shear"]) == 2
    assert "no.csv" in capsys.readouterr().err


def test_an_indentation_of_no_terms_is_refused(tmp_path, capsys):
    t = np.linspace(0.0, 4.0, 9)
    heads = ("time [s]", "approach [um]", "force [uN]")
    file = written(tmp_path / "record.csv", heads, t, t, t**1.5)
    command = ["fit", str(file), "--indenter", "sphere 5 um", "--poisson-ratio", "0.5"]
    assert main([*command, "--law", "creep-series", "--terms", "0"]) == 2
    assert "terms must" in capsys.readouterr().err


CREEP = "time [h], strain at 5 MPa [%], strain at 10 MPa [%]\n"
STRAINS = "1, 0.25, 0.6\n10, 0.3125, 0.8\n100, 0.39, 1.1\n"


def test_strain_of_a_creep_test_is_fitted_and_shown_at_its_stress(tmp_path, capsys):
    file = tmp_path / "creep.csv"
    file.write_text(CREEP + STRAINS, encoding="utf-8")
    for command in ("fit", "material"):
        options = [command, str(file), "--poisson-ratio", "0.4"]
        assert main(options) == 2
        assert "holds tests at 5 MPa, 10 MPa; choose one" in capsys.readouterr().err
        assert main([*options, "--stress", "5 mm"]) == 2
        assert "--stress: cannot read '5 mm' as a pressure" in capsys.readouterr().err
        assert main([*options, "--stress", "5 MPa"]) == 0
        assert "left out: strain at 10 MPa [%]\n" in capsys.readouterr().err
    assert main(["fit", str(file), "--poisson-ratio", "0.4", "--stress", "5 MPa"]) == 0
    instant = next(x for x in capsys.readouterr().out.splitlines() if "instant:" in x)
    assert float(instant.split()[1]) < 0.0025 / 5  # below the compliance after an hour [1/MPa]


def test_headings_that_are_not_known_are_named_in_the_refusal(tmp_path, capsys):
    file = tmp_path / "stiffness.csv"
    file.write_text("time [h], stiffness [MPa]\n1, 2000\n", encoding="utf-8")
    for command in ("fit", "material"):
        assert main([command, str(file), "--poisson-ratio", "0.4"]) == 2
        said = capsys.readouterr().err
        assert "there are time ('time [h]'); not known: 'stiffness [MPa]'" in said


def test_a_sheet_of_a_workbook_is_fitted_and_shown_and_named(tmp_path, capsys):
    book, path = openpyxl.Workbook(), tmp_path / "data.xlsx"
    for name, factor in (("23 C", 1e-6), ("60 C", 5e-7)):
        sheet = book.create_sheet(name)
        sheet.append(["time [s]", "E [MPa]"])
        for row in zip(T.tolist(), (factor * E.relaxation(T)).tolist(), strict=True):
            sheet.append(row)
    book.save(path)
    for chosen, factor in (("", 1.0), ("#60 C", 0.5)):
        out = tmp_path / "m.yaml"
        command = [f"{path}{chosen}", "--poisson-ratio", "0.3"]
        assert main(["fit", *command, "--yaml", str(out)]) == 0
        assert main(["material", *command]) == 0
        said = capsys.readouterr().err
        assert ("the sheet '23 C' is read; choose another one as data.xlsx#SHEET" in said) is (
            not chosen
        )
        law = read_material(out).law
        np.testing.assert_allclose(law.relaxation(T), factor * E.relaxation(T) / 2.6, rtol=2e-3)


def force_curve(path: Path, heads: tuple[str, ...], *scales: float) -> Path:
    """Exact Hertz curve of E/(1 - nu²) = 20 kPa, R = 5 µm and 0.1 N/m, contact at 3 µm."""
    depth = np.linspace(0.0, 0.6e-6, 120)
    bent = 4 / 3 * 2e4 * np.sqrt(5e-6) * depth**1.5 / 0.1
    z = np.concatenate([np.linspace(0.0, 2.99e-6, 120), 3e-6 + depth + bent])
    deflection = np.concatenate([np.zeros(120), bent]) + 0.002 * z + 1e-8
    columns = zip((z / 1e-6, z, deflection), scales, strict=True)
    return written(path, heads, *(scale * column for column, scale in columns))


@pytest.mark.parametrize(
    ("last", "scale", "more"),
    [
        pytest.param("deflection [nm]", 1e9, [], marks=pytest.mark.slow),
        ("deflection [mV]", 1e3 / 5e-8, ["--sensitivity", "50 nm/V"]),
        pytest.param("force [pN]", 0.1e12, [], marks=pytest.mark.slow),
    ],
)
def test_a_force_curve_gives_its_contact_point_and_the_law(last, scale, more, tmp_path, capsys):
    heads = ("time [s]", "position [um]", last)
    path = force_curve(tmp_path / "curve.csv", heads, 1.0, 1e6, scale)
    tip = ["--indenter", "sphere 5 um", "--poisson-ratio", "0.5", "--law", "elastic"]
    command = ["fit", str(path), *tip, "--spring-constant", "0.1 N/m", *more]
    assert main([*command, "-o", str(tmp_path / "fit.png")]) == 0
    printed = capsys.readouterr().out
    assert "ContactPoint: at 3 µm" in printed
    assert "slope of 0.002" in printed
    assert "shear_modulus: 5000 Pa" in printed  # (1 - nu)/2 of 20 kPa
    assert (tmp_path / "fit.png").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("last", "options", "why"),
    [
        ("deflection [nm]", [], "a force curve needs --spring-constant, such as '0.1 N/m'"),
        ("deflection [V]", ["--spring-constant", "1 N/m"], "needs --sensitivity, such as '50 nm/"),
        ("deflection [nm]", ["--spring-constant", "1 N"], "--spring-constant: cannot read '1 N'"),
    ],
)
def test_a_force_curve_without_its_constants_is_refused(last, options, why, tmp_path, capsys):
    heads = ("time [s]", "position [um]", last)
    path = force_curve(tmp_path / "curve.csv", heads, 1.0, 1.0, 1.0)
    tip = ["--indenter", "sphere 5 um", "--poisson-ratio", "0.5"]
    assert main(["fit", str(path), *tip, *options]) == 2
    assert why in capsys.readouterr().err


def test_part_reach_and_paraboloid_of_a_force_curve_are_chosen(tmp_path, capsys):
    heads = ("time [s]", "position [um]", "deflection [nm]")
    path = force_curve(tmp_path / "curve.csv", heads, 1.0, 1e6, 1e9)
    tip = ["--poisson-ratio", "0.5", "--law", "elastic", "--spring-constant", "0.1 N/m"]
    command = ["fit", str(path), *tip, "--indenter", "paraboloid 5 um"]
    assert main([*command, "--until", "3.2 s", "--reach", "0.5"]) == 0
    printed = capsys.readouterr().out
    assert "shear_modulus: 5000 Pa" in printed
    assert "to 153 rows over 3.2 s" in printed
    assert "contact at 3 µm" in printed
    assert main([*command, "--until", "the end"]) == 2
    assert "--until: must be loading, hold, end or a time" in capsys.readouterr().err


def test_names_of_the_columns_are_given_where_a_table_has_none(tmp_path, capsys):
    bare = written(tmp_path / "bare.csv", ("0", "0", "3000"), np.arange(1, 26), T, E.relaxation(T))
    body = ["--data", "uniaxial", "--poisson-ratio", "0.4"]
    for command in ("fit", "material"):
        options = [command, str(bare), *body]
        assert main(options) == 2
        assert "can be given by --columns 'time [s], ...'" in " ".join(
            capsys.readouterr().err.split()
        )
        assert main([*options, "--columns", "time [s], E [Pa]"]) == 2
        assert "--columns: 2 names, but bare.csv has 3 columns" in capsys.readouterr().err
    bare.write_text(bare.read_text().partition("\n")[2], encoding="utf-8")
    for command in ("fit", "material"):
        assert main([command, str(bare), *body, "--columns", ", time [s], E [Pa]"]) == 0
        assert "left out" not in capsys.readouterr().err
    headed = written(tmp_path / "headed.csv", ("time [s]", "stiffness [Pa]"), T, E.relaxation(T))
    meant = ["--columns", "stiffness=relaxation_modulus"]
    assert main(["material", str(headed), *body, *meant]) == 0
    assert main(["material", "pmma-paper", *meant]) == 2
    assert "to which --columns does not apply" in capsys.readouterr().err


SLOW = RelaxationSeries(1e9, [2e9, 1e9], [300.0, 9000.0])


@pytest.fixture
def stepped(tmp_path: Path) -> Path:
    """Relaxation at 20 °C for 1000 s, then at 27 and 34 °C: the law is SLOW at 20 °C."""
    times = np.arange(10.0, 3010.0, 10.0)
    celsius = 20.0 + 7.0 * ((times > 1000.0).astype(float) + (times > 2000.0))
    # From row to row the temperature is linear.
    clock = ReducedTime(TemperatureHistory(times, celsius + 273.15), RULE)
    modulus = SLOW.relaxation(clock.reduced(times)) / 1e6
    heads = ("time [s]", "E [MPa]", "T [°C]")
    return written(tmp_path / "stepped.csv", heads, times, modulus, celsius)


def test_law_and_shift_of_a_test_under_a_varying_temperature(stepped, tmp_path, capsys):
    out = tmp_path / "m.yaml"
    command = ["fit", str(stepped), "--poisson-ratio", "0.3", "--shift", "wlf"]
    assert main([*command, "--yaml", str(out)]) == 0
    printed = capsys.readouterr().out
    assert "Shift: WLF" in printed
    assert "the law is that at 20 °C" in printed
    material = read_material(out)
    later = np.geomspace(10.0, 3000.0, 9)
    np.testing.assert_allclose(
        material.law.relaxation(later), SLOW.relaxation(later) / 2.6, rtol=0.01
    )
    assert abs(np.log10(material.shift.factor(307.15) / RULE.factor(307.15))) < 0.02
    assert main([*command, "--temperature", "34 degC", "--yaml", str(out)]) == 0
    warm = read_material(out).law.relaxation(later * RULE.factor(307.15))
    np.testing.assert_allclose(warm, SLOW.relaxation(later) / 2.6, rtol=0.02)


def test_a_shift_of_no_known_rule_is_refused(stepped, capsys):
    assert main(["fit", str(stepped), "--poisson-ratio", "0.3", "--shift", "power"]) == 2
    assert "--shift must be one of arrhenius, wlf, table" in capsys.readouterr().err
