"""Case files: whole ones of every kind of section, changed in places, written as YAML or TOML."""

from __future__ import annotations

import json
import math
from copy import deepcopy
from typing import Any

from hypothesis import strategies as st

from fuzzing import junk
from fuzzing.damage import damaged

_SHAPES: tuple[Any, ...] = (
    {"shape": "sphere", "radius": "10 mm"},
    {"shape": "paraboloid", "radius_x": "5 um", "radius_y": "6 um"},
    {"shape": "cone", "half_angle": "80 deg"},
    {"shape": "flat-punch", "radius": "2 mm"},
    {"shape": "flat-punch", "half_length": "1 mm", "half_width": "1 mm"},
    {"shape": "roller", "radius": "5 mm", "half_length": "9.565 mm", "crown_radius": "75 mm"},
    [{"shape": "sphere", "radius": "10 mm"}, {"shape": "sphere", "radius": "30 mm"}],
)
_BODY = {"poisson_ratio": 0.4}
_MATERIALS: tuple[Any, ...] = (
    "pmma-paper",
    {"law": "elastic", "shear_modulus": "10 MPa", "bulk_modulus": "4 GPa"},
    {"law": "maxwell", "shear_modulus": "10 MPa", "viscosity": "10 MPa s", **_BODY},
    {
        **{"law": "zener", "shear_modulus": "10 MPa", "delayed_modulus": "10 MPa"},
        **{"viscosity": "10 MPa s", **_BODY},
    },
    {
        **{"law": "burgers", "shear_modulus": "10 MPa", "viscosity": "1 GPa s"},
        **{"delayed_modulus": "9 MPa", "delayed_viscosity": "9 MPa s", **_BODY},
    },
    {
        **{"law": "creep-series", "instant": "5e-4 / MPa", "amplitudes": ["6e-5 / MPa"]},
        **{"times": ["10 s"], "fluidity": "1e-6 / (MPa s)", "data": "uniaxial", **_BODY},
    },
    {
        **{"law": "relaxation-series", "equilibrium": "5 MPa", "moduli": ["3 MPa", "2 MPa"]},
        **{"times": ["0.1 s", "1 s"], "data": "shear", "poisson_ratio": 0.5},
        **{"temperature": "60 degC", "measured_until": "100 s"},
        "shift": {"kind": "wlf", "reference_temperature": "25 degC", "c1": 17.44, "c2": "51.6 K"},
    },
    {
        **{"law": "power-law", "compliance": "1e-3 / MPa", "exponent": 0.3, **_BODY},
        **{"reference_time": "1 s", "instant": "1e-4 / MPa", "data": "shear"},
    },
    {"law": "table", "file": "creep.csv", "quantity": "creep_compliance", "data": "shear", **_BODY},
    {"law": "card", "file": "card.mac", "modulus_unit": "MPa", "time_unit": "s"},
)
_LOADS: tuple[Any, ...] = (
    {"kind": "step", "force": "4 N", "eccentricity_x": "0.1 mm"},
    {"kind": "step", "approach": "1 um", "tilt_x": "0.1 mrad", "tilt_y": "free"},
    {"kind": "ramp", "force": "4 N", "duration": "1 s"},
    {"kind": "triangle", "force": "4 N", "rise": "1 s", "fall": "2 s"},
    {"kind": "harmonic", "mean": "4 N", "amplitude": "2 N", "period": "1 s", "cycles": 2},
    {"kind": "history", "points": [["0 s", "0 N"], ["1 s", "4 N"], ["1 s", "2 N"]]},
    {"kind": "history", "file": "load.csv", "tilt_x": "0 rad"},
    {"kind": "history", "sentences": ["ramp to 4 N in 1 s", "hold for 2 s; repeat twice"]},
    {"kind": "history", "sentences": "step to 4 N; oscillate by 1 N with period 1 s for 3 cycles"},
)
_TIMES: tuple[Any, ...] = (
    {"end": "5 s", "steps": 6},
    {"end": "5 s", "steps": 6, "spacing": "log", "first": "0.1 s"},
    {"end": "5 s", "spacing": "adaptive", "tolerance": 1e-2},
)

_SAYINGS = (
    *(
        "hold for 1e300 s",
        "repeat 9 times",
        "repeat 99999 times",
        "repeat the last 2 sentences twice",
    ),
    *(
        "oscillate by 1 N with period 1 s for 999999999 cycles",
        "unload in 0.1 s",
        "unload at 1 N/s",
    ),
    *(
        "ramp to 10 kN at 1e-300 N/s",
        "hold until 0 s",
        "step to -5 N",
        "ramp by 1 mm in 1 s",
        ";;;",
    ),
    *(
        "and then " * 2000,
        " " * 20_000 + "x",
        "hold for " + "9" * 5000 + " s",
        "to to to",
        "in 1 in in in",
    ),
)
_SHAPES_OF_GRIDS = (
    *([1_000_000, 1_000_000], [10**9, 10**9], [10**12, 4], [4, 10**9], [4, 4], [3, 3], [1, 1]),
    *([40_000, 40_000], [10_000, 4], [1000, 1001], [0, 0], [-8, 8], [64.5, 64], ["64", 64], [64]),
)
_KEYS = (
    *("indenter", "material", "indenter_material", "load", "time", "grid", "output", "tolerance"),
    *("title", "radius", "raduis", "file", "points", "sentences", "steps", "fields", "kind", "law"),
    *(
        "profile",
        "thickness",
        "set",
        "columns",
        "name",
        "__class__",
        "model_config",
        "subject",
        "0",
        "",
    ),
    *(
        "<<",
        "time.end",
        "a b",
        "ключ",
        "\u202ex",
        "x" * 300,
        "null",
        "1",
        "-1",
        "1.5",
        "load.force",
    ),
)


