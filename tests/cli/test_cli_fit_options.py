"""Options of `viscontact fit` that do not apply to the data of a file are refused, not ignored."""

from __future__ import annotations

import inspect
from pathlib import Path

import numpy as np
import pytest

from returned import some
from viscontact.cli import main
from viscontact.cli.commands.fitting import fit

#: Headings of a table of each kind, and how messages name the kind.
KINDS = {
    "creep": ("time [s], D [1/GPa]", "a creep test at one temperature"),
    "relaxation": ("time [s], E [MPa]", "a relaxation test at one temperature"),
    "storage": ("omega [rad/s], E' [MPa]", "an oscillation test without losses at one temper"),
    "oscillation": ("omega [rad/s], E' [MPa], E'' [MPa]", "an oscillation test at one temperature"),
    "creep sets": ("set, time [s], D [1/GPa]", "a creep test at several temperatures"),
    "oscillation sets": (
        "set, omega [rad/s], E' [MPa], E'' [MPa]",
        "an oscillation test at several temperatures",
    ),
    "warmed creep": ("time [s], D [1/GPa], T [degC]", "a creep test whose temperature varies"),
    "warmed relaxation": (
        "time [s], E [MPa], T [degC]",
        "a relaxation test whose temperature varies",
    ),
    "indentation": ("time [s], approach [um], force [uN]", "an indentation record"),
    "curve": ("time [s], position [um], deflection [nm]", "a force curve with its deflection as"),
    "voltage": ("time [s], position [um], deflection [V]", "a force curve in volts"),
}
CURVES = {"curve", "voltage"}
INDENTATIONS = {"indentation", *CURVES}
SETS = {"creep sets", "oscillation sets"}
WARMED = {"warmed creep", "warmed relaxation"}
SERIES = {*KINDS} - INDENTATIONS

#: Values of the options that apply to some kinds only, and these kinds.
USES = {
    "data": (["shear"], SERIES),
    "fluid": ([], SERIES),
    "weight": (["storage=2"], {"oscillation", "oscillation sets"}),
    "reference": (["20 degC"], SETS | WARMED),
    "temperature": (["20 degC"], SETS | WARMED),
    "vertical": (["none"], SETS),
    "expansion": (["6e-4"], SETS),
    "shift": (["wlf"], WARMED),
    "thermal-strain": (["no"], {"warmed creep"}),
    "indenter": (["sphere 5 um"], INDENTATIONS),
    "until": (["hold"], INDENTATIONS),
    "law": (["zener"], INDENTATIONS),
    "reference-time": (["1 s"], INDENTATIONS),
    "thickness": (["20 um"], INDENTATIONS),
    "reach": (["0.5"], CURVES),
    "adhesion": ([], CURVES),
    "spring-constant": (["0.1 N/m"], CURVES),
    "sensitivity": (["50 nm/V"], {"voltage"}),
}
#: Options that apply to all tables; the reader of tables refuses a stress of no creep test.
OF_ALL = {"files", "poisson_ratio", "bulk_modulus", "terms", "columns", "stress"}
OF_RESULTS = {"output", "width", "section", "table"}
OF_CASES = {
    *("case", "change", "drive", "contact_point", "machine_stiffness", "settings", "rows"),
    *("runs", "report", "jobs", "scheduler", "resume", "overwrite", "quiet"),
}


