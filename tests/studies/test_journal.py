"""Journals of studies: runs by their values, locked against other writers."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from viscontact.results.line_digests import with_digest
from viscontact.studies.journal import JOURNAL_NAME, Entry, journal_of

ARGUMENTS = {"case": "abc", "change": {"load.force": ("1 N", "2 N")}}


def kept(place: Path, **runs: float) -> dict[str, Entry]:
    """Journal in a directory after some runs."""
    with journal_of("design", ARGUMENTS, directory=place) as journal:
        assert journal is not None
        for key, value in runs.items():
            journal.keep(key, Entry({"value": value}))
        return dict(journal.recorded)


def test_runs_are_found_again_by_their_values(tmp_path: Path) -> None:
    kept(tmp_path / "found", a=0.1, b=math.inf)
    assert kept(tmp_path / "found", c=1 / 3) == {
        "a": Entry({"value": 0.1}),
        "b": Entry({"value": math.inf}),
        "c": Entry({"value": 1 / 3}),
    }
    assert kept(tmp_path / "found")["c"] == Entry({"value": 1 / 3})
    assert len((tmp_path / "found" / JOURNAL_NAME).read_text().splitlines()) == 1 + 3


@pytest.mark.parametrize(
    ("line", "entry"),
    [
        ({"values": {"force": [1.0, 0.1]}, "warnings": ""}, Entry({"force": [1.0, 0.1]})),
        (
            {"value": 2.0, "error": 0.5, "warnings": "a\nb"},
            Entry({"value": 2.0, "error": 0.5}, "", "a\nb"),
        ),
        ({"failure": "no contact"}, Entry(failure="no contact")),
    ],
)
def test_entries_of_earlier_versions_are_read(
    tmp_path: Path, line: dict[str, object], entry: Entry, caplog: pytest.LogCaptureFixture
) -> None:
    kept(tmp_path)
    header = json.loads((tmp_path / JOURNAL_NAME).read_text())
    del header["digest"]
    lines = (header, ["run", line])
    (tmp_path / JOURNAL_NAME).write_text("".join(f"{json.dumps(each)}\n" for each in lines))
    assert kept(tmp_path) == {"run": entry}
    assert kept(tmp_path) == {"run": entry}  # which has digests now
    (said,) = caplog.messages
    assert "trials.jsonl has no digests" in said


def test_a_value_with_another_digit_is_refused(tmp_path: Path) -> None:
    kept(tmp_path, a=1.25)
    path = tmp_path / JOURNAL_NAME
    path.write_text(path.read_text().replace("1.25", "1.26"))
    with pytest.raises(ValueError, match="jsonl:2: is damaged: it is not as it was written"):
        kept(tmp_path)


def test_a_line_that_a_killed_process_has_begun_is_removed(tmp_path: Path) -> None:
    kept(tmp_path, a=1.0)
    path = tmp_path / JOURNAL_NAME
    whole = path.read_text()
    path.write_text(whole + '["b", {"val')
    assert list(kept(tmp_path)) == ["a"]
    assert path.read_text() == whole


@pytest.mark.parametrize(
    ("text", "message"),
    {
        "earlier version": ('{"design": {}}\n', "is not a journal of this version of viscontact"),
        "no JSON": ("a,b\n", ":1: is not a line of JSON: 'a,b'; remove the file"),
        "a line without an end": ("a,b", ":1: is not a line of JSON: 'a,b'; remove the file"),
        "another study": ('{"study": "fit"}\n', "holds another design, with a different study"),
    }.values(),
)
def test_a_foreign_file_is_refused_in_one_sentence(tmp_path: Path, text: str, message: str) -> None:
    (tmp_path / JOURNAL_NAME).write_text(text)
    with pytest.raises(ValueError, match=r"\w") as refused:
        kept(tmp_path)
    assert message in str(refused.value)
    assert len(str(refused.value).splitlines()) == 1
    assert (tmp_path / JOURNAL_NAME).read_text() == text


def test_a_damaged_line_is_named_by_its_number(tmp_path: Path) -> None:
    kept(tmp_path, a=1.0)
    with (tmp_path / JOURNAL_NAME).open("ab") as file:
        file.write(with_digest(b'{"settings": {}}') + b"\n")
    with pytest.raises(ValueError, match="jsonl:3: is not a run of a study; remove the file"):
        kept(tmp_path)


def test_a_last_line_without_an_end_is_damaged_where_more_follows(tmp_path: Path) -> None:
    kept(tmp_path, a=1.0)
    path = tmp_path / JOURNAL_NAME
    with path.open("a") as file:
        file.write(" " * 10_000_000 + "1\n")
    with pytest.raises(ValueError, match="jsonl:3: is not a line of JSON"):
        kept(tmp_path)


def test_bytes_that_are_no_text_are_refused(tmp_path: Path) -> None:
    (tmp_path / JOURNAL_NAME).write_bytes(b"\xff\xfe\n")
    with pytest.raises(ValueError, match="is not UTF-8 text"):
        kept(tmp_path)


def test_a_second_study_in_the_directory_is_refused(tmp_path: Path) -> None:
    busy = pytest.raises(ValueError, match="is in use")
    with journal_of("design", ARGUMENTS, directory=tmp_path), busy:
        kept(tmp_path)
    file = tmp_path / "file"
    file.write_text("")
    with pytest.raises(ValueError, match=r"directory: .* is a file"):
        kept(file)


def test_two_journals_in_files_of_one_folder_are_independent(tmp_path: Path) -> None:
    one, other = tmp_path / "one.jsonl", tmp_path / "other.jsonl"
    with (
        journal_of("fit", ARGUMENTS, file=one) as first,
        journal_of("fit", ARGUMENTS, file=other) as second,
    ):
        assert first is not None
        assert second is not None
        first.keep("a", Entry())
        with (
            pytest.raises(ValueError, match=r"one\.jsonl is in use by another run"),
            journal_of("fit", ARGUMENTS, file=one),
        ):
            pass
    assert sorted(each.name for each in tmp_path.iterdir()) == ["one.jsonl", "other.jsonl"]
