"""The package is a stack of floors: a room imports from lower floors only, without exceptions.

A room is a folder of the package, or a module at its root. The imports are read with `ast`,
wherever they are, those under `TYPE_CHECKING` included: to name another module's type is to know
it.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

import viscontact

PACKAGE = Path(viscontact.__file__).parent

# The floors from the ground up. Rooms on one floor do not import each other.
FLOORS = (
    ("backend", "units"),
    ("reference", "tables"),
    ("bodies",),
    ("mechanics", "identification"),
    ("results",),
    ("case", "drawing", "simulation"),
    ("report", "runs"),
    ("studies", "verify"),
    ("web",),
    ("cli",),
    ("__main__", "laws", "indenters", "loads", "surfaces", "plot", "figures", "notebook"),
)
MOST_FLOORS, MOST_ROOT_MODULES = 11, 9
# Public modules with the names of parts of a room; no other module imports them.
FACES = ("laws", "indenters", "loads", "surfaces", "plot", "figures", "notebook")
# The front door loads names of all floors when they are first used. The displays of objects in
# notebooks are drawn on a high floor, so the mixin that objects derive from asks there for them.
AT_THE_FRONT_DOOR = {"units/display.py", "web", "cli"}
# Files that import from a room inside a function, because few runs need it and it takes long.
DEFERRED = {
    "runs/directory/recorder.py": "results",  # xarray and pandas: a third of a run's start
    "runs/over_time.py": "runs",  # forecasts: a tenth of the start of `simulate`
}
# Exact solutions: what computes a result must not reach them, by however many imports.
COMPUTES = ("simulation", "accuracy", "steady_motion", "runs")
# Other packages, and the rooms, or parts of one, from which on they may be imported.
OTHERS = {
    "numpy": "backend", "scipy": "backend", "lazy_loader": "backend", "ducc0": "backend",
    "xarray": "results", "netCDF4": "results", "filelock": "results",
    "python_calamine": "tables", "pyevtk": "results",
    "psutil": "backend", "threadpoolctl": "backend",
    "pydantic": "case", "pydantic_core": "case", "ruamel": "bodies",
    "SurfaceTopography": "bodies", "afmformats": "identification",
    "matplotlib": "drawing/matplotlib", "mpl_toolkits": "drawing/matplotlib",
    "PIL": "drawing/matplotlib", "imageio_ffmpeg": "drawing/matplotlib",
    "plotly": "drawing/plotly", "typst": "report",
    "typer": "cli", "click": "cli", "rich": "cli",
    "distributed": "cli", "ezdxf": "studies",
    "fastapi": "web", "starlette": "web", "uvicorn": "web", "h11": "web",
}  # fmt: skip
# The only file that may import it.
ONLY_IN = {"pint": "units/parsing.py"}


@dataclass(frozen=True)
class Import:
    """One import: where it stands, what it asks for, and whether it hides in a function."""

    where: str
    target: str
    hidden: bool


def part_of(name: str) -> str:
    """Return the part of the package (module or subpackage) that a dotted name lies in."""
    return name.split(".")[1] if "." in name else ""


def floor_of(part: str) -> int | None:
    """Return the floor a part of the package stands on; None if it has no place."""
    return next((n for n, parts in enumerate(FLOORS) if part in parts), None)


def modules(package: Path) -> dict[str, Path]:
    """Return the files of a package by dotted name; its lazy `__init__` is not a floor's."""
    found = {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package.parent).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    del found[package.name]
    return found


