"""Families of bad input, each a strategy and what is done with what it makes."""

from __future__ import annotations

import shutil
import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hypothesis import strategies as st

from fuzzing import junk
from fuzzing.calls import calls, height_maps
from fuzzing.cards import cards
from fuzzing.case_files import case_texts, cases, flow_of
from fuzzing.surface_files import surface_files
from fuzzing.tables import tables
from fuzzing.watch import Tally, command, contents, refused_or, refuses
from viscontact.runs.execution.prepared_case import prepare

#: Runs that would take longer are checked only [s].
SHORT = 0.3

CASE = """\
indenter: {shape: sphere, radius: 10 mm}
material: {law: zener, shear_modulus: 10 MPa, delayed_modulus: 10 MPa, viscosity: 1 MPa s,
  poisson_ratio: 0.5}
load: {kind: step, force: 4 N}
time: {end: 5 s, steps: 3}
grid: {shape: [16, 16], size: [3 mm, 3 mm]}
"""
LOADED = CASE.replace("kind: step, force: 4 N", "kind: history, file: given.csv")
PRESSED = """\
indenter: {shape: height-map, file: FILE, missing: lowest, level: none}
material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}
load: {kind: step, force: 1 uN, tilt_x: 0 rad, tilt_y: 0 rad}
time: {end: 1 s, steps: 1}
grid: {shape: [8, 8], size: [20 um, 20 um]}
"""
_KIND_OF = {"load.csv": "load", "approach.csv": "load", "creep.csv": "law", "relax.csv": "law"}


@dataclass(frozen=True)
class Family:
    """One family of input.

    Parameters
    ----------
    name : str
        In the figures.
    inputs : SearchStrategy
        What it makes.
    put : callable
        Gives an input to the product, checks what must hold, and counts it.
    share : float
        Of all inputs of a campaign.
    """

    name: str
    inputs: st.SearchStrategy[Any]
    put: Callable[[Any, Tally], None]
    share: float


def asked(arguments: list[str], data: bytes, tally: Tally, done: str = "accepted") -> int:
    """Run a command in the working directory; one that is refused leaves nothing behind."""
    before = contents(Path.cwd())
    ending = command(arguments)
    if ending.code == 2:
        assert contents(Path.cwd()) == before, "refused, and yet something has changed"
    tally.add(refused_or(done, ending), ending.seconds, len(data))
    return ending.code


def put_case(given: tuple[str, bytes], tally: Tally) -> None:
    """Check a case file."""
    suffix, data = given
    Path(f"given{suffix}").write_bytes(data)
    asked(["check", f"given{suffix}"], data, tally)


def put_run(case: dict[str, Any], tally: Tally) -> None:
    """Check a case, and run it if it is short: what is accepted can be computed."""
    data = flow_of(case).encode("utf-8", "surrogatepass")
    Path("given.yaml").write_bytes(data)
    if asked(["check", "given.yaml"], data, tally) == 0:
        _run_if_short(data, tally)


def _run_if_short(data: bytes, tally: Tally) -> None:
    if prepare(Path("given.yaml"), []).run.forecast().seconds > SHORT:
        return
    shutil.rmtree("ran", ignore_errors=True)
    asked(["run", "given.yaml", "-o", "ran", "-q"], data, tally, done="run to the end")


def put_setting(settings: list[str], tally: Tally) -> None:
    """Check a good case with values set on the command line."""
    Path("good.yaml").write_text(CASE, encoding="utf-8")
    typed = [word for setting in settings for word in ("--set", setting)]
    asked(["check", "good.yaml", *typed], "".join(settings).encode("utf-8", "replace"), tally)


