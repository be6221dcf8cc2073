"""Reference of the commands, generated from the commands."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import typer

from viscontact.cli.shell import application

#: Input to type within a help text: an option, or text in quotation marks.
_TYPED = re.compile(r"(?<!\S)(--[a-z][\w-]*)|(?<!\w)'([^']+)'(?!\w)")


def command_line_reference() -> str:
    """Return a section for each command: description, arguments and options, example.

    Returns
    -------
    str
        Markdown.

    Examples
    --------
    >>> "viscontact check [OPTIONS] CASE.yaml" in command_line_reference()
    True
    """
    commands = typer.main.get_command(application()).commands
    return "\n\n".join("\n".join(_section(name, command)) for name, command in commands.items())


def _section(name: str, command: Any) -> Iterator[str]:
    arguments = [each for each in command.params if each.param_type_name == "argument"]
    options = [each for each in command.params if each.param_type_name == "option"]
    usage = " ".join(
        [f"viscontact {name}", *(["[OPTIONS]"] if options else []), *map(_usage, arguments)]
    )
    yield from (f"(viscontact-{name})=", f"## viscontact {name}", "", "```text", usage, "```", "")
    yield _prose(command.help)
    if arguments or options:
        yield from ("", "| | |", "|---|---|")
    for each in arguments:
        yield f"| `{_cell(_name(each))}` | {_description(each)} |"
    for each in options:
        yield f"| {_spelt(each)} | {_description(each)} |"
    example = (command.epilog or "").removeprefix("Example:").strip()
    if example:
        yield from ("", "For example:", "", "```text", example, "```")


def _prose(text: str) -> str:
    """Help text with its indented examples as code blocks."""
    paragraphs = []
    for paragraph in text.split("\n\n"):
        lead, separator, line = paragraph.partition(":  viscontact ")
        if separator:
            paragraph = f"{lead}:\n\n```text\nviscontact {line}\n```"
        paragraphs.append(paragraph)
    return "\n\n".join(paragraphs)


def _usage(argument: Any) -> str:
    name = _name(argument)
    return name if argument.required else f"[{name}]"


def _name(parameter: Any) -> str:
    return (parameter.metavar or parameter.name.upper()).strip("[]")


def _spelt(option: Any) -> str:
    names = sorted([*option.opts, *option.secondary_opts], key=len)
    value = "" if option.is_flag else f" {_cell(_name(option))}"
    spelt = ", ".join(f"`{name}`" for name in names[:-1])
    last = f"`{names[-1]}{value}`"
    return f"{spelt}, {last}" if spelt else last


def _description(parameter: Any) -> str:
    said = _TYPED.sub(r"`\1\2`", _cell(parameter.help or ""))
    notes = []
    if getattr(parameter, "multiple", False) and "repeated" not in said:
        notes.append("May be given several times.")
    default = parameter.default
    has_default = not (default is None or default is False or callable(default) or default == [])
    if has_default and not getattr(parameter, "is_flag", False):
        notes.append(f"Default: `{default}`.")
    return " ".join([said, *notes])


def _cell(text: str) -> str:
    return text.replace("|", r"\|")
