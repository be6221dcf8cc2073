"""What can go wrong with a run's files: one clear message, and nothing that existed is damaged."""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
import signal
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import viscontact as vc
from interrupted_runs import CASE, at_instant, contents, folder, kill, same_bits, whole
from viscontact.cli import main
from viscontact.results.line_digests import with_digest
from viscontact.runs.directory import checkpoint, recorder
from viscontact.runs.directory.progress_log import ProgressLog
from viscontact.runs.directory.result_writer import ResultWriter
from viscontact.simulation import transient
from viscontact.simulation.transient import frictionless

__all__ = ["folder", "whole"]  # fixtures

resource = pytest.importorskip("resource") if os.name != "nt" else None


@pytest.fixture(scope="module")
def stopped_once(tmp_path_factory: pytest.TempPathFactory) -> Path:
    here = tmp_path_factory.mktemp("stopped")
    (here / "case.yaml").write_text(CASE, encoding="utf-8")
    undo = at_instant(4, lambda: signal.raise_signal(signal.SIGTERM))
    with contextlib.chdir(here):
        assert main(["run", "case.yaml", "-q"]) == 130
    undo()
    return here / "case"


@pytest.fixture
def stopped(folder: Path, stopped_once: Path) -> Path:
    """The directory of a run that was stopped, all saved, after its fourth instant."""
    return Path(shutil.copytree(stopped_once, folder / "case"))


def said_in_lines(capsys: pytest.CaptureFixture[str]) -> list[str]:
    """What was said, without a traceback."""
    message = capsys.readouterr().err
    assert "Traceback" not in message
    assert "fault of viscontact" not in message
    return message.splitlines()


# --- a full disk ------------------------------------------------------------------------------


def _full(*arguments: Any, **options: Any) -> None:
    raise OSError(errno.ENOSPC, "No space left on device")


WRITERS = [
    (ProgressLog, "append"),
    (ResultWriter, "append"),
    (ResultWriter, "publish"),
    (checkpoint, "write_plain"),
    (recorder, "save_checkpoint"),
]


@pytest.mark.parametrize(
    ("where", "name", "calls"),
    [
        (ResultWriter, "finish", 0),  # it is called once
        (ProgressLog, "append", 0),
        *((*each, 4) for each in WRITERS),
        *(pytest.param(*each, 0, marks=pytest.mark.slow) for each in WRITERS[1:]),
        *(pytest.param(*each, 6, marks=pytest.mark.slow) for each in WRITERS),
    ],
)
def test_full_disk_stops_the_run_which_continues_once_there_is_space(
    calls: int,
    where: Any,
    name: str,
    folder: Path,
    whole: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    call, count = getattr(where, name), 0

    def filling(*arguments: Any, **options: Any) -> Any:
        nonlocal count
        count += 1
        return _full() if count > calls else call(*arguments, **options)

    with monkeypatch.context() as patched:
        patched.setattr(recorder, "PAUSE", 0.0)
        patched.setattr(recorder, "SHARE", 0.0)
        patched.setattr(where, name, filling)
        code = main(["run", "case.yaml"])
    lines = said_in_lines(capsys)
    assert code == 1
    why, kept, remedy = lines[-3:]
    assert why == "case: the run stopped: [Errno 28] No space left on device"
    if kept == "case keeps nothing yet: no instant was finished":
        number = 0
    else:
        number = int(kept.removeprefix("case keeps ").split()[0])
        assert kept.startswith(f"case keeps {number} of 7 instants")
        assert number > 0
        _, less, saved = kept.partition("; a resumed run continues after ")
        number = int(saved) if less else number
    words = ["run", "case.yaml", *(["--resume"] if number else [])]
    assert remedy == "after correcting that: " + " ".join(["viscontact", *words])
    assert main(words) == 0
    said = capsys.readouterr().err
    if number:
        assert said.startswith(f"case: continuing after {number} of 7 instants")
    assert same_bits("case", whole)


@pytest.mark.skipif(resource is None, reason="Windows has no quota for a process")
@pytest.mark.parametrize(
    "size", [*(pytest.param(size, marks=pytest.mark.slow) for size in (0, 2_000)), 20_000, 60_000]
)
def test_quota_stops_the_run_which_continues_without_it(
    size: int,
    folder: Path,
    whole: xr.Dataset,
    capsys: pytest.CaptureFixture[str],
) -> None:
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        code = main(["run", "case.yaml", "-q"])
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert said_in_lines(capsys)
    if size < 40_000:  # no room for a result without any instant: refused, and nothing created
        assert code == 2
        assert not Path("case").exists()
    else:
        assert code == 1
    if Path("case/result.nc").exists():
        xr.open_dataset("case/result.nc").close()
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)


