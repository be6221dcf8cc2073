"""Manifest of ten thousand runs with torn lines: refused with the line, and no result is lost."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path

import pytest

from viscontact.cli import main
from viscontact.results.run_files import MANIFEST_NAME, RESULT_NAME
from viscontact.studies.sweep.manifest import SweepRun, read_manifest, write_manifest

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 0.5 N}
time: {end: 1 s, steps: 1}
grid: {shape: [24, 24], size: [5 mm, 5 mm]}
output: {errors: false}
"""
SWEEP = ["run", "ball.yaml", "--vary", "load.force=0.1N,0.2N", "-o", "out", "-j", "1", "-q"]


def write_runs(folder: Path, count: int) -> list[bytes]:
    """Lines of a manifest of some runs."""
    runs = (
        SweepRun(n, f"force={n}N", f"a_force={n}N", {"load.force": f"{n} N"}, (), "a.yaml", "grid")
        for n in range(count)
    )
    return write_manifest(folder, runs).read_bytes().splitlines(keepends=True)


def cut(lines: list[bytes], chance: random.Random) -> list[bytes]:
    n = chance.randrange(len(lines))
    return [*lines[:n], lines[n][: chance.randrange(1, len(lines[n]) - 1)]]


def torn(lines: list[bytes], chance: random.Random) -> list[bytes]:
    n = chance.randrange(len(lines) - 1)
    return [*lines[:n], lines[n][: chance.randrange(1, len(lines[n]) - 1)], *lines[n + 1 :]]


def without_one(lines: list[bytes], chance: random.Random) -> list[bytes]:
    n = chance.randrange(len(lines) - 1)
    return lines[:n] + lines[n + 1 :]


def one_twice(lines: list[bytes], chance: random.Random) -> list[bytes]:
    n = chance.randrange(len(lines))
    return lines[: n + 1] + lines[n:]


def zeros(lines: list[bytes], chance: random.Random) -> list[bytes]:
    n = chance.randrange(len(lines))
    return [*lines[:n], bytes(len(lines[n])), *lines[n + 1 :]]


def exchanged(lines: list[bytes], chance: random.Random) -> list[bytes]:
    n = chance.randrange(len(lines) - 1)
    return [*lines[:n], lines[n + 1], lines[n], *lines[n + 2 :]]


DAMAGES = [cut, torn, without_one, one_twice, zeros, exchanged]


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.parametrize(
    ("count", "times"), [(200, 3), pytest.param(10_000, 10, marks=pytest.mark.slow)]
)
def test_torn_lines_are_refused_with_their_place(
    damage: Callable[[list[bytes], random.Random], list[bytes]],
    count: int,
    times: int,
    tmp_path: Path,
) -> None:
    chance, lines = random.Random(20261128), write_runs(tmp_path, count)
    path = tmp_path / MANIFEST_NAME
    for _ in range(times):
        path.write_bytes(b"".join(damage(lines, chance)))
        read = []
        with pytest.raises(ValueError, match=MANIFEST_NAME.replace(".", r"\.")):
            read.extend(read_manifest(path))
        assert [each.run for each in read] == list(range(len(read)))  # those before the damage


def test_no_result_is_lost_with_a_torn_manifest(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("ball.yaml").write_text(CASE, encoding="utf-8")
    assert main(SWEEP) == 0
    manifest = Path("out") / MANIFEST_NAME
    whole, results = manifest.read_bytes(), sorted(Path("out").glob(f"*/{RESULT_NAME}"))
    before = [each.stat().st_mtime_ns for each in results]
    assert len(before) == 2
    manifest.write_bytes(whole[:-40])
    capsys.readouterr()
    for words in (["status", "out"], ["collect", "out", "-o", "a.csv"], [*SWEEP, "--resume"]):
        assert main(words) == 2
        said = capsys.readouterr().err
        assert f"{manifest}:2: " in said
        assert "repeat the command that began the sweep with --resume" in said
    manifest.unlink()  # what the message says
    assert main([*SWEEP, "--resume"]) == 0
    assert manifest.read_bytes() == whole
    assert [each.stat().st_mtime_ns for each in results] == before  # no run was repeated