def targets(node: ast.AST, module: str, is_package: bool) -> list[str]:
    """Return the dotted names a statement imports; `*.` marks one made up at run time."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom):
        above = module.split(".") if is_package else module.split(".")[:-1]
        stem = ".".join(above[: len(above) + 1 - node.level]) if node.level else ""
        source = ".".join(filter(None, (stem, node.module)))
        return [f"{source}.{a.name}" for a in node.names]
    if isinstance(node, ast.Call) and node.args:
        called = getattr(node.func, "attr", getattr(node.func, "id", ""))
        if called in ("import_module", "__import__"):
            name = node.args[0]
            return [str(name.value) if isinstance(name, ast.Constant) else "*.unknown"]
    return []


@cache
def imports(name: str, path: Path) -> tuple[Import, ...]:
    """Return every import of a file, which is read once, and those that its stub puts off."""
    source = path.read_text(encoding="utf-8")
    stub = path.with_suffix(".pyi")  # of a package whose names are loaded at their first use
    source += stub.read_text(encoding="utf-8") if stub.exists() else ""
    # Most nodes are expressions, which import by a call only.
    calls = "import_module" in source or "__import__" in source

    def walk(node: ast.AST, hidden: bool) -> Iterator[Import]:
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.expr) and not calls:
                continue
            where = f"{path.parent.name}/{path.name}:{getattr(child, 'lineno', 0)}"
            for target in targets(child, name, path.name == "__init__.py"):
                yield Import(where, target, hidden or isinstance(child, ast.Call))
            function = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
            yield from walk(child, hidden or function)

    return tuple(walk(ast.parse(source), hidden=False))


def fault_of_other(place: str, floor: int, target: str) -> str | None:
    """Return what is wrong with an import of another package, if anything."""
    other = target.split(".")[0]
    if other in sys.stdlib_module_names:
        return None
    if other in ONLY_IN and not place.startswith(ONLY_IN[other]):
        return f"imports {other}: only {ONLY_IN[other]} may"
    if other in ONLY_IN:
        return None
    if other not in OTHERS:
        return f"imports {other}: give it a reason in pyproject.toml and a floor in OTHERS"
    room, _, part = OTHERS[other].partition("/")
    lowest = floor_of(room) or 0
    # A part of a room: other parts of it, and rooms beside it, do without.
    if floor < lowest or (part and floor == lowest and not place.startswith(OTHERS[other])):
        return f"imports {other} on floor {floor}: it begins in {OTHERS[other]}"
    return None


def fault_of_own(place: str, floor: int, found: Import, root: str) -> str | None:
    """Return what is wrong with an import of our own package, if anything."""
    wanted, part = part_of(found.target), Path(place).parts[0].removesuffix(".py")
    if found.hidden and part != "cli" and DEFERRED.get(place) != wanted:
        return f"imports {found.target} inside a function: move it to the top of the file"
    if wanted in (part, "__version__"):
        return None
    below = floor_of(wanted)
    # A name without a floor is one of the package's front door.
    at_the_door = part in AT_THE_FRONT_DOOR or place in AT_THE_FRONT_DOOR
    if at_the_door if below is None else below < floor and wanted not in FACES:
        return None
    return f"imports {found.target}: {root}.{part} (floor {floor}) may import lower floors only"


def faults(package: Path) -> list[str]:
    """Return every breach of the floors in a package, one line each."""
    lines = []
    for name, path in modules(package).items():
        part, place = part_of(name), path.relative_to(package).as_posix()
        floor = floor_of(part)
        if floor is None:
            lines.append(
                f"{name} has no floor: give it one in FLOORS of tests/project/test_floors.py"
            )
            continue
        for found in imports(name, path):
            own = found.target.split(".")[0] in (package.name, "*")
            fault = (
                fault_of_own(place, floor, found, package.name)
                if own
                else fault_of_other(place, floor, found.target)
            )
            if fault:
                lines.append(f"{found.where}: {fault}")
    return lines


def circles(package: Path) -> list[str]:
    """Return the parts of rooms that import each other, directly or through others."""
    files, uses = modules(package), dict[str, set[str]]()
    for name, path in files.items():
        part = ".".join(name.split(".")[1:3])
        for found in imports(name, path):
            other = ".".join(found.target.split(".")[1:3])
            within = other.partition(".")[0] == part.partition(".")[0] != other
            if within and other != part and f"{package.name}.{other}" in files:
                uses.setdefault(part, set()).add(other)

    return [part for part in uses if part in reached(part, uses)]


def reached(part: str, uses: dict[str, set[str]]) -> set[str]:
    """Return the parts that a part uses, directly or through others."""
    seen: set[str] = set()
    ahead = [*uses.get(part, ())]
    while ahead:
        each = ahead.pop()
        if each not in seen:
            seen.add(each)
            ahead += uses.get(each, ())
    return seen


def reached_from(rooms: tuple[str, ...]) -> set[str]:
    """Return the modules that rooms import, directly or through others."""
    files = modules(PACKAGE)
    reached: set[str] = set()
    ahead = [name for name in files if part_of(name) in rooms]
    while ahead:
        name = ahead.pop()
        if name in reached:
            continue
        reached.add(name)
        for found in imports(name, files[name]):
            ahead += [
                each for each in (found.target, found.target.rpartition(".")[0]) if each in files
            ]
    return reached


def test_imports_point_down() -> None:
    assert "\n".join(faults(PACKAGE)) == ""


def test_parts_of_a_room_do_not_import_each_other_in_a_circle() -> None:
    assert circles(PACKAGE) == []


def test_a_circle_within_a_room_is_found(tmp_path: Path) -> None:
    package = forge(tmp_path, "bodies/laws", "from viscontact.bodies.loads import step")
    (package / "bodies" / "loads.py").write_text("from viscontact.bodies import laws")
    assert circles(package) == ["bodies.laws", "bodies.loads"]


def test_what_computes_results_does_not_reach_the_exact_solutions() -> None:
    assert [name for name in reached_from(COMPUTES) if part_of(name) == "reference"] == []
    assert "reference" in {part_of(name) for name in reached_from(("verify",))}


def test_there_are_few_floors_and_few_modules_at_the_root() -> None:
    assert len(FLOORS) <= MOST_FLOORS
    assert len(list(PACKAGE.glob("*.py"))) <= MOST_ROOT_MODULES


def test_every_room_with_a_floor_is_there() -> None:
    assert {part_of(name) for name in modules(PACKAGE)} == {
        part for floor in FLOORS for part in floor
    }


@pytest.mark.parametrize("name", viscontact.__all__)
def test_every_exported_name_is_where_the_front_door_says(name: str) -> None:
    assert getattr(viscontact, name) is not None


# The rules are tested on forged packages of one module; a fault must be found, and named.
FORGED = {
    "upward": (
        "bodies/grid",
        "from viscontact.simulation.transient.march import March",
        "lower floors only",
    ),
    "upward, relative": (
        "bodies/grid",
        "from .. import mechanics",
        "may import lower floors only",
    ),
    "upward, as a type": (
        "bodies/grid",
        "if TYPE_CHECKING:\n    from ..simulation import checks",
        "may import lower floors only",
    ),
    "same floor": ("tables", "import viscontact.reference", "may import lower floors only"),
    "face": ("cli", "from viscontact.plot import history", "may import lower floors only"),
    "hidden": (
        "simulation",
        "def f():\n    from viscontact.bodies.grid import Grid",
        "inside a function",
    ),
    "made up at run time": ("results", "import_module(name)", "inside a function"),
    "front door": ("case", "from viscontact import Sphere", "may import lower floors only"),
    "reference on the product": (
        "reference",
        "import viscontact.mechanics.contact",
        "lower floors only",
    ),
    "heavy and low": (
        "mechanics/contact",
        "def f():\n    import xarray as xr",
        "begins in results",
    ),
    "heavy in another part": (
        "drawing/content",
        "import matplotlib",
        "begins in drawing/matplotlib",
    ),
    "command line below": ("case", "import typer", "begins in cli"),
    "pint elsewhere": ("case", "import pint", "only units/parsing.py may"),
    "unknown package": ("tables", "import pandas", "a reason in pyproject.toml"),
    "without a floor": ("utils", "", "has no floor"),
}
SOUND = {
    "downward": (
        "simulation",
        "from viscontact.mechanics.contact.equilibrium import solve_contact",
    ),
    "own room": ("bodies/laws", "from viscontact.bodies.laws.series import CreepSeries"),
    "late in the command line": ("cli", "def f():\n    import viscontact\n    import rich"),
    "version": ("results", "from viscontact import __version__"),
    "reference shown": ("drawing", "from viscontact import reference"),
    "its own part": ("drawing/plotly", "import plotly"),
    "standard library": ("tables", "import math"),
}


def forge(folder: Path, module: str, source: str) -> Path:
    package = folder / "viscontact"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / f"{module}.py").parent.mkdir(exist_ok=True)
    (package / f"{module}.py").write_text(source)
    return package


@pytest.mark.parametrize(("module", "source", "message"), FORGED.values(), ids=FORGED.keys())
def test_a_breach_is_found(tmp_path: Path, module: str, source: str, message: str) -> None:
    [fault] = faults(forge(tmp_path, module, source))
    assert message in fault


@pytest.mark.parametrize(("module", "source"), SOUND.values(), ids=SOUND.keys())
def test_what_is_allowed_passes(tmp_path: Path, module: str, source: str) -> None:
    assert faults(forge(tmp_path, module, source)) == []