# --- files that are damaged, or of other programs -----------------------------------------------


def _cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def _empty(path: Path) -> None:
    path.write_bytes(b"")


def _garbage(path: Path) -> None:
    path.write_bytes(bytes(range(256)) * 40)


def _text(path: Path) -> None:
    path.write_text("notes\n" * 9, encoding="utf-8")


def _foreign(path: Path) -> None:
    path.unlink()
    xr.Dataset({"a": ("time", [1.0, 2.0])}).to_netcdf(path)


def _directory(path: Path) -> None:
    path.unlink()
    path.mkdir()


def _link_to_nowhere(path: Path) -> None:
    path.unlink()
    path.symlink_to("nowhere")


DAMAGES = (_cut, _empty, _garbage, _text, _foreign, _directory)


def hashes(directory: Path) -> dict[str, bytes | None]:
    return {
        str(path): path.read_bytes() if path.is_file() else None for path in directory.rglob("*")
    }


@pytest.mark.parametrize("damage", [*DAMAGES, Path.unlink])
@pytest.mark.parametrize("name", ["result.nc", "state.npz", "progress.jsonl"])
def test_damaged_file_is_refused_and_everything_left_as_it_is(
    name: str,
    damage: Callable[[Path], None],
    stopped: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    damage(stopped / name)
    before = hashes(stopped)
    assert main(["run", "case.yaml", "--resume"]) == 2
    lines = said_in_lines(capsys)
    assert len(lines) == 1
    assert name in lines[0]
    assert "--overwrite" in lines[0] or "-o DIR" in lines[0]
    assert hashes(stopped) == before
    assert main(["show", "case"]) in (0, 2)
    said_in_lines(capsys)
    # what can be read of it is not overwritten without being asked either
    assert main(["run", "case.yaml", "-q"]) == (
        0 if damage is Path.unlink and name == "result.nc" else 2
    )


def test_course_of_another_run_is_not_continued(
    stopped: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = stopped / "progress.jsonl"
    lines = [line.rpartition(b', "digest": ')[0] + b"}" for line in path.read_bytes().splitlines()]
    later = [with_digest(line.replace(b'"time": ', b'"time": 1')) for line in lines]
    path.write_bytes(b"\n".join(later) + b"\n")
    before = hashes(stopped)
    assert main(["run", "case.yaml", "--resume"]) == 2
    assert "progress.jsonl is not the course of this run so far" in said_in_lines(capsys)[0]
    assert hashes(stopped) == before


@pytest.mark.parametrize(
    "damage",
    [
        *(pytest.param(each, marks=pytest.mark.slow) for each in (_cut, _empty, _garbage, _text)),
        _foreign,
        _directory,
    ],
)
def test_overwrite_replaces_a_damaged_result(
    damage: Callable[[Path], None],
    stopped: Path,
    whole: xr.Dataset,
    capsys: pytest.CaptureFixture[str],
) -> None:
    damage(stopped / "result.nc")
    code = main(["run", "case.yaml", "-q", "--overwrite"])
    if damage is _directory:  # which may hold anything
        assert code == 2
        assert "is a directory, where a run has a file" in said_in_lines(capsys)[0]
        return
    assert code == 0
    assert same_bits("case", whole)


def test_links_are_replaced_and_not_written_through(
    folder: Path,
    whole: xr.Dataset,
) -> None:
    Path("load.csv").write_text("time [s], force [N]\n0, 0\n1, 4\n", encoding="utf-8")
    load = ["--set", "load={kind: history, file: load.csv}"]
    assert main(["run", "case.yaml", "-q", "-o", "mine", *load]) == 0
    Path("mine", "state.npz").write_text("mine", encoding="utf-8")
    Path("case").mkdir()
    for name in contents("mine"):
        Path("case", name).symlink_to(Path("..", "mine", name))
    before = contents("mine")
    assert main(["run", "case.yaml", "-q", "--overwrite", *load]) == 0
    assert contents("mine") == before
    assert same_bits("case", whole)


def test_result_that_is_a_link_continues_as_a_file(
    stopped: Path,
    whole: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(recorder, "PAUSE", 0.0)
    monkeypatch.setattr(recorder, "SHARE", 0.0)
    store = stopped.parent / "store.nc"
    (stopped / "result.nc").rename(store)
    (stopped / "result.nc").symlink_to(store)
    before = store.read_bytes()
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert store.read_bytes() == before
    assert same_bits("case", whole)


# --- files of other programs ------------------------------------------------------------------


@pytest.mark.parametrize("words", [[], ["--overwrite"], ["--resume"]])
@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("state.npz", "precious"),
        ("progress.jsonl", "{}"),
        ("progress.jsonl", '{"time": 1, "temperature": 20}'),
    ],
)
def test_file_that_no_run_has_written_is_not_replaced(
    name: str,
    content: str,
    words: list[str],
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("d").mkdir()
    for each, text in ((name, content), ("case.yaml", "precious")):
        Path("d", each).write_text(text, encoding="utf-8")
    before = contents("d")
    assert main(["run", "case.yaml", "-q", "-o", "d", *words]) == 2
    (line,) = said_in_lines(capsys)
    assert contents("d") == before
    Path("d/case.yaml").unlink()
    assert main(["run", "case.yaml", "-q", "-o", "d", *words]) == 2
    (line,) = said_in_lines(capsys)
    assert f"d/{name}" in line
    assert "-o DIR" in line
    assert "--overwrite" not in line  # which is refused as well
    assert sorted(contents("d")) == [name]


def test_hidden_files_of_other_programs_stay(folder: Path) -> None:
    Path("d").mkdir()
    Path("d/.result.nc.backup").write_text("precious", encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "d"]) == 0
    Path("d/state.npz").write_text("precious", encoding="utf-8")
    assert main(["run", "case.yaml", "-q", "-o", "d", "--resume"]) == 0  # over already
    assert contents("d")[".result.nc.backup"] == contents("d")["state.npz"] == b"precious"


@pytest.mark.parametrize(
    "name",
    [
        *(
            pytest.param(name, marks=pytest.mark.slow)
            for name in (".state.npz.new", ".case.yaml.new")
        ),
        ".result.nc.working",
    ],
)
def test_link_at_a_temporary_name_is_not_written_through(
    name: str,
    folder: Path,
    whole: xr.Dataset,
) -> None:
    Path("precious.txt").write_text("precious", encoding="utf-8")
    Path("d").mkdir()
    Path("d", name).symlink_to(Path("..", "precious.txt"))
    assert main(["run", "case.yaml", "-q", "-o", "d"]) == 0
    assert Path("precious.txt").read_text(encoding="utf-8") == "precious"
    assert same_bits("d", whole)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no named pipes in directories")
@pytest.mark.parametrize("words", [[], ["--overwrite"], ["--resume"]])
@pytest.mark.parametrize("name", ["result.nc", "state.npz", "progress.jsonl"])
def test_pipe_is_no_file_of_a_run(
    name: str, words: list[str], stopped: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (stopped / name).unlink()
    os.mkfifo(stopped / name)
    with ending_within(10):
        assert main(["run", "case.yaml", *words]) == 2
    (line,) = said_in_lines(capsys)
    assert f"{name}: is not a regular file" in line


@contextmanager
def ending_within(seconds: int) -> Iterator[None]:
    def late(*arguments: Any) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("line", ["[" * 200_000, '{"time": 1' + "0" * 400 + "}", '{"time": 1'])
def test_course_that_cannot_be_read_is_refused_and_the_hidden_copy_stays(
    line: str,
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    kill(4, "-q")
    Path("case/.result.nc.working").write_text("unpublished", encoding="utf-8")
    path = Path("case/progress.jsonl")
    path.write_text(line + "\n" * 20, encoding="utf-8")
    before = contents("case")
    assert main(["run", "case.yaml", "--resume"]) == 2
    (said,) = said_in_lines(capsys)
    assert "progress.jsonl is damaged" in said
    assert contents("case") == before


@pytest.mark.skipif(os.name == "nt", reason="Windows removes no open file")
def test_course_that_is_removed_meanwhile_is_written_anew(
    folder: Path,
    whole: xr.Dataset,
) -> None:
    assert main(["run", "case.yaml", "-q", "-o", "other"]) == 0
    undo = at_instant(4, Path("case/progress.jsonl").unlink)
    try:
        assert main(["run", "case.yaml", "-q"]) == 0
    finally:
        undo()
    assert contents("case")["progress.jsonl"] == contents("other")["progress.jsonl"]
    assert same_bits("case", whole)


# --- where nothing can be written ---------------------------------------------------------------


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="root may write everywhere")
def test_directory_that_may_not_be_written_to_is_refused(
    stopped: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = contents("case")
    stopped.chmod(0o555)
    try:
        codes = [main(["run", "case.yaml", *words]) for words in (["--resume"], ["--overwrite"])]
        codes.append(main(["run", "case.yaml", "-o", "case/deeper"]))
    finally:
        stopped.chmod(0o755)
    assert codes == [2, 2, 2]
    assert len(said_in_lines(capsys)) == 3
    assert contents("case") == before


@pytest.mark.parametrize("call", ["mkdir", "lock", "working copy"])
def test_directory_that_cannot_be_written_to_is_refused(
    call: str,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def refusing(*arguments: Any, **options: Any) -> Any:
        raise OSError(errno.EROFS, "Read-only file system")

    @contextmanager
    def locking(directory: Path) -> Iterator[None]:
        refusing()
        yield

    with monkeypatch.context() as patched:
        if call == "mkdir":
            patched.setattr(Path, "mkdir", refusing)
        elif call == "lock":
            patched.setattr("viscontact.runs.execution.run_directory.locked", locking)
        else:
            patched.setattr("viscontact.runs.directory.result_writer.created", refusing)
        assert main(["run", "case.yaml"]) == 2
    [line] = said_in_lines(capsys)
    assert "Read-only file system" in line
    assert [path.name for path in folder.iterdir()] == ["case.yaml"]


def test_finished_run_on_a_disk_that_is_read_only_is_still_finished(
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert main(["run", "case.yaml", "-q"]) == 0

    def refusing(*arguments: Any, **options: Any) -> Any:
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr("viscontact.runs.execution.run_directory.locked", refusing)
    monkeypatch.setattr(Path, "unlink", refusing)
    assert main(["run", "case.yaml", "--resume"]) == 0


# --- runs that fail -----------------------------------------------------------------------------


def test_contact_at_the_rim_advises_no_resumption(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    small = ["--set", "grid.size=[2.1 mm, 2.1 mm]", "-q"]
    assert main(["run", "case.yaml", *small]) == 1
    why, kept, remedy = said_in_lines(capsys)
    assert "enlarge grid.size" in why
    number = int(kept.removeprefix("case keeps ").split()[0])
    assert remedy == "with that changed, run it again with --overwrite"
    with vc.open_results("case") as ds:
        assert ds.sizes["time"] == number > 1
    # who tries all the same gets the same
    assert main(["run", "case.yaml", *small, "--resume"]) == 1
    assert said_in_lines(capsys) == [why, kept, remedy]


def test_failed_step_stands_at_the_end_of_the_result(
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    solve = frictionless.solve_contact

    def failing(problem: Any, *arguments: Any, **options: Any) -> Any:
        solution = solve(problem, *arguments, **options)
        failing.count = getattr(failing, "count", 0) + 1
        done = failing.count < 4
        return solution if done else type(solution)(**{**vars(solution), "converged": False})

    with monkeypatch.context() as patched:
        patched.setattr(frictionless, "solve_contact", failing)
        assert main(["run", "case.yaml", "-q"]) == 1
    why, kept, remedy = said_in_lines(capsys)
    assert "short of the tolerance" in why
    assert kept == "case keeps 4 of 7 instants"
    assert "--resume" not in remedy
    with vc.open_results("case") as ds:
        assert ds.outcome.values.tolist()[-2:] == [vc.Outcome.CONVERGED, vc.Outcome.NOT_CONVERGED]
        assert ds.sizes["time"] == 5


def test_memory_that_runs_out_stops_the_run_in_one_message(
    folder: Path,
    whole: xr.Dataset,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    solve, count = frictionless.solve_contact, 0

    def solving(*arguments: Any, **options: Any) -> Any:
        nonlocal count
        count += 1
        if count == 4:
            raise MemoryError
        return solve(*arguments, **options)

    with monkeypatch.context() as patched:
        patched.setattr(frictionless, "solve_contact", solving)
        assert main(["run", "case.yaml", "-q"]) == 1
    assert said_in_lines(capsys)[0] == "case: the run stopped: MemoryError"
    assert main(["run", "case.yaml", "-q", "--resume"]) == 0
    assert same_bits("case", whole)


# --- names of data files ------------------------------------------------------------------------

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


def test_case_that_is_no_text_is_replaced_when_asked(
    stopped: Path,
    whole: xr.Dataset,
) -> None:
    (stopped / "case.yaml").write_bytes(b"title: R\xf6lle\n")
    assert main(["run", "case.yaml", "-q", "--overwrite"]) == 0
    assert same_bits("case", whole)


def test_clock_that_is_set_back_makes_no_duration_negative(
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    shown = iter(range(2 * 10**9, 0, -3600))
    with monkeypatch.context() as patched:
        patched.setattr(clock, "time", lambda: float(next(shown)))
        assert main(["run", "case.yaml"]) == 0
    with vc.open_results("case") as ds:
        assert 0 < ds.attrs["wall_time"] < 60
    times_left = [line.split("about")[1] for line in said_in_lines(capsys) if "about" in line]
    assert times_left
    assert "-" not in "".join(times_left)


def test_moved_directory_continues_where_it_is(
    stopped: Path,
    whole: xr.Dataset,
) -> None:
    shutil.move(stopped, "elsewhere")
    assert main(["run", "case.yaml", "-o", "elsewhere", "-q", "--resume"]) == 0
    assert same_bits("elsewhere", whole)
