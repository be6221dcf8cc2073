"""What the documentation tells its readers to do: its pages in blocks, and the blocks in action.

`python tests/project/documented.py docs/howto/afm.md` plays a page in an empty directory and puts
the pictures that it makes into the manual, under the names that the page shows them by.
"""

from __future__ import annotations

import contextlib
import io
import itertools
import os
import re
import runpy
import shlex
import shutil
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from PIL import Image

from viscontact.cli import main

ROOT = Path(__file__).parents[2]
#: The pages of the manual, and the README; the gallery's are scripts, with a test of their own.
PAGES = sorted(
    path
    for path in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
    if not {"generated", "examples"} & set(path.relative_to(ROOT).parts)
)

#: Commands that are not run, and why.
NOT_RUN = {
    "git clone": "needs the network",
    "pip install": "needs the network",
    "python3.11 -m venv": "goes with pip install",
    "mkdir": "the page is played in a directory of its own",
    "cd": "the page is played in a directory of its own",
    "source": "the tests have an environment already",
    ".venv\\Scripts\\activate": "Windows",
    "py go": "Windows",
    "./go test": "what runs this very test; tests/project/test_go.py",
    "./go lint": "a task of the project, done by .ci/run",
    "./go docs": "a task of the project, done by .ci/run",
    "./go bench": "minutes, and wants a quiet machine",
    "./go build": "a task of the project; tests/project/test_go.py",
    "./go lock": "needs the network; tests/project/test_go.py",
    "viscontact serve": "goes on until it is stopped; it has tests of its own",
    "curl": "needs a server; tests/web/test_web_access.py",
    "viscontact verify": "takes a minute; tests/verify/test_verify.py and tests/verification",
    "dask scheduler": "goes on until it is stopped; tests/studies/executors/test_cluster.py",
    "dask worker": "goes on until it is stopped; tests/studies/executors/test_cluster.py",
    "matlab": "another program",
    "paraview": "another program",
}

_FENCE = re.compile(
    r"^(?P<tick>`{3,})(?:\{code-block\}[ ]*)?(?P<language>[\w{}-]*)[^\n]*\n"
    r"(?P<text>.*?)^(?P=tick)[ ]*$",
    re.MULTILINE | re.DOTALL,
)
_OPTION = re.compile(r"\A:(\w+):[ ]*(.*)\n")
_SHELLS = ("sh", "bash", "shell", "console")
_COMMAND = re.compile(r"^(\$ )?(viscontact|\./go|\.venv/bin/viscontact)( |$)", re.MULTILINE)
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


@dataclass(frozen=True)
class Block:
    """A fenced block of a page.

    Attributes
    ----------
    kind : str
        ``commands``, ``python``, ``file`` (to be saved under `name`), ``output`` (what the block
        above it prints) or ``other``.
    text : str
        What it holds.
    line : int
        Where it begins.
    name : str
        Of a file.
    """

    kind: str
    text: str
    line: int
    name: str = ""


def blocks(markdown: str) -> list[Block]:
    """The fenced blocks of a page, in order."""
    found: list[Block] = []
    above = 0
    for match in _FENCE.finditer(markdown):
        options, text = _options(match["text"])
        line = markdown.count("\n", 0, match.start()) + 1
        follows = bool(found) and not markdown[above : match.start()].strip()
        found.append(Block(*_kind(match["language"], text, options, follows), line, **options))
        above = match.end()
    return found


def _options(text: str) -> tuple[dict[str, str], str]:
    """The name in a code-block's caption, and the text without its options."""
    options = {}
    while found := _OPTION.match(text):
        if found[1] == "caption":
            options["name"] = found[2].strip("` ")
        text = text[found.end() :]
    return options, text.removeprefix("\n") if options else text


def _kind(language: str, text: str, options: dict[str, str], follows: bool) -> tuple[str, str]:
    if "name" in options:
        return "file", text
    if language == "text" and follows:
        return "output", text
    if language in _SHELLS or (not language and _COMMAND.search(text)):
        return "commands", text
    return ("python" if language == "python" else "other"), text


def commands(text: str) -> Iterator[str]:
    """The commands of a block, a line that ends in a backslash joined to the next."""
    for line in text.replace("\\\n", " ").splitlines():
        bare = line.strip().removeprefix("$ ").removeprefix(".venv/bin/")
        if bare and not bare.startswith("#"):
            yield bare


def why_not_run(command: str) -> str | None:
    """Why a command is not run here, or None if it is."""
    for beginning, reason in NOT_RUN.items():
        if command == beginning or command.startswith(beginning + " "):
            return reason
    return None


def words(command: str) -> list[str]:
    """The words of a command, with names of files in the place of patterns."""
    here = Path()
    found = []
    for word in shlex.split(command, comments=True):
        matches = sorted(str(path) for path in here.glob(word)) if "*" in word else []
        found += matches or [word]
    return found


