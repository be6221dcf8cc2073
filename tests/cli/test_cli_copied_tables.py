"""Tables that a case names are copied beside the run, and over no file of the user."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import viscontact as vc
from cli.stopped_runs import said_in_lines
from interrupted_runs import CASE, contents, folder, same_bits, whole
from viscontact.cli import main
from viscontact.simulation import transient

__all__ = ["folder", "whole"]  # fixtures


TABLE = "time [s], force [N]\n0, 0\n1, 4\n"
LAW = "time [s], relaxation_modulus [MPa]\n0.01, 10\n0.1, 9.5\n1, 7\n10, 5\n100, 5\n"


@pytest.mark.parametrize(
    ("file", "copied"),
    [
        ("result.nc", "load-result.nc"),
        *(
            pytest.param(name, f"load-{name}", marks=pytest.mark.slow)
            for name in (
                "Case.yaml",
                "state.npz",
                "progress.jsonl",
                ".lock",
                ".result.nc.working",
            )
        ),
        ("../outside.csv", "outside.csv"),
        *(
            pytest.param(*names, marks=pytest.mark.slow)
            for names in (
                ("a/b/../../deep.csv", "deep.csv"),
                ("{absolute}/absolute.csv", "absolute.csv"),
            )
        ),
    ],
)
def test_table_is_copied_into_the_directory_and_over_nothing(
    file: str,
    copied: str,
    folder: Path,
    tmp_path: Path,
    whole: xr.Dataset,
) -> None:
    (folder / "tables" / "a" / "b").mkdir(parents=True)
    file = file.format(absolute=tmp_path)
    table = folder / "tables" / file
    table.write_text(TABLE, encoding="utf-8")
    Path("tables/my.yaml").write_text(
        CASE.replace(CASE.splitlines()[8], f"load: {{kind: history, file: '{file}'}}"),
        encoding="utf-8",
    )
    outside = {str(path) for path in tmp_path.rglob("*")}
    assert main(["run", "tables/my.yaml", "-o", "out", "-q"]) == 0
    assert same_bits("out", whole)
    assert table.read_text(encoding="utf-8") == TABLE
    assert sorted(contents("out")) == sorted(["case.yaml", "progress.jsonl", "result.nc", copied])
    made = {str(path) for path in tmp_path.rglob("*")} - outside
    assert all(path.startswith(str(folder / "out")) for path in made)
    # and runs again from there
    assert main(["run", "out/case.yaml", "-o", "again", "-q"]) == 0
    assert same_bits("again", whole)


def test_two_tables_of_one_name_stay_two(folder: Path) -> None:
    for name, text in (("a", TABLE), ("b", LAW)):
        Path(name).mkdir()
        Path(name, "x.csv").write_text(text, encoding="utf-8")
    law = (
        "material={law: table, file: b/x.csv, quantity: relaxation_modulus, data: shear, "
        "poisson_ratio: 0.5}"
    )
    settings = ["--set", "load={kind: history, file: a/x.csv}", "--set", law]
    assert main(["run", "case.yaml", "-q", *settings]) == 0
    tables = {name: text for name, text in contents("case").items() if name.endswith(".csv")}
    assert sorted(tables.values()) == sorted([TABLE.encode(), LAW.encode()])
    assert main(["run", "case/case.yaml", "-o", "again", "-q"]) == 0
    with vc.open_results("case") as one, vc.open_results("again") as other:
        assert one.attrs["case"] == other.attrs["case"]


def test_table_of_the_users_is_not_replaced_by_one_of_its_name(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("tables").mkdir()
    Path("tables/load.csv").write_text(TABLE, encoding="utf-8")
    Path("out").mkdir()
    Path("out/load.csv").write_text("mine", encoding="utf-8")
    load = ["--set", "load={kind: history, file: tables/load.csv}"]
    for words in ([], ["--overwrite"], ["--resume"]):
        assert main(["run", "case.yaml", "-o", "out", *load, *words]) == 2
        assert "out/load.csv: is there already" in said_in_lines(capsys)[-1]
    assert contents("out") == {"load.csv": b"mine"}
    # but a copy that an earlier run has made is
    assert main(["run", "case.yaml", "-q", *load]) == 0
    Path("tables/load.csv").write_text(TABLE.replace("4", "3"), encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "--overwrite", *load]) == 0
    assert b"3" in contents("case")["load.csv"]


def test_table_whose_name_is_but_a_part_of_a_copys_is_the_users(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("tables").mkdir()
    for name in ("load.csv", "my-load.csv"):
        Path("tables", name).write_text(TABLE, encoding="utf-8")
    first, second = (
        ["--set", f"load={{kind: history, file: tables/{name}}}"]
        for name in ("my-load.csv", "load.csv")
    )
    assert main(["run", "case.yaml", "-q", *first]) == 0
    Path("case/load.csv").write_text("mine", encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "--overwrite", *second]) == 2
    assert "case/load.csv: is there already" in said_in_lines(capsys)[-1]
    assert contents("case")["load.csv"] == b"mine"


@pytest.mark.parametrize(
    "change",
    [
        lambda path: path.write_text("0, 8\n"),
        pytest.param(Path.unlink, marks=pytest.mark.slow),
    ],
)
def test_table_that_is_changed_before_the_first_step_stops_the_run(
    change: Callable[[Path], None],
    folder: Path,
    whole: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("tables").mkdir()
    table = Path("tables/load.csv")
    table.write_text(TABLE, encoding="utf-8")
    words = ["run", "case.yaml", "-q", "--set", f"load={{kind: history, file: {table}}}"]
    march = transient.March

    def marching(*arguments: Any) -> Any:
        change(table)
        return march(*arguments)

    with monkeypatch.context() as patched:
        patched.setattr(transient, "March", marching)
        assert main(words) == 1
    first, *_ = said_in_lines(capsys)
    assert "load.csv was changed while the run was being prepared" in first
    assert not Path("case/load.csv").exists()
    assert not Path("case/result.nc").exists()
    table.write_text(TABLE, encoding="utf-8")
    assert main(words) == 0
    assert same_bits("case", whole)
