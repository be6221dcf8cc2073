"""Command lines that are read without Typer give the arguments that Typer gives."""

from __future__ import annotations

import inspect
import random
from typing import Any

import pytest
import typer

from viscontact.cli import commands, plain_words
from viscontact.cli.declared import Declared, declared
from viscontact.cli.plain_words import plain_arguments
from viscontact.cli.shell import _COMMANDS, application, command_for

#: Values that are given, right for some options and wrong for others.
VALUES = (
    *("case.yaml", "runs", "load.force=5kN", "x=y=z", "1", "0", "12", "-3", "2.5", "-0.25", "1e3"),
    *("sobol", "latin-hypercube", "SOBOL", "yes", "", " ", "ü", "--", "-", "-x", "a b", "nan"),
    *("0x10", "1_000", "+4", "999999999999", " 7", "True"),
)


def words_of(name: str, chance: random.Random) -> list[str]:
    """Words of a command: its arguments and some options with values, mostly right ones."""
    words, parameters = [], declared(getattr(commands, name))
    for parameter, kind, how in parameters.values():
        right = [text for text in VALUES if _is_right(kind, text, how)] or list(VALUES)
        value = chance.choice(right if chance.random() < 0.8 else VALUES)
        is_needed = parameter.default is parameter.empty
        if how.names is None:
            words += [[value]] * chance.choice((0, 1, 1, 1, 2))
        elif chance.random() < (0.9 if is_needed else 3 / len(parameters)):
            option = chance.choice(how.names or ("--threads",))
            forms = ([option, value], [f"{option}={value}"], [option])
            usual = 2 if "bool" in str(kind) else chance.randrange(2)
            words.append(forms[usual if chance.random() < 0.9 else chance.randrange(3)])
    chance.shuffle(words)
    if chance.random() < 0.05:
        words.append([chance.choice(("--help", "--unknown", "-vv", "-", "--"))])
    return [word for each in words for word in each]


def _is_right(kind: Any, text: str, how: Declared) -> bool:
    try:
        plain_words.value_of(plain_words.single(kind), text, how)
    except plain_words.UnusualError:
        return False
    return text.strip("-") == text


def by_typer(name: str, words: list[str], monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Arguments with which Typer calls the function of a command."""
    found: list[dict[str, Any]] = []

    def called(**given: Any) -> None:
        found.append(given)

    function = getattr(commands, name)
    called.__name__ = name
    called.__signature__ = inspect.signature(function, eval_str=True)  # type: ignore[attr-defined]
    with monkeypatch.context() as patch:
        patch.setattr(commands, name, called)
        run = typer.main.get_command(application([name]))
        run([name, *words], standalone_mode=False)
    return found[0]


def differing(name: str, words: list[str], monkeypatch: pytest.MonkeyPatch) -> bool | None:
    """True if Typer gives other arguments; None if the words are left to it."""
    plain = plain_arguments(getattr(commands, name), words)
    return None if plain is None else plain != by_typer(name, words, monkeypatch)


@pytest.mark.parametrize("name", _COMMANDS)
def test_arguments_of_random_words_are_those_of_typer(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    chance = random.Random(3)
    lines = [words_of(name, chance) for _ in range(200)]
    read = [words for words in lines if plain_arguments(getattr(commands, name), words) is not None]
    assert read
    assert [words for words in read[:40] if differing(name, words, monkeypatch)] == []


@pytest.mark.parametrize(
    "line",
    [
        "check my.yaml",
        "check my.yaml --set load.force=20kN --set=time.steps=4 --plot fig.png --width double",
        "run my.yaml -o out --overwrite --quiet",
        "run a.yaml b.yaml --vary load.force=5kN,10kN -j 2 --method sobol --seed 0",
        "show out --all --errors",
        "plot out history -o history.png --time 1s --time 2s",
        "fit record.csv --indenter cone --poisson-ratio 0.5",
        "report out",
        "demo",
    ],
)
def test_usual_command_lines_are_read_without_typer(
    line: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    name, *words = line.split()
    assert differing(name, words, monkeypatch) is False


@pytest.mark.parametrize(
    "line",
    [
        *("run", "run --help", "run my.yaml -h", "run my.yaml --thread 2", "run my.yaml --threads"),
        *("run my.yaml --threads 0", "run my.yaml --threads two", "run my.yaml -vv", "run -- a"),
        *("show out more", "run my.yaml --method other", "show out --all=1", "run my.yaml -oout"),
        *("run my.yaml -o a -o b", "run my.yaml -o --quiet", "run my.yaml --set="),
    ],
)
def test_what_is_unusual_or_wrong_is_left_to_typer(line: str) -> None:
    name, *words = line.split()
    assert plain_arguments(getattr(commands, name), words) is None


def test_every_command_line_can_still_be_given_to_typer() -> None:
    assert list(command_for(["show", "out"]).commands) == ["show"]
