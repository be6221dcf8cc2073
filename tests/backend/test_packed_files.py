"""Files read in a process of their own, with limits of memory and time, and how it ends."""

from __future__ import annotations

import os
import re
import signal
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from viscontact.backend import reading_process
from viscontact.backend.packed_files import read_packed
from viscontact.backend.reading_child import ReadingRequest
from viscontact.backend.reading_limits import VARIABLE, End, ReadingLimits, reading_limits
from viscontact.backend.reading_process import UnansweredError, read_apart
from viscontact.backend.record import Record

SMALL = ReadingLimits(size=1000, memory=500_000_000)
HASTY = ReadingLimits(size=1000, memory=10_000_000)  # 0.4 s


@pytest.fixture(autouse=True, scope="module")
def importable() -> Iterator[None]:
    """Let the process of a reading import this file."""
    reading_process._close_spare()
    places = [str(Path(__file__).parents[1]), *filter(None, [os.environ.get("PYTHONPATH")])]
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", os.pathsep.join(places))
        yield
        reading_process._close_spare()


def request(read: Callable[..., Any], *arguments: Any, **changed: Any) -> ReadingRequest:
    """Return a request with the limits of a small file."""
    return replace(ReadingRequest(read, arguments, tuple, SMALL), **changed)


def end_of(asked: ReadingRequest) -> UnansweredError:
    """Return how a process ends that does not answer."""
    with pytest.raises(UnansweredError) as found:
        read_apart(asked)
    return found.value


def test_values_and_arrays_arrive_unchanged() -> None:
    values = {"name": "Größe \n \udce9", "numbers": [0.1, -0.0, 1e-320, None, True]}
    arrays = {
        "map": np.random.default_rng(3).standard_normal((5, 7)).T,
        "none": np.zeros((0, 4)),
        "counts": np.arange(6, dtype=np.int16)[::2],
        "known": np.array([True, False]),
    }
    found = read_apart(request(Record, values, arrays))
    assert found.values == values
    assert [str(each) for each in found.values["numbers"]] == [
        *("0.1", "-0.0", "1e-320", "None", "True")
    ]
    for name, array in arrays.items():
        assert found.arrays[name].dtype == array.dtype
        assert found.arrays[name].tobytes() == array.tobytes()


def test_refusal_of_a_reader_arrives_and_its_process_reads_on() -> None:
    first = read_apart(request(_pid)).values
    with pytest.raises(ValueError, match=r"^invalid literal for int\(\) with base 10: 'x'$"):
        read_apart(request(int, "x"))
    assert read_apart(request(_pid)).values == first


def _pid() -> Record:
    return Record(os.getpid())


@pytest.mark.skipif(sys.platform != "linux", reason="limits are those of Linux")
def test_memory_is_limited_by_the_system() -> None:
    assert end_of(request(bytearray, 510_000_000)).end is End.MEMORY
    # What fits is returned, and the limit is that of the larger file.
    larger = replace(SMALL, memory=1_500_000_000)
    with pytest.raises(ValueError, match="bytearray"):
        read_apart(request(bytearray, 510_000_000, limits=larger))


def test_memory_is_watched_where_the_system_does_not_limit_it() -> None:
    limits = replace(SMALL, memory=200_000_000)  # 8 s
    assert end_of(request(_grow, by_system=False, limits=limits)).end is End.MEMORY


def _grow() -> None:
    """Take more and more memory, 1 GB at most."""
    kept = []
    for _ in range(100):
        kept.append(b"x" * 10_000_000)
        time.sleep(0.005)


def test_time_is_limited() -> None:
    begun = time.monotonic()
    limits = replace(SMALL, memory=5_000_000)  # 0.2 s
    assert end_of(request(time.sleep, 60, limits=limits)).end is End.TIME
    assert time.monotonic() - begun < 20


def test_crash_ends_with_its_signal() -> None:
    crash = end_of(request(os.abort))
    assert crash.end is End.CRASH
    if os.name == "posix":
        assert crash.how == "SIGABRT"
    assert end_of(request(os._exit, 3)).how == "exit code 3"


def test_answer_larger_than_the_limit_is_not_taken() -> None:
    many = np.zeros(1_500_000)
    assert end_of(request(Record, None, {"a": many}, limits=HASTY)).end is End.MEMORY
    assert end_of(request(Record, "x" * 12_000_000, limits=HASTY)).end is End.MEMORY


@pytest.mark.skipif(os.name != "posix", reason="elsewhere it ends with its parent only")
def test_process_that_has_ended_meanwhile_is_replaced() -> None:
    first = read_apart(request(_pid)).values
    os.kill(first, signal.SIGALRM)
    assert read_apart(request(_pid)).values != first


def test_process_that_cannot_be_started_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    reading_process._close_spare()
    monkeypatch.setattr(sys, "executable", "/no/such/python")
    with pytest.raises(ValueError, match=r"binary files cannot be started: .*python"):
        read_apart(request(_pid))


def test_limits_grow_with_the_file_and_by_the_variable(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "map.npz"
    file.write_bytes(b"PK")
    assert reading_limits(file).memory == 500_000_000
    with file.open("r+b") as opened:
        opened.truncate(100_000_000)
    assert reading_limits(file).memory == 2_000_000_000
    monkeypatch.setenv(VARIABLE, "4000")
    assert reading_limits(file).memory == 4_000_000_000
    monkeypatch.setenv(VARIABLE, "4 GB")
    with pytest.raises(ValueError, match=rf"^{VARIABLE}: must be a number of megabytes.*'4 GB'"):
        reading_limits(file)


def test_message_states_limit_size_and_remedy(tmp_path: Path) -> None:
    (tmp_path / "far.xlsx").write_bytes(b"PK")
    stated = (
        "far.xlsx: needs more than 500 MB of memory to read, the limit for a file of 0.001 MB; "
        f"save it as CSV; the environment variable {VARIABLE} raises the limit"
    )
    with pytest.raises(ValueError, match=f"^{re.escape(stated)}$"):
        read_packed(tmp_path / "far.xlsx", _take, remedy="save it as CSV")


def _take(file: Path) -> None:
    assert file.is_absolute()
    raise MemoryError


def test_script_without_a_main_guard_reads_a_workbook_once(tmp_path: Path) -> None:
    """A process that is spawned would import the script again."""
    import subprocess

    (tmp_path / "script.py").write_text(
        "print('begun')\n"
        "from viscontact.tables.workbook import write_workbook\n"
        "from viscontact.tables import read_table\n"
        "with open('a.xlsx', 'wb') as file:\n"
        "    write_workbook(file, [['time [s]', 'D [1/GPa]'], ['1', '0.5'], ['2', '0.6']])\n"
        "print(len(read_table('a.xlsx')))\n"
    )
    done = subprocess.run(
        [sys.executable, "-W", "error", "script.py"], cwd=tmp_path, capture_output=True, text=True
    )
    assert (done.stdout, done.stderr) == ("begun\n2\n", "")