class Reader:
    """A reader who follows a page in the current directory, from top to bottom."""

    def __init__(self) -> None:
        self._names: dict[str, Any] = {}
        self._said = ""

    def follow(self, markdown: str) -> None:
        """Do all that a page says; raise AssertionError where it does not come true."""
        for block in blocks(markdown):
            try:
                self._do(block)
            except (Exception, SystemExit) as error:
                error.add_note(f"in the block at line {block.line}:\n{block.text}")
                raise

    def _do(self, block: Block) -> None:
        if block.kind == "file":
            Path(block.name).write_text(block.text, encoding="utf-8")
        elif block.kind == "commands":
            with _listening() as said:
                for command in commands(block.text):
                    self._type(command)
            self._said = said.getvalue()
        elif block.kind == "python":
            self._compute(block.text)
        elif block.kind == "output":
            require_lines(block.text, self._said)

    def _type(self, command: str) -> None:
        if why_not_run(command):
            return
        program, *arguments = words(command)
        refused = "# refused" in command
        if program == "python":
            self._names |= runpy.run_path(str(Path(arguments[0]).absolute()), run_name="__main__")
            return
        assert program in ("viscontact", "./go"), f"no command of ours: {command}"
        if ">" in arguments:
            *arguments, _, target = arguments
            with Path(target).open("w", encoding="utf-8") as file, contextlib.redirect_stdout(file):
                code = main(arguments)
        else:
            code = main(arguments)
        assert code == (2 if refused else 0), f"exit code {code} of: {command}"

    def _compute(self, source: str) -> None:
        # From a file, as a reader would: processes that are started read it again.
        script = Path("script.py").absolute()
        script.write_text(source, encoding="utf-8")
        with _listening() as said:
            self._names |= runpy.run_path(str(script), self._names, run_name="__main__")
        script.unlink()
        self._said = said.getvalue()
        require_comments(source, self._said)


@contextlib.contextmanager
def _listening() -> Iterator[io.StringIO]:
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        yield said


def require_lines(expected: str, said: str) -> None:
    """Raise if a line of what a page shows was not printed; numbers may differ by 2 %.

    Errors, behind ± or as "0.03 % at" an instant, may differ by a tenth: they are differences of
    solutions, printed to two digits, and rounded as machines and inner loops are.
    """
    printed = [_pieces(line) for line in said.splitlines()]
    for line in expected.splitlines():
        if line.strip() in ("", "...", "…"):
            continue
        assert any(_alike(_pieces(line), other) for other in printed), (
            f"the page shows, and nothing printed: {line}\n--- printed:\n{said}"
        )


def require_comments(source: str, said: str) -> None:
    """Raise if a line that is printed is not the comment behind its ``print``."""
    shown = re.findall(r"^ *print\(.*\)  # (.*)$", source, re.MULTILINE)
    if len(shown) == len(re.findall(r"^ *print\(", source, re.MULTILINE)):
        printed = [_numbers(line) for line in said.splitlines() if line.strip()]
        for comment, values in zip(shown, printed, strict=True):
            wanted = _numbers(comment.rsplit("=")[-1])[: len(values)]
            assert wanted, f"no number in: {comment}"
            assert _close(wanted, values[: len(wanted)]), f"{comment}: printed {values}"


def _pieces(line: str) -> tuple[str, list[float]]:
    """A line without its numbers, blanks and rules, and the numbers."""
    bare = re.sub(r"[\s│┃─━]+", "", line)
    return _NUMBER.sub("\0", bare), _numbers(bare)


def _tolerances(shape: str) -> list[float]:
    """Relative tolerances of the numbers of a line without them."""
    around = itertools.pairwise(shape.split("\0"))
    errors = [before.endswith("±") or after.startswith("%at") for before, after in around]
    return [0.1 if is_error else 0.02 for is_error in errors]


def _numbers(text: str) -> list[float]:
    return [float(number) for number in _NUMBER.findall(text)]


def _alike(one: tuple[str, list[float]], other: tuple[str, list[float]]) -> bool:
    return one[0] == other[0] and _close(one[1], other[1], _tolerances(one[0]))


def _close(wanted: list[float], got: list[float], within: Sequence[float] = ()) -> bool:
    within = within or [0.02] * len(wanted)
    return len(wanted) == len(got) and all(
        abs(a - b) <= part * abs(a) for a, b, part in zip(wanted, got, within, strict=True)
    )


def pictures(markdown: str, page: Path) -> list[Path]:
    """The pictures that a page shows."""
    return [
        (page.parent / name).resolve()
        for name in re.findall(r"!\[[^\]]*\]\(([^)]+\.(?:png|gif))\)", markdown)
    ]


def refresh(page: Path, given: str = "") -> None:
    """Play a page in an empty directory, and take its pictures into the manual."""
    markdown = page.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        reader = Reader()
        reader.follow(given)
        reader.follow(markdown)
        for picture in pictures(markdown, page):
            if Path(picture.name).exists():
                _take(Path(picture.name), picture)
                print(f"{picture.relative_to(ROOT)}: {picture.stat().st_size / 1e3:.0f} kB")


def _take(picture: Path, into: Path) -> None:
    if picture.suffix == ".gif":  # a film
        shutil.copy(picture, into)
    else:
        _as_shown(picture).save(into, optimize=True)


def _as_shown(picture: Path) -> Image.Image:
    """A picture as pages show it: of one column narrower, in 128 colours, which do for a figure."""
    image = Image.open(picture).convert("RGB")
    if image.width < 1000:
        image = image.resize(
            (2 * image.width // 3, 2 * image.height // 3), Image.Resampling.LANCZOS
        )
    return image.quantize(128)


if __name__ == "__main__":
    os.environ["COLUMNS"] = "80"
    for name in sys.argv[1:]:
        refresh(Path(name).resolve())