@st.composite
def cases(draw: Any) -> dict[str, Any]:
    """Return a case as data, whole or changed in a few places."""
    case: dict[str, Any] = {
        "title": "fuzz",
        "indenter": draw(st.sampled_from(_SHAPES)),
        "material": draw(st.sampled_from(_MATERIALS)),
        "load": draw(st.sampled_from(_LOADS)),
        "time": draw(st.sampled_from(_TIMES)),
        "grid": {"shape": [16, 16], "size": ["3 mm", "3 mm"]},
        "output": {"fields": draw(st.sampled_from(("none", "all", ["0 s", "5 s"])))},
    }
    case = deepcopy(case)
    for _ in range(draw(st.sampled_from((0, 1, 1, 1, 2, 2, 3, 5)))):
        _change(draw, case)
    return case


def _change(draw: Any, case: dict[str, Any]) -> None:
    """Change one thing in a case."""
    places = _entries(case)
    if not places:
        return
    holder, key = draw(junk.one_of(places))
    old = holder[key]
    what = draw(
        st.sampled_from(("value", "near", "near", "near", "near", "drop", "rename", "add", "trap"))
    )
    if what == "value":
        holder[key] = draw(junk.values())
    elif what == "near":
        holder[key] = draw(_near(old))
    elif what == "drop":
        del holder[key]
    elif what == "rename" and isinstance(holder, dict):
        holder[draw(junk.one_of(_KEYS))] = holder.pop(key)
    elif what == "add" and isinstance(holder, dict):
        holder[draw(junk.one_of(_KEYS))] = draw(junk.values())
    elif what == "add":
        holder.extend([old] * draw(st.sampled_from((1, 3, 200))))
    elif what == "trap":
        _set_trap(draw, case)


def _set_trap(draw: Any, case: dict[str, Any]) -> None:
    """Put something where it is dangerous."""
    section, key, value = draw(
        st.one_of(
            st.tuples(st.just("grid"), st.just("shape"), junk.one_of(_SHAPES_OF_GRIDS)),
            st.tuples(st.just("time"), st.just("steps"), st.sampled_from((10**6, 10**9, 1e12, 0))),
            st.tuples(st.just("time"), st.just("first"), st.sampled_from(("1e-99 s", "1e-20 s"))),
            st.tuples(st.just("time"), st.just("end"), st.sampled_from(("1e99 s", "1e-99 s"))),
            st.tuples(st.just("time"), st.just("tolerance"), st.sampled_from((1e-6, 0.1, 1e-30))),
            st.tuples(st.just("load"), st.just("cycles"), st.sampled_from((10**5, 10**15, 1e15))),
            st.tuples(st.just("load"), st.just("sentences"), junk.one_of(_SAYINGS)),
            st.tuples(st.just("load"), st.just("file"), junk.one_of(junk.FILE_NAMES)),
            st.tuples(st.just("material"), st.just("file"), junk.one_of(junk.FILE_NAMES)),
            st.tuples(
                st.just("output"), st.just("fields"), st.just([f"{k} ms" for k in range(99)])
            ),
        )
    )
    holder = case.get(section)
    if isinstance(holder, dict):
        holder[key] = deepcopy(value)


def _entries(data: Any) -> list[tuple[Any, Any]]:
    """Return all places in a case: what holds, and under which key or index."""
    places: list[tuple[Any, Any]] = []
    if isinstance(data, dict | list):
        for key, value in data.items() if isinstance(data, dict) else enumerate(data):
            places.append((data, key))
            places += _entries(value)
    return places


def _near(old: Any) -> st.SearchStrategy[Any]:
    """Something of the same kind as what stands there."""
    if isinstance(old, str) and old[:1].isdigit():
        number, _, unit = old.partition(" ")
        return st.one_of(
            junk.number_texts().map(lambda new: f"{new} {unit}"),
            junk.one_of(junk.UNITS).map(lambda new: f"{number} {new}"),
            st.sampled_from((1e-6, 1e-3, 0.1, 10.0, 1e3, 1e6, 1e9, 1e15)).map(
                lambda by: f"{float(number) * by if _is_number(number) else number} {unit}"
            ),
        )
    if isinstance(old, str):
        return st.one_of(junk.texts(), st.just(old[:-1]), st.just(old + "x"), st.just([old]))
    if isinstance(old, bool | int | float):
        return st.one_of(
            st.sampled_from(
                (0, -1, 1, 2, old * 2, old / 2 if old < 1e300 else 0, -old, 1e99, 10**9)
            ),
            st.floats(),
            st.integers(),
        )
    return junk.values()


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


