"""The package is a stack of floors: what is imported lies below.

The imports are read with `ast`, wherever they stand, those under `TYPE_CHECKING` included: to
name another module's type is to know it.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

import viscontact

PACKAGE = Path(viscontact.__file__).parent

# The floors from the ground up. A new module gets its place here; think twice before it is high.
FLOORS = (
    (
        "errors",
        "shown",
        "real",
        "readable",
        "carried",
        "free_memory",
        "grid",
        "load",
        "indenters",
        "laws",
    ),  # 0 words: they do not know each other
    (
        "compliance",
        "material",
        "influence",
        "stress_influence",
        "memory",
        "state",
        "step_solution",
        "outline",
        "rim",
        "hull",
        "richardson",
    ),  # 1 single ideas
    (
        "transforms",
        "convolution",
        "waves",
        "preconditioner",
        "subsurface",
        "balance",
        "bedding",
        "half_space",
    ),  # 2 operators on fields
    (
        "contact_problem",
        "search",
        "contact",
    ),  # 3 equilibrium at one instant
    (
        "stepping",
        "schedule",
        "time_error",
        "adaptive",
        "prediction",
        "plausibility",
        "mesh_doubts",
        "doubts",
        "material_doubts",
        "sampling_doubts",
        "sharpness",
        "geometry_doubts",
        "estimate",
        "extent",
        "mesh_trial",
        "facets",
        "resolution",
        "instants",
        "admission",
        "mesh",
        "automatic_grid",
        "period",
        "run",
        "footprint",
        "loading_doubts",
        "growth",
        "cycles",
        "observation",
        "solved_step",
        "past",
        "step_by_step",
        "marching",
        "looser_load",
        "companions",
        "grid_levels",
        "error_bars",
    ),  # 4 time
    (
        "accessor",
        "description",
        "outgrown",
        "variables",
        "dataset",
        "run_description",
        "single",
        "many_runs",
        "results",
        "stated_errors",
        "history_csv",
        "recorded_case",
        "stresses",
        "recording",
    ),  # 5 labels and files
    (
        "examples",
        "cross_section",
        "markup",
        "units",
        "particulars",
        "told",
        "tables",
        "surfaces",
        "cards",
        "materials",
        "identification",
        "notebook",
        "foresight",
        "forecast",
        "case",
        "preparation",
        "inspection",
        "summary",
        "plot",
        "report",
        "verify",
    ),  # 6 people
    (
        "processes",
        "web",
        "cli",
        "__main__",
    ),  # 7 shell
)
# Neighbours on a floor of which the first needs the second; the second stands to the left above.
NEIGHBOURS = {
    ("load", "real"),  # what counts as a number
    ("load", "shown"),  # in a notebook, as all nouns
    ("indenters", "shown"),
    ("laws", "shown"),
    ("grid", "shown"),
    ("indenters", "real"),
    ("grid", "real"),
    ("indenters", "readable"),  # what a refusal says
    ("load", "readable"),
    ("laws", "readable"),
    ("material", "compliance"),  # what contact sees of it
    ("memory", "compliance"),  # the past is weighted by it
    ("rim", "outline"),  # where the body ends inside a cell
    ("bedding", "balance"),  # which resultants the first guess carries
    ("half_space", "balance"),  # the rigid planes and the operators over one grid
    ("half_space", "convolution"),
    ("half_space", "waves"),
    ("half_space", "transforms"),  # whoever of them is there
    ("convolution", "transforms"),
    ("waves", "transforms"),
    ("search", "contact_problem"),
    ("contact", "contact_problem"),
    ("contact", "search"),  # which finds the pressure
    ("adaptive", "stepping"),  # what is wished for
    ("adaptive", "schedule"),  # its steps are steps
    ("adaptive", "time_error"),
    ("time_error", "schedule"),
    ("instants", "stepping"),  # when none are given
    ("instants", "schedule"),  # what is meant to be a kink
    ("run", "stepping"),
    ("run", "instants"),
    ("run", "admission"),  # what is refused
    ("run", "period"),  # what is no period
    ("run", "schedule"),  # where its steps come from
    ("run", "adaptive"),
    ("run", "mesh"),  # the grid when none is given
    ("automatic_grid", "admission"),  # of nouns that are none
    ("automatic_grid", "mesh"),  # as a run has it
    ("mesh", "extent"),  # holds the contact
    ("facets", "estimate"),
    ("mesh", "facets"),
    ("resolution", "mesh_trial"),  # after trial
    ("mesh", "mesh_trial"),  # of an elastic contact
    ("mesh", "resolution"),  # and resolves it,
    ("observation", "run"),  # which instants are kept
    ("observation", "schedule"),  # the step that ended
    ("observation", "material_doubts"),
    ("observation", "geometry_doubts"),
    ("geometry_doubts", "sharpness"),  # where a body ends, and its corners
    ("observation", "sharpness"),
    ("geometry_doubts", "sampling_doubts"),  # what the grid does not see
    ("extent", "estimate"),  # of the contact that has to fit
    ("forecast", "foresight"),  # of doubts
    ("footprint", "adaptive"),  # which steps are likely
    ("footprint", "run"),
    ("footprint", "schedule"),
    ("loading_doubts", "plausibility"),  # by how much of it a step may change
    ("loading_doubts", "run"),
    ("loading_doubts", "schedule"),
    ("observation", "loading_doubts"),
    ("observation", "plausibility"),  # which warnings it deserves
    ("past", "run"),
    ("past", "schedule"),  # a step to be taken
    ("past", "prediction"),  # starts from a prediction,
    ("past", "time_error"),  # makes an error,
    ("cycles", "schedule"),
    ("observation", "cycles"),  # what they cost
    ("growth", "extent"),  # how large a grid may become
    ("past", "growth"),  # what it is on a larger grid,
    ("observation", "growth"),
    ("step_by_step", "growth"),  # which is needed when the contact outgrows its own
    ("step_by_step", "run"),
    ("step_by_step", "schedule"),  # the loop goes through the schedule's steps,
    ("step_by_step", "past"),  # takes each,
    ("step_by_step", "solved_step"),  # or takes it as it was solved before,
    ("step_by_step", "observation"),  # and observes where it ended
    ("marching", "run"),
    ("marching", "stepping"),
    ("marching", "step_by_step"),
    ("dataset", "accessor"),  # what a result offers beside its variables
    ("results", "accessor"),
    ("dataset", "outgrown"),  # fields on a grid that has been enlarged meanwhile
    ("recording", "outgrown"),
    ("companions", "looser_load"),
    ("companions", "run"),
    ("companions", "schedule"),  # coarser steps
    ("companions", "sharpness"),
    ("companions", "step_by_step"),  # are marched as any run
    ("grid_levels", "companions"),  # beside their run
    ("error_bars", "grid_levels"),
    ("error_bars", "companions"),
    ("error_bars", "run"),
    ("dataset", "variables"),
    ("history_csv", "variables"),  # which are written, and in which units
    ("stated_errors", "variables"),  # what an error is called
    ("recording", "variables"),
    ("recording", "dataset"),  # the file is laid out as the dataset is
    ("recording", "description"),  # whose a record is
    ("recording", "results"),  # what the result is called
    ("told", "units"),
    ("notebook", "units"),
    ("notebook", "particulars"),  # are its tables
    ("notebook", "told"),
    ("notebook", "markup"),
    ("notebook", "cross_section"),  # is what it draws
    ("notebook", "surfaces"),  # measured things as well
    ("notebook", "cards"),
    ("notebook", "identification"),
    ("case", "units"),
    ("case", "materials"),  # which may be given by name
    ("case", "cards"),  # materials of other programs
    ("case", "tables"),  # loads and materials may be measured ones
    ("preparation", "case"),  # makes a run of it
    ("summary", "told"),
    ("summary", "units"),
    ("inspection", "preparation"),
    ("inspection", "forecast"),  # in words
    ("surfaces", "tables"),  # maps in text files
    ("surfaces", "units"),
    ("case", "surfaces"),  # which may be pressed
    ("cards", "tables"),  # the text of a file, whatever its encoding
    ("cards", "units"),
    ("tables", "units"),
    ("materials", "units"),
    ("plot", "units"),
    ("plot", "particulars"),  # what is told beside an indenter
    ("plot", "identification"),  # data, what was fitted, and what is left
    ("plot", "cross_section"),
    ("report", "plot"),  # has drawings of it
    ("report", "markup"),
    ("report", "notebook"),  # has drawings for phones
    ("report", "particulars"),
    ("report", "summary"),  # is its table of errors
    ("report", "told"),
    ("report", "units"),
    ("plot", "materials"),  # curves are drawn over the points they rest on
    ("cli", "processes"),  # several runs
    ("web", "processes"),
    ("cli", "web"),  # the command that serves it
    ("many_runs", "single"),
    ("recording", "run_description"),
    ("run_description", "description"),
    ("single", "dataset"),
    ("single", "outgrown"),
    ("single", "run_description"),
    ("companions", "mesh_doubts"),
    ("half_space", "preconditioner"),
    ("observation", "doubts"),
    ("observation", "mesh_doubts"),
    ("preconditioner", "transforms"),
    ("preconditioner", "waves"),
    ("step_solution", "state"),
    ("stresses", "recorded_case"),
    ("recorded_case", "description"),
    ("__main__", "cli"),  # python -m viscontact
}
# Who may ask the front door, which loads names from any floor when they are used: nouns that are
# asked to show themselves, as notebooks ask the noun and not the page it is shown on.
AT_THE_FRONT_DOOR = {"shown"}
# The exact solutions stand aside: they rest on the lower floors, and the product computes nothing
# with what it is checked against, so only people's floors may show them.
REFERENCE_RESTS_ON, REFERENCE_SEEN_FROM = 1, 6
# Other people's packages, and the lowest floor that may import them.
OTHERS = {
    "numpy": 0, "scipy": 0,
    "ducc0": 2,
    "xarray": 5, "netCDF4": 5, "filelock": 5,
    "pint": 6, "pydantic": 6, "pydantic_core": 6, "ruamel": 6,
    "SurfaceTopography": 6,
    "matplotlib": 6, "mpl_toolkits": 6, "PIL": 6, "imageio_ffmpeg": 6, "contourpy": 6, "plotly": 6,
    "typer": 7, "click": 7, "rich": 7,
    "fastapi": 7, "starlette": 7, "uvicorn": 7,
}  # fmt: skip
TOP = len(FLOORS) - 1


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


def imports(name: str, path: Path) -> Iterator[Import]:
    """Yield every import of a file."""

    def walk(node: ast.AST, hidden: bool) -> Iterator[Import]:
        for child in ast.iter_child_nodes(node):
            where = f"{path.parent.name}/{path.name}:{getattr(child, 'lineno', 0)}"
            for target in targets(child, name, path.name == "__init__.py"):
                yield Import(where, target, hidden or isinstance(child, ast.Call))
            function = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
            yield from walk(child, hidden or function)

    yield from walk(ast.parse(path.read_text(encoding="utf-8")), hidden=False)


def fault_of_other(floor: int, target: str) -> str | None:
    """Return what is wrong with an import of another package, if anything."""
    other = target.split(".")[0]
    if other in sys.stdlib_module_names:
        return None
    if other not in OTHERS:
        return f"imports {other}: give it a reason in pyproject.toml and a floor in OTHERS"
    if floor < OTHERS[other]:
        return f"imports {other} on floor {floor}: it begins on floor {OTHERS[other]}"
    return None


def fault_of_own(part: str, floor: int, found: Import, root: str) -> str | None:
    """Return what is wrong with an import of our own package, if anything."""
    wanted = part_of(found.target)
    if found.hidden and part != "cli":
        return f"imports {found.target} inside a function: move it to the top of the file"
    if wanted in (part, "__version__"):
        return None
    below = floor_of(wanted)
    if wanted == "reference":
        allowed = floor >= REFERENCE_SEEN_FROM
    elif below is None:  # a name of the package's front door, which knows all floors
        allowed = floor == TOP or part in AT_THE_FRONT_DOOR
    else:
        limit = REFERENCE_RESTS_ON + 1 if part == "reference" else floor
        allowed = below < limit or (part, wanted) in NEIGHBOURS
    if allowed:
        return None
    return f"imports {found.target}: {root}.{part} (floor {floor}) may import lower floors only"


def faults(package: Path) -> list[str]:
    """Return every breach of the floors in a package, one line each."""
    lines = []
    for name, path in modules(package).items():
        part = part_of(name)
        floor = REFERENCE_RESTS_ON if part == "reference" else floor_of(part)
        if floor is None:
            lines.append(f"{name} has no floor: give it one in FLOORS of tests/test_floors.py")
            continue
        for found in imports(name, path):
            own = found.target.split(".")[0] in (package.name, "*")
            fault = (
                fault_of_own(part, floor, found, package.name)
                if own
                else fault_of_other(floor, found.target)
            )
            if fault:
                lines.append(f"{found.where}: {fault}")
    return lines


def test_imports_point_down() -> None:
    assert "\n".join(faults(PACKAGE)) == ""


def test_neighbours_need_only_those_to_their_left() -> None:
    for above, below in NEIGHBOURS:
        floor = FLOORS[floor_of(above) or 0]
        assert floor.index(below) < floor.index(above)


def test_no_neighbour_is_listed_in_vain() -> None:
    needed = {
        (part_of(name), part_of(found.target))
        for name, path in modules(PACKAGE).items()
        for found in imports(name, path)
        if found.target.startswith(f"{PACKAGE.name}.")
    }
    assert needed >= NEIGHBOURS


@pytest.mark.parametrize("name", viscontact.__all__)
def test_every_exported_name_is_where_the_front_door_says(name: str) -> None:
    assert getattr(viscontact, name) is not None


# The rules are tested on forged packages of one or two files; a fault must be found, and named.
FORGED = {
    "upward": ("grid", "from viscontact.march import march", "may import lower floors only"),
    "upward, relative": ("grid", "from . import contact", "may import lower floors only"),
    "upward, as a type": (
        "grid",
        "if TYPE_CHECKING:\n    from .march import march",
        "may import lower floors only",
    ),
    "neighbour": ("laws", "import viscontact.grid", "may import lower floors only"),
    "hidden": (
        "marching",
        "def f():\n    from viscontact.grid import Grid",
        "inside a function",
    ),
    "made up at run time": ("results", "import_module(name)", "inside a function"),
    "front door": ("case", "from viscontact import Sphere", "may import lower floors only"),
    "oracle in the product": ("marching", "from viscontact import reference", "lower floors only"),
    "oracle on the product": ("reference", "import viscontact.contact", "lower floors only"),
    "heavy and low": ("contact", "def f():\n    import xarray as xr", "begins on floor 5"),
    "shell below": ("case", "import typer", "begins on floor 7"),
    "stranger": ("grid", "import pandas", "a reason in pyproject.toml"),
    "homeless": ("utils", "", "has no floor"),
}
SOUND = {
    "downward": ("marching", "from viscontact.contact import solve"),
    "listed neighbour": ("step_by_step", "from .schedule import Step"),
    "own part": ("laws", "from viscontact.laws.series import CreepSeries"),
    "late in the shell": ("cli", "def f():\n    import viscontact\n    import rich"),
    "version": ("dataset", "from viscontact import __version__"),
    "oracle on the ground": ("reference", "from viscontact.grid import Grid"),
    "oracle shown": ("plot", "from viscontact import reference"),
    "standard library": ("grid", "import math"),
}


def forge(folder: Path, module: str, source: str) -> Path:
    package = folder / "viscontact"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / f"{module}.py").write_text(source)
    return package


@pytest.mark.parametrize(("module", "source", "message"), FORGED.values(), ids=FORGED.keys())
def test_a_breach_is_found(tmp_path: Path, module: str, source: str, message: str) -> None:
    [fault] = faults(forge(tmp_path, module, source))
    assert message in fault


@pytest.mark.parametrize(("module", "source"), SOUND.values(), ids=SOUND.keys())
def test_what_is_allowed_passes(tmp_path: Path, module: str, source: str) -> None:
    assert faults(forge(tmp_path, module, source)) == []
