"""Reports without Rich have the text that Rich prints."""

from __future__ import annotations

import random

import pytest

from returned import some
from viscontact.cli.entry import main
from viscontact.cli.terminal.console import TextConsole
from viscontact.cli.terminal.plain_report import PlainReport, _table

WORDS = (
    *("grid", "160 x 160 cells", "µm", "2.28 mm ± 3 %", "", "a[bold]b", "\x1b[31m", "裁", "é"),
    "x" * 60,
)


@pytest.fixture(autouse=True)
def plain(monkeypatch: pytest.MonkeyPatch) -> None:
    """Print to a file of the usual width."""
    for name in ("FORCE_COLOR", "TTY_COMPATIBLE", "TTY_INTERACTIVE", "COLUMNS"):
        monkeypatch.delenv(name, raising=False)


@pytest.mark.parametrize("columns", [None, "40", "120", "-1", "٤٠"])
def test_random_rows_and_warnings_are_printed_as_by_rich(
    columns: str | None, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    if columns is not None:
        monkeypatch.setenv("COLUMNS", columns)
    chance = random.Random(1)
    for _ in some(range(60)):
        rows = [
            (chance.choice(WORDS[:1]), " ".join(chance.choices(WORDS, k=chance.randrange(1, 4))))
            for _ in range(chance.randrange(5))
        ]
        line = rows[0][1] if rows else "no rows"
        PlainReport().rows(rows, 13)
        PlainReport().warn(line)
        PlainReport().text(line)
        found = capsys.readouterr().out
        TextConsole().print(_table(rows, 13))
        TextConsole().warn(line)
        TextConsole().print(line, soft_wrap=True)
        assert found == capsys.readouterr().out


@pytest.mark.parametrize("size", ["²", "9" * 5000])
@pytest.mark.parametrize("words", [["--help"], ["material"]])
def test_size_of_a_terminal_that_is_no_number_is_as_none(
    size: str,
    words: list[str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(words) == 0
    expected = capsys.readouterr()
    for name in ("COLUMNS", "LINES"):
        monkeypatch.setenv(name, size)
    PlainReport().rows([("grid", "160 x 160 cells")], 13)
    assert capsys.readouterr().out == "  grid           160 x 160 cells\n"
    assert main(words) == 0
    assert capsys.readouterr() == expected


def test_colours_are_left_to_rich(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    PlainReport().warn("steps are long")
    assert "\x1b[" in capsys.readouterr().out