def put_table(given: tuple[str, bytes], tally: Tally) -> None:
    """Give a table to the command that takes its like."""
    name, data = given
    Path("given.csv").write_bytes(data)
    kind = _KIND_OF.get(name, "fit")
    if kind == "load":
        Path("loaded.yaml").write_text(LOADED, encoding="utf-8")
        asked(["check", "loaded.yaml"], data, tally)
    elif kind == "law":
        test = ["--data", "shear", "--poisson-ratio", "0.4"]
        asked(["material", "given.csv", *test], data, tally)
    else:
        body = ["--poisson-ratio", "0.4"]
        record = name == "record.csv"
        asked(["fit", "given.csv", *body, *(_RECORD if record else [])], data, tally)


_RECORD = ["--indenter", "sphere 5 um", "--law", "elastic"]


def put_surface(given: tuple[str, bytes, tuple[str, ...]], tally: Tally) -> None:
    """Check a case with a surface from a text."""
    name, data, settings = given
    Path(name).write_bytes(data)
    Path("pressed.yaml").write_text(PRESSED.replace("FILE", name), encoding="utf-8")
    typed = [word for each in settings for word in ("--set", each)]
    asked(["check", "pressed.yaml", *typed], data, tally)


def put_card(given: tuple[str, bytes], tally: Tally) -> None:
    """Show the material of a card, or write it in another form."""
    name, data = given
    path = f"given{Path(name).suffix}"
    Path(path).write_bytes(data)
    units = ["--modulus-unit", "MPa", "--time-unit", "s", "--temperature-unit", "degC"]
    form = ["--to", "ansys"] if len(data) % 3 == 0 else []
    asked(["material", path, *units, *form], data, tally)


def put_call(given: tuple[Callable[[], Any], str], tally: Tally) -> None:
    """Make a call."""
    call, words = given
    started = clock.perf_counter()
    ending = refuses(call)
    tally.add(ending, clock.perf_counter() - started, len(words))


def settings() -> st.SearchStrategy[list[str]]:
    """Values of --set."""
    keys = junk.one_of(
        (
            *(
                "load.force",
                "grid.shape",
                "grid.shape[1]",
                "time.steps",
                "indenter",
                "indenter.radius",
            ),
            *(
                "material.law",
                "load.file",
                "load",
                "output.fields",
                "title",
                "time",
                "a.b.c.d.e.f.g",
            ),
            *(
                "[1]",
                "[0]",
                "indenter[99999999999999999999]",
                "load[1].force",
                "",
                ".",
                "..",
                "[",
                "==",
            ),
            *("load.", ".load", "load..force", "a[1][2][3]", "load.force ", "\0", "é", "x" * 9000),
            *(
                ".a" * 3000,
                "__proto__",
                "load.force[1]",
                "time.end",
                "tolerance",
                "grid",
                "material",
            ),
        )
    )
    values = st.one_of(junk.quantities(), junk.texts(), junk.values().map(str))
    good = junk.one_of(_SETTINGS)
    any_at_all = st.one_of(st.builds("{}={}".format, keys, values), keys, values)
    return st.one_of(
        st.lists(good, min_size=1, max_size=3),
        st.lists(st.one_of(good, any_at_all), min_size=1, max_size=3),
        st.lists(any_at_all, min_size=1, max_size=3),
    )


_SETTINGS = (
    *("load.force=20N", "load.force=1 mN", "grid.shape=[8, 8]", "grid.shape[2]=32", "time.steps=9"),
    *("material.poisson_ratio=.3", "time.end=1 min", "output.fields=none", "output.fields=[1 s]"),
    *("title=x", "indenter.radius=2cm", "load.eccentricity_x=1um", "tolerance=1e-4", "title=' '"),
)

FAMILIES = (
    Family("case files", case_texts(), put_case, 0.22),
    Family("runs", cases(), put_run, 0.06),
    Family("--set", settings(), put_setting, 0.10),
    Family("tables", tables(), put_table, 0.17),
    Family("surface files", surface_files(), put_surface, 0.08),
    Family("cards", cards(), put_card, 0.13),
    Family("height maps", height_maps(), put_call, 0.12),
    Family("Python calls", calls(), put_call, 0.20),
)