def table(folder: Path, headings: str) -> Path:
    """A table of ones, with two sets or a temperature that rises."""
    rows = 12
    values = {"set": np.repeat([1, 2], rows // 2), "T [degC]": np.linspace(20, 31, rows)}
    increasing = np.arange(1.0, rows + 1)
    columns = [
        values.get(heading, increasing if heading[0] in "to" else np.ones(rows))
        for heading in headings.split(", ")
    ]
    lines = [",".join(f"{value:g}" for value in row) for row in zip(*columns, strict=True)]
    path = folder / "table.csv"
    path.write_text("\n".join([headings.replace(", ", ","), *lines]) + "\n", encoding="utf-8")
    return path


def test_every_option_is_either_for_all_tables_or_for_some_or_for_cases():
    some = {name.removeprefix("no-").replace("-", "_") for name in USES}
    assert {*inspect.signature(fit).parameters} == some | OF_ALL | OF_RESULTS | OF_CASES


@pytest.mark.parametrize("kind", KINDS)
def test_an_option_without_use_for_the_data_is_refused_in_one_line(kind, tmp_path, capsys):
    headings, words = KINDS[kind]
    path = table(tmp_path, headings)
    for name, (value, kinds) in USES.items():
        if kind in kinds:
            continue
        assert main(["fit", str(path), f"--{name}", *value]) == 2
        [said] = capsys.readouterr().err.splitlines()
        option = f"--{name.removeprefix('no-')}"
        assert said.startswith(f"table.csv: {option} goes with ")
        assert f"; this is {words}" in said
        assert said.endswith(f"; leave {option} out")


@pytest.mark.parametrize("kind", KINDS)
def test_options_with_a_use_for_the_data_are_not_refused_as_idle(kind, tmp_path, capsys):
    """What follows is refused for another reason: the tables are no measurements."""
    path = table(tmp_path, KINDS[kind][0])
    for name, value in some(
        [(name, value) for name, (value, kinds) in USES.items() if kind in kinds]
    ):
        main(["fit", str(path), f"--{name}", *value])
        assert "; leave --" not in capsys.readouterr().err


@pytest.mark.parametrize("law", ["NONSENSE", "maxwell"])
def test_a_law_of_indentations_is_refused_for_a_creep_table(law, tmp_path, capsys):
    path = table(tmp_path, "time [s], D [1/GPa]")
    assert main(["fit", str(path), "--poisson-ratio", "0.4", "--law", law]) == 2
    assert capsys.readouterr().err == (
        "table.csv: --law goes with an indentation (columns time, approach and force, or time, "
        "position, and deflection or force); this is a creep test at one temperature; there are "
        "time ('time [s]'), creep_compliance ('D [1/GPa]'); leave --law out\n"
    )


def test_several_options_without_use_are_named_together(tmp_path, capsys):
    path = table(tmp_path, "time [s], approach [um], force [uN]")
    assert main(["fit", str(path), "--data", "shear", "--shift", "wlf"]) == 2
    [said] = capsys.readouterr().err.splitlines()
    assert "--data goes with creep, relaxation or oscillation; --shift goes with one test " in said
    assert said.endswith("leave --data and --shift out")


@pytest.mark.parametrize("kind", ["relaxation", "oscillation", "indentation", "curve"])
def test_a_stress_is_refused_where_there_is_no_strain_of_a_creep_test(kind, tmp_path, capsys):
    path = table(tmp_path, KINDS[kind][0])
    assert main(["fit", str(path), "--stress", "5 MPa"]) == 2
    [said] = capsys.readouterr().err.splitlines()
    assert said.startswith("table.csv: has no strain of a creep test; there are '")
    assert said.endswith("; leave --stress out")


@pytest.mark.parametrize("law", [[], ["--law", "elastic"], ["--law", "power-law"]])
def test_terms_are_refused_for_an_indentation_by_a_law_without_terms(law, tmp_path, capsys):
    path = table(tmp_path, "time [s], approach [um], force [uN]")
    tip = ["--indenter", "sphere 5 um", "--poisson-ratio", "0.5"]
    assert main(["fit", str(path), *tip, *law, "--terms", "2"]) == 2
    [said] = capsys.readouterr().err.splitlines()
    name = law[1] if law else "zener"
    assert "--terms goes with --law creep-series" in said
    assert f"the law of this indentation is {name}; leave --terms out" in said


def test_a_table_of_no_known_kind_is_refused_with_the_columns_that_each_kind_needs(
    tmp_path, capsys
):
    path = table(tmp_path, "time [s], position [um], approach [nm]")
    assert main(["fit", str(path), "--spring-constant", "1 N/m"]) == 2
    [said] = capsys.readouterr().err.splitlines()
    assert "force and approach, or position and deflection, over time; there are time" in said
