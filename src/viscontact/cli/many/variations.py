"""Combinations of varied values: `--vary KEY=VALUE,VALUE,...`."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

from viscontact.cli.terminal.messages import refuse

_OPENING, _CLOSING, _QUOTES = "[{", "]}", "\"'"


@dataclass(frozen=True)
class Variation:
    """One combination of varied values, as `--set` takes them, and a name for its directory."""

    settings: tuple[str, ...] = ()
    name: str = ""


def variations(varied: Sequence[str], settings: Sequence[str] = ()) -> list[Variation]:
    """Return all combinations of the values of `--vary`; those of the last key change fastest.

    Examples
    --------
    >>> found = variations(["load.force=5 kN,10 kN", "grid.shape=[32, 32],[64, 64]"])
    >>> found[2].settings
    ('load.force=10 kN', 'grid.shape=[32, 32]')
    >>> found[2].name, variations(["grid.tolerance=5%"])[0].name
    ('force=10kN_shape=32-32', 'tolerance=5%')
    """
    axes = dict(_axis(text) for text in varied)
    _refuse_keys_given_twice([key_of(text) for text in (*varied, *settings)], set(axes))
    short = _short_names(list(axes))
    found = []
    for values in product(*axes.values()):
        chosen = dict(zip(axes, values, strict=True))
        name = "_".join(f"{_safe(short[key])}={_safe(value)}" for key, value in chosen.items())
        found.append(Variation(tuple(f"{key}={value}" for key, value in chosen.items()), name))
    return found


def as_typed(line: str, varied: Sequence[str]) -> str:
    """Name the option `--vary` in a message about a varied value.

    Examples
    --------
    >>> as_typed("--set load.force: cannot read '2'", ["load.force=2,3"])
    "--vary load.force: cannot read '2'"
    """
    option, blank, rest = line.partition(" ")
    key = re.split(r"[:=\s]", rest, maxsplit=1)[0]
    is_varied = option == "--set" and any(_share_a_branch(key, key_of(text)) for text in varied)
    return f"--vary{blank}{rest}" if is_varied else line


def _share_a_branch(one: str, other: str) -> bool:
    steps = zip(re.split(r"[.\[]", one), re.split(r"[.\[]", other), strict=False)
    return all(a == b for a, b in steps)


def _axis(text: str) -> tuple[str, list[str]]:
    _, equals, given = text.partition("=")
    values = _split(given)
    if not (key_of(text) and equals and values and all(values)):
        refuse(f"--vary {text}: write KEY=VALUE,VALUE,..., e.g. --vary load.force=5kN,10kN")
    return key_of(text), values


def key_of(text: str) -> str:
    """Key of a `--set` or `--vary`, as KEY=VALUE."""
    return text.partition("=")[0].strip()


def _split(text: str) -> list[str]:
    """Split at commas outside brackets and quotes."""
    pieces, depth, quote = [""], 0, ""
    for letter in text:
        if quote:
            quote = "" if letter == quote else quote
        elif letter in _QUOTES and not pieces[-1].strip():
            quote = letter
        else:
            depth += (letter in _OPENING) - (letter in _CLOSING)
            if letter == "," and depth == 0:
                pieces.append("")
                continue
        pieces[-1] += letter
    return [piece.strip() for piece in pieces]


def _refuse_keys_given_twice(keys: list[str], varied: set[str]) -> None:
    twice = [key for key, count in Counter(keys).items() if count > 1 and key in varied]
    if twice:
        refuse(f"--vary {twice[0]}: is given twice; name all its values behind one --vary")


def _short_names(keys: list[str]) -> dict[str, str]:
    """Last part of each key, or the whole key where that is ambiguous."""
    last = {key: key.rpartition(".")[2] for key in keys}
    count = Counter(last.values())
    return {key: name if count[name] == 1 else key for key, name in last.items()}


def _safe(text: str) -> str:
    """Text with only those characters that directory names may have on any system."""
    words = re.sub(r"[^\w.+%-]+", "-", re.sub(r"\s+", "", text))
    return words.strip("-.") if text.strip()[:1] != "-" else "-" + words.strip("-.")