# --- as text ----------------------------------------------------------------------------------


def yaml_of(data: Any, indent: int = 0) -> str:
    """Write data as YAML without care: texts stand there bare, so that they may mean anything."""
    pad = "  " * indent
    if isinstance(data, dict) and data:
        return "".join(f"{pad}{key}:{_behind(value, indent)}" for key, value in data.items())
    if isinstance(data, list) and data:
        return "".join(f"{pad}-{_behind(value, indent)}" for value in data)
    return f"{pad}{_bare(data)}\n"


def _behind(value: Any, indent: int) -> str:
    if isinstance(value, dict | list) and value:
        return "\n" + yaml_of(value, indent + 1)
    return f" {_bare(value)}\n"


def _bare(value: Any) -> str:
    if value is None:
        return "null"
    return str(value).lower() if isinstance(value, bool) else str(value)


def flow_of(data: Any) -> str:
    """Write data as JSON, which YAML takes: every text arrives as it is."""
    return json.dumps(data)


def toml_of(data: dict[str, Any]) -> str:
    """Write data as TOML as far as that goes."""
    tables = {key: value for key, value in data.items() if isinstance(value, dict)}
    lines = [f"{key} = {_toml(value)}" for key, value in data.items() if key not in tables]
    for name, table in tables.items():
        lines += [f"[{name}]", *(f"{key} = {_toml(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, bool) or value is None:
        return str(value).lower()
    return json.dumps(value) if isinstance(value, str) else repr(value)


@st.composite
def case_texts(draw: Any) -> tuple[str, bytes]:
    """Return a suffix, and the bytes of a case file."""
    if draw(st.integers(0, 24)) == 0:
        return ".yaml", draw(junk.one_of(BOMBS))
    data = draw(cases())
    suffix, write = draw(
        st.sampled_from(
            ((".yaml", yaml_of), (".yaml", yaml_of), (".yaml", flow_of), (".toml", toml_of))
        )
    )
    return suffix, draw(damaged(write(data)))


def _laughs(levels: int, each: int = 9) -> str:
    """Write a list of lists of lists by aliases, each level `each` times longer."""
    lines = ["a0: &a0 [lol]"]
    for k in range(levels):
        lines.append(f"a{k + 1}: &a{k + 1} [{', '.join([f'*a{k}'] * each)}]")
    return "\n".join([*lines, f"load: *a{levels}"])


def _merges(levels: int) -> str:
    """Write mappings that each merge the one before many times."""
    lines = ["a0: &a0 {k: 1}"]
    for k in range(levels):
        lines.append(f"a{k + 1}: &a{k + 1} {{<<: [{', '.join([f'*a{k}'] * 9)}], k{k}: 1}}")
    return "\n".join([*lines, f"load: *a{levels}"])


#: Small files that expand without end, and large ones that say nothing.
BOMBS: tuple[bytes, ...] = tuple(
    text.encode()
    for text in (
        _laughs(9),
        _laughs(30),
        _laughs(2, each=400),
        _merges(6),
        _merges(9),
        _merges(30),
        "load: &a [*a]",
        "load: &a {load: *a}",
        "&a [*a, *a]",
        "a: &a {<<: *a, b: 1}",
        "[" * 100_000,
        "{a: " * 20_000,
        "- " * 20_000,
        "? " * 20_000,
        "a:\n" + "".join(" " * k + "a:\n" for k in range(1, 600)),
        "a: " + "!!a " * 2000,
        "x: !!python/object/apply:os.system ['touch pwned']",
        "x: !!python/name:os.system",
        "x: !!binary aGk=",
        "x: !!timestamp 2026-99-99",
        "x: !!int 12a",
        "x: !!float x",
        "x: !!set {a, b}",
        "x: !!omap [a: 1]",
        "x: !!map [1]",
        "x: !!seq {a: 1}",
        "x: !!null 1",
        "x: !!bool 7",
        "? [a, b]\n: c",
        "? {a: b}\n: c",
        "%TAG ! tag:x,2026:\n---\nx: !y z",
        "%YAML 1.1\n---\nx: 1:30:00",
        "--- a\n--- b",
        "a: 1\na: 2",
        "time: 2026-01-01T00:00:00Z",
        "k: " + "9" * 100_000,
        "k: 0x" + "f" * 100_000,
        "k: 1" + "_0" * 10_000,
        '"' + "\\u0041" * 20_000 + '": 1',
        "".join(f"k{i}: 1\n" for i in range(10_000)),
        "load: [" + "0, " * 100_000 + "0]",
        "load:\n" + "- 0 s\n" * 30_000,
        "# " + "x" * 2_000_000,
        "title: " + "x " * 500_000,
        "title: >\n" + "  x\n" * 30_000,
        "title: 'x" + "\n" * 100_000 + "'",
        "\n" * 1_000_000,
        " " * 1_000_000,
        "\t" * 100_000,
    )
)
