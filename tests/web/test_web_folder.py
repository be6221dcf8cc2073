"""What becomes of the page's runs when their folder or the clock is changed from outside."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

from viscontact.cli import main
from viscontact.web.routes import run_routes
from viscontact.web.workspace.folder import Folder
from web.calculator_page import CASE, asking, begun, followed, status

RUN = "20261122-101112-abcdef"


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What a run keeps that is done."""
    folder = tmp_path_factory.mktemp("page")
    with asking(folder) as client:
        run = begun(client, CASE.replace("fields: [0 s, 5 s]", "errors: false"))
        assert followed(client, run)[-1]["state"] == "done"
    return folder / "runs" / run


@pytest.fixture
def folder(kept: Path, tmp_path: Path) -> Path:
    """A folder with such a run."""
    shutil.copytree(kept, tmp_path / "runs" / RUN)
    (tmp_path / "runs" / RUN / "summary.json").unlink(missing_ok=True)
    return tmp_path


def messages(client: Any, *names: str) -> set[str]:
    """Return how answers about a run are refused."""
    answers = [client.get(f"/api/runs/{RUN}/{name}") for name in names]
    assert {answer.status_code for answer in answers} == {409}
    return {answer.json()["problems"][0]["message"] for answer in answers}


DRAWN = ("data", "report.html", "history.csv", "figure/history.svg")


def test_a_truncated_result_is_reported_and_not_shown(folder: Path) -> None:
    result = folder / "runs" / RUN / "run" / "result.nc"
    os.truncate(result, result.stat().st_size // 2)
    with asking(folder) as client:
        reply = status(client, RUN)
        assert (reply["state"], reply["figures"], reply["resumable"]) == ("done", [], False)
        assert messages(client, *DRAWN) == {reply["message"]}
        assert reply["message"].startswith("the result of this run is damaged; delete the run")


def test_a_run_whose_directory_is_deleted_is_reported_and_can_be_removed(folder: Path) -> None:
    with asking(folder) as client:
        assert status(client, RUN)["figures"]
        shutil.rmtree(folder / "runs" / RUN)
        (why,) = messages(client, *DRAWN)
        assert why.startswith("the files of this run are no longer")
        (why,) = messages(client, "given", "case.yaml")
        assert why.startswith("the case of this run is no longer")
        assert client.delete(f"/api/runs/{RUN}").status_code == 204
        assert client.get("/api/runs").json() == []


@pytest.mark.skipif(os.name == "nt", reason="there, links need a privilege")
def test_of_a_run_that_lies_elsewhere_only_the_link_is_removed(
    folder: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    place, elsewhere = folder / "runs" / RUN, tmp_path_factory.mktemp("elsewhere") / RUN
    shutil.move(place, elsewhere)
    place.symlink_to(elsewhere)
    (folder / "runs" / "loop").symlink_to(folder / "runs")
    before = sorted(path.name for path in elsewhere.iterdir())
    with asking(folder) as client:
        assert [run["id"] for run in client.get("/api/runs").json()] == [RUN]
        assert client.delete(f"/api/runs/{RUN}").status_code == 204
    assert not place.is_symlink()
    assert {*before} <= {path.name for path in elsewhere.iterdir()}


def test_a_run_that_cannot_be_removed_stays_in_the_list(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(self: Path, missing_ok: bool = False) -> None:
        raise OSError(30, "Read-only file system")

    with asking(folder) as client:
        with monkeypatch.context() as read_only:
            read_only.setattr(Path, "unlink", refused)
            answer = client.delete(f"/api/runs/{RUN}")
        assert answer.status_code == 507
        assert "cannot be removed" in answer.json()["problems"][0]["message"]
        assert [run["id"] for run in client.get("/api/runs").json()] == [RUN]


def test_a_report_is_made_anew_although_the_clock_was_set_back(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made: list[str] = []

    def counted(ds: xr.Dataset, path: Path, *, label: str) -> None:
        made.append(f"report {len(made) + 1}")
        path.write_text(made[-1], encoding="utf-8")

    monkeypatch.setattr(run_routes, "write_report", counted)
    result = folder / "runs" / RUN / "run" / "result.nc"
    with asking(folder) as client:
        pages = [client.get(f"/api/runs/{RUN}/report.html").text for _ in range(2)]
        hour_ago = result.stat().st_mtime_ns - 3_600 * 10**9
        os.utime(result, ns=(hour_ago, hour_ago))  # it went on after the clock was set back
        pages.append(client.get(f"/api/runs/{RUN}/report.html").text)
        # Where none can be kept, it is handed out nevertheless.
        os.utime(result, ns=(hour_ago - 1, hour_ago - 1))
        monkeypatch.setattr(Folder, "keep_report", _disk_is_full)
        pages.append(client.get(f"/api/runs/{RUN}/report.html").text)
    assert pages == ["report 1", "report 1", "report 2", "report 3"]


def _disk_is_full(self: Folder, name: str, page: bytes, made_from: int) -> None:
    raise OSError(28, "No space left on device")


def test_a_folder_that_cannot_be_written_to_is_refused_in_a_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    assert main(["serve", "--no-open", "--port", "0", "--dir", str(tmp_path / "file")]) == 2
    said = capsys.readouterr().err
    assert said.endswith("; choose another --dir DIR\n")
    assert said.count("\n") == 1


def test_a_run_of_an_earlier_version_is_listed(kept: Path, tmp_path: Path) -> None:
    run = tmp_path / "runs" / RUN
    run.mkdir(parents=True)
    shutil.copy(kept / "request.json", run / "asked.json")
    (run / "found.json").write_text('{"key": "same", "found": {"area": 1}}', encoding="utf-8")
    folder = Folder(tmp_path)
    assert [name for name, _ in folder.runs()] == [RUN]
    assert folder.summary(RUN, "same") == {"area": 1}
    assert folder.summary(RUN, "of another result") is None
