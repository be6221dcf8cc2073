"""The contributing guide agrees with the package: its map, its paths, the names in its recipes."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import viscontact
from project.test_floors import FLOORS

ROOT = Path(__file__).parents[2]
PACKAGE = Path(viscontact.__file__).parent
PAGE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
CODE = re.compile(r"^```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
#: Written by tasks of `go`, and not part of a clone.
GENERATED = ("build/", "dist/", ".venv")
# Paths have a folder or the ending of a file; commands have blanks or begin with a dot.
PATHS = sorted(
    {
        text
        for text in re.findall(r"`([\w./*-]+)`", CODE.sub("", PAGE))
        if re.search(r"^[\w.*-]+/|\.(?:py|pyi|js|md|rst|toml|lock)$", text)
        and not text.startswith(("./", *GENERATED))
    }
)
# "`Name` (`file.py`)", "`NAME` of `file.py`", "`name` in `file.py`".
NAMES = sorted(set(re.findall(r"`(\w+)`\s+(?:\(|of\s|in\s)`([\w./]+\.py)`", PAGE)))


def found(path: str) -> list[Path]:
    """Files and folders of a path, from the root of the repository or in the package."""
    folders = (ROOT, PACKAGE, PACKAGE / "web" / "static")
    return [each for folder in folders for each in folder.glob(path.rstrip("/"))]


def test_map_names_the_rooms_of_each_floor_and_folders_within_them() -> None:
    floors: list[list[str]] = []
    drawn = next(block for block in CODE.findall(PAGE) if "units" in block)
    for line in drawn.splitlines():
        number, indent, names = re.fullmatch(
            r"(?: ?(\d+)|  )(  |    )(\w+(?:, \w+)*)(?:  +\S.*)?", line
        ).groups()  # type: ignore[union-attr]
        if number:
            assert int(number) == len(floors)
            floors.append([])
        if indent == "    ":
            assert all((PACKAGE / floors[-1][-1] / each).is_dir() for each in names.split(", "))
        else:
            floors[-1] += names.split(", ")
    assert [sorted(floor) for floor in floors] == [sorted(floor) for floor in FLOORS]


def test_map_shows_every_folder_of_code() -> None:
    inner = {path.parent.name for path in PACKAGE.glob("*/*/__init__.py")}
    assert [name for name in inner if not re.search(rf"^ .*\b{name}\b", PAGE, re.MULTILINE)] == []


@pytest.mark.parametrize("path", PATHS)
def test_path_exists(path: str) -> None:
    assert found(path), path


@pytest.mark.parametrize(("name", "path"), NAMES)
def test_name_is_in_its_file(name: str, path: str) -> None:
    [file] = found(path)
    assert re.search(rf"\b{name}\b", file.read_text(encoding="utf-8"))


def test_paths_and_names_are_read_from_the_page() -> None:
    assert len(PATHS) > 50
    assert len(NAMES) > 15
    assert ("solve_contact", "mechanics/contact/equilibrium.py") in NAMES
