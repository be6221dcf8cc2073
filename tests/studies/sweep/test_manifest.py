"""Manifest of a sweep: written once, read line by line, damage named by its line."""

from __future__ import annotations

import os
import sys
import tracemalloc
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viscontact.cli import main
from viscontact.cli.sweep.recorded_sweep import RecordedSweep, recorded_runs
from viscontact.cli.terminal.messages import CommandError
from viscontact.results.line_digests import with_digest
from viscontact.results.run_files import FAILURE_NAME, MANIFEST_NAME, STATE_NAME
from viscontact.studies.sweep.continuation import continued
from viscontact.studies.sweep.manifest import DESIGNS, SweepRun, read_manifest, write_manifest

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 1 N}
time: {end: 1 s, steps: 1}
grid: {shape: [16, 16], size: [4 mm, 4 mm]}
output: {errors: false}
"""
KEY = "load.force"
RUN = SweepRun(
    0, "force=5N", "a_force=5N", {"load.force": "5 N"}, ("load.force",), "a.yaml", "grid"
)
LINE = (
    '{"run": 0, "name": "force=5N", "directory": "a_force=5N", "settings": {"load.force": "5 N"}, '
    '"varied": ["load.force"], "case": "a.yaml", "design": "grid"}'
)
TEXTS = st.text(st.characters(exclude_categories=["Cs"]))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "a.yaml").write_text(CASE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@given(st.lists(st.dictionaries(TEXTS, TEXTS), min_size=1, max_size=4), TEXTS, st.data())
def test_what_is_written_is_read(
    tmp_path_factory: pytest.TempPathFactory,
    settings: list[dict[str, str]],
    text: str,
    data: st.DataObject,
) -> None:
    directory = tmp_path_factory.mktemp("sweep")
    runs = [
        SweepRun(n, text, "d", each, tuple(each)[:1], text, data.draw(st.sampled_from(DESIGNS)))
        for n, each in enumerate(settings)
    ]
    path = write_manifest(directory, iter(runs))
    assert list(read_manifest(path)) == runs
    assert [each.name for each in directory.iterdir()] == [MANIFEST_NAME]


def test_a_line_is_the_documented_object(tmp_path: Path) -> None:
    path = write_manifest(tmp_path / "new", [RUN])
    whole = LINE.replace('"grid"}', '"grid", "last": true}')
    assert path.read_bytes() == with_digest(whole.encode()) + b"\n"
    path.write_text(LINE.replace("a.yaml", "\\udcff.yaml"), encoding="utf-8")  # no UTF-8 name
    (kept,) = read_manifest(path)
    assert os.fsencode(kept.case) == b"\xff.yaml"
    assert list(read_manifest(write_manifest(tmp_path, [kept]))) == [kept]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (LINE[:50], "is not a line of JSON"),
        ("", "is not a line of JSON"),
        ("7", "must be an object of JSON"),
        ("[" * 100_000, "nested too deeply"),
        (LINE.replace('"run": 0', '"run": 1.0'), "run: must be a whole number, got 1.0"),
        (LINE.replace('"run": 0', '"run": true'), "run: must be 1, the number of its line"),
        (LINE, "run: must be 1, the number of its line, got 0"),
        (LINE.replace('"name": "force=5N", ', ""), "name: must be text, got nothing"),
        (LINE.replace('"5 N"', "5"), "settings: load.force must be text with its unit, got 5"),
        (LINE.replace('["load.force"]', '["load.kind"]'), "varied: 'load.kind' is none of"),
        (LINE.replace('["load.force"]', "[[]]"), "varied: must be a list of keys, got []"),
        (LINE.replace('"grid"', '"list"'), "design: must be grid, zip, table, sample, cases"),
        (LINE.replace("a_force=5N", "../a"), "directory: must be the name of a directory in"),
        (LINE.replace("a_force=5N", "C:a"), "directory: must be the name of a directory in"),
        (LINE.replace("a_force=5N", "/a"), "directory: must be the name of a directory in"),
        (LINE.replace("a_force=5N", ""), "directory: must be the name of a directory in"),
        (LINE.replace("a.yaml", "\xff"), "is not UTF-8 text"),
    ],
)
def test_a_damaged_line_is_named_with_its_number(tmp_path: Path, line: str, said: str) -> None:
    numbered = line if said.startswith("run:") else line.replace('"run": 0', '"run": 1')
    path = tmp_path / MANIFEST_NAME
    path.write_bytes(f"{LINE}\n{numbered}\n".encode("latin-1"))
    with pytest.raises(ValueError, match="^" + str(path).replace("\\", "\\\\")) as caught:
        list(read_manifest(path))
    assert said in str(caught.value)
    assert f"{path}:2: " in str(caught.value) or "UTF-8" in said


def test_a_manifest_that_lacks_its_end_or_has_another_digit_is_refused(tmp_path: Path) -> None:
    runs = [replace(RUN, run=n, name=f"{n}", directory=f"{n}") for n in range(3)]
    path = write_manifest(tmp_path, runs)
    whole = path.read_bytes()
    path.write_bytes(b"".join(whole.splitlines(keepends=True)[:2]))
    with pytest.raises(ValueError, match=r"runs\.jsonl: is damaged: its last runs are missing"):
        list(read_manifest(path))
    path.write_bytes(whole.replace(b"5 N", b"7 N"))
    with pytest.raises(ValueError, match=r"runs\.jsonl:1: is damaged: it is not as it was written"):
        list(read_manifest(path))


def test_an_empty_manifest_is_refused(tmp_path: Path) -> None:
    path = tmp_path / MANIFEST_NAME
    path.touch()
    with pytest.raises(ValueError, match="holds no runs"):
        list(read_manifest(path))


def test_a_failure_keeps_the_earlier_manifest(tmp_path: Path) -> None:
    path = write_manifest(tmp_path, [RUN])
    with pytest.raises(ZeroDivisionError):
        write_manifest(tmp_path, (RUN if n else 1 // n for n in (1, 0)))  # type: ignore[misc]
    assert list(read_manifest(path)) == [RUN]


@pytest.mark.skipif(sys.gettrace() is not None, reason="a tracer allocates memory")
def test_memory_does_not_grow_with_the_number_of_runs(tmp_path: Path) -> None:
    count = 10_000
    tracemalloc.start()
    runs = (SweepRun(n, "", f"d{n}", {}, (), "a.yaml", "grid") for n in range(count))
    path = write_manifest(tmp_path, runs)
    assert sum(1 for _ in read_manifest(path)) == count
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 0.1 * path.stat().st_size  # 10 000 lines


def test_a_sweep_writes_its_manifest_before_its_first_run(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    names: list[list[str]] = []

    def started(*_: object, **__: object) -> None:
        assert len(list(read_manifest(folder / "out" / MANIFEST_NAME))) == 4
        names.append([each.name for each in (folder / "out").iterdir()])
        raise OSError("no process")

    monkeypatch.setattr("viscontact.studies.executors.local._Worker", started)
    words = ["run", "a.yaml", "--vary", "load.force=1 N,2 N", "--vary", "time.end=1 s, 3 s"]
    assert main([*words, "--set", "title=One = two", "-o", "out", "-q"]) == 1
    assert names[0] == [MANIFEST_NAME]
    runs = list(read_manifest(folder / "out" / MANIFEST_NAME))
    assert runs[1] == SweepRun(
        1,
        "force=1N_end=3s",
        "a_force=1N_end=3s",
        {"title": "One = two", "load.force": "1 N", "time.end": "3 s"},
        ("load.force", "time.end"),
        "../a.yaml",
        "grid",
    )
    assert [each.run for each in runs] == [0, 1, 2, 3]
    assert {each.design for each in runs} == {"grid"}


def test_several_cases_have_a_manifest_if_they_have_a_directory(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def started(*_: object, **__: object) -> None:
        raise OSError("no process")

    monkeypatch.setattr("viscontact.studies.executors.local._Worker", started)
    (folder / "b.yaml").write_text(CASE, encoding="utf-8")
    assert main(["run", "a.yaml", "b.yaml", "-q"]) == 1
    assert not list(folder.rglob(MANIFEST_NAME))  # the runs lie next to their cases
    assert main(["run", "a.yaml", "b.yaml", "-q", "-o", "out"]) == 1
    first, second = read_manifest(folder / "out" / MANIFEST_NAME)
    assert (first.name, first.directory, first.case) == ("a", "a", "../a.yaml")
    assert (second.name, second.varied, second.design) == ("b", (), "cases")


def recorded(directory: Path, *forces: str, **others: str) -> RecordedSweep:
    """The sweep of a command, and the one in the manifest."""
    runs = [
        SweepRun(n, text, f"a_{text}", {KEY: text, **others}, (KEY,), "../a.yaml", "grid")
        for n, text in enumerate(forces)
    ]
    return RecordedSweep(directory, runs, recorded_runs(directory))


def begin(directory: Path) -> None:
    """Leave the restart data of a run in a directory."""
    directory.mkdir()
    (directory / STATE_NAME).touch()


def test_the_manifest_of_another_sweep_is_not_replaced(tmp_path: Path) -> None:
    recorded(tmp_path, "1N", "2N").write()
    kept = (tmp_path / MANIFEST_NAME).read_bytes()
    recorded(tmp_path, "3N").continued(resume=False)  # nothing would be lost
    begin(tmp_path / "a_2N")
    for now, resume, said in (
        (recorded(tmp_path, "3N"), False, "the 2 runs of its runs.jsonl"),
        (recorded(tmp_path, "1N", "3N"), True, "its run a_2N has results, and is none of these"),
        (recorded(tmp_path, "1N", "2N", load="5"), True, "with the load of its case, not 5"),
        (recorded(tmp_path, "1N", "2N", "3N"), False, "add runs to it: with --resume"),
    ):
        with pytest.raises(CommandError) as refused:
            now.continued(resume=resume)
        assert said in " ".join(refused.value.lines)
    # Each run is checked by itself.
    recorded(tmp_path, "1N", "2N").continued(resume=False).write()
    assert (tmp_path / MANIFEST_NAME).read_bytes() == kept
    recorded(tmp_path, "3N", "1N", "2N").continued(resume=True).write()
    assert [each.name for each in read_manifest(tmp_path / MANIFEST_NAME)] == ["3N", "1N", "2N"]


def test_runs_without_results_may_change_and_be_left_out(tmp_path: Path) -> None:
    recorded(tmp_path, "1N", "2N", "200N").write()
    begin(tmp_path / "a_1N")
    (tmp_path / "a_200N").mkdir()
    (tmp_path / "a_200N" / FAILURE_NAME).touch()
    again = recorded(tmp_path, "1N", "2N", "20N").continued(resume=True)
    assert [each.directory for each in again.runs] == ["a_1N", "a_2N", "a_20N"]
    other = recorded(tmp_path, "1N", "2N", "200N", load="5")
    with pytest.raises(CommandError) as refused:
        other.continued(resume=True)
    place = tmp_path / MANIFEST_NAME
    assert f"viscontact run --task 2 {place} --set KEY=VALUE" in refused.value.lines[2]
    assert refused.value.lines[1].startswith("to correct the load.force of a_200N: repeat the")
    (tmp_path / "a_1N" / STATE_NAME).unlink()
    assert other.continued(resume=True).runs == other.runs


def test_equal_quantities_are_the_same_run_however_they_are_written(tmp_path: Path) -> None:
    recorded(tmp_path, "1N", "2N", size="[1 mm, 2mm]", law="zener").write()
    begin(tmp_path / "a_1N")
    begin(tmp_path / "a_2N")
    same = recorded(tmp_path, "1 N", "2000 mN", "3 N", size="[1mm, 0.2 cm]", law="zener")
    found = same.continued(resume=True).runs
    assert [each.directory for each in found] == ["a_1N", "a_2N", "a_3 N"]
    assert found[:2] == same.earlier
    for other in ({"size": "[1 mm, 3 mm]"}, {"law": "maxwell"}, {"size": "[1 mm, 2 um]"}):
        given = {"size": "[1 mm, 2mm]", "law": "zener"} | other
        [key] = other
        with pytest.raises(CommandError, match=f"its run a_1N has results with {key}="):
            recorded(tmp_path, "1N", "2N", **given).continued(resume=True)


def test_settings_of_a_single_run_are_kept(tmp_path: Path) -> None:
    first = recorded(tmp_path, "1N", "2N", size="1 mm")
    changed = replace(first.runs[1], settings={KEY: "2N", "size": "3 mm"}, changed=("size",))
    write_manifest(tmp_path, [first.runs[0], changed])
    again = recorded(tmp_path, "1N", "2N", "3N", size="1 mm")
    assert again.continued(resume=True).runs[1] == changed  # it has failed
    begin(tmp_path / "a_2N")
    found = again.continued(resume=True)
    assert [each.settings["size"] for each in found.runs] == ["1 mm", "3 mm", "1 mm"]
    found.write()
    assert list(read_manifest(tmp_path / MANIFEST_NAME)) == found.runs


def test_settings_of_a_single_run_are_kept_where_those_of_all_change(tmp_path: Path) -> None:
    first = recorded(tmp_path, "1N", "2N", size="1 mm", load="5")
    own = {KEY: "2N", "size": "3 mm", "load": "5"}
    changed = replace(first.runs[1], settings=own, changed=("size",))
    write_manifest(tmp_path, [first.runs[0], changed])
    found = recorded(tmp_path, "1N", "2N", size="2 mm", load="6").continued(resume=True).runs
    assert [each.settings["size"] for each in found] == ["2 mm", "3 mm"]
    assert [each.settings["load"] for each in found] == ["6", "6"]
    assert [each.changed for each in found] == [(), ("size",)]
    # A key that is varied now is no longer that of a run alone.
    varied = replace(first.runs[1], varied=(KEY, "size"), settings=own | {"size": "4 mm"})
    [kept] = continued(tmp_path, [varied], [changed])
    assert (kept.settings["size"], kept.changed) == ("4 mm", ())


def test_a_damaged_manifest_is_refused_when_the_sweep_is_resumed(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "out").mkdir()
    (folder / "out" / MANIFEST_NAME).write_text("{}", encoding="utf-8")
    assert main(["run", "a.yaml", "--vary", "load.force=5N", "-o", "out", "--resume"]) == 2
    assert f"{Path('out') / MANIFEST_NAME}:1: run: must be" in capsys.readouterr().err
