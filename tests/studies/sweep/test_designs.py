"""Designs of a sweep: combinations, pairs, tables and even random points."""

from __future__ import annotations

import math
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from closeness import close_to
from viscontact.studies.space import Range, read_range
from viscontact.studies.sweep.design_table import read_design
from viscontact.studies.sweep.designs import Design, grid_design, paired_design, sample_design
from viscontact.studies.sweep.extremes import extreme_rows
from viscontact.units.parsing import parse_quantity

RANGES = (Range("load.force", 5.0, 20.0, "kN"), Range("time.end", 1.0, 1000.0, "s", True))
BOUNDS = st.floats(1e-6, 1e6)


def table(folder: Path, text: str, name: str = "plan.csv") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def numbers(design: Design, column: int = 0) -> list[float]:
    return [float(row[column].split()[0]) for row in design.rows]


def test_a_grid_has_each_combination_once() -> None:
    design = grid_design({"a": ["1", "2", "3"], "b": ["4", "5"], "c": ["6"]})
    assert len(design.rows) == 6 == len(set(design.rows))
    assert design.rows[:3] == (("1", "4", "6"), ("1", "5", "6"), ("2", "4", "6"))
    assert design.settings(5) == ("a=3", "b=5", "c=6")


def test_pairs_need_equal_numbers_of_values() -> None:
    with pytest.raises(ValueError, match=r"got 2 of load\.force, 3 of time\.end"):
        paired_design({"load.force": ["1 N", "2 N"], "time.end": ["1 s", "2 s", "3 s"]})


@pytest.mark.parametrize(
    ("text", "rows"),
    [
        ("load.force [N],time.end\n5,1 s\n7e-1,2 s\n", (("5 N", "1 s"), ("7e-1 N", "2 s"))),
        ("load.force (kN)\ttime.steps\n0,5\t4\n2\t5\n", (("0.5 kN", "4"), ("2 kN", "5"))),
        ("load.force [kN];x\n0,5;[3, 4]\n", (("0.5 kN", "[3, 4]"),)),
        ('load.force;grid.shape\n5 N;"[3, 4]"\n', (("5 N", "[3, 4]"),)),
        ("# a plan\n\nmaterial.amplitudes[2] [1/MPa],b [-]\n5,3\n", (("5 1/MPa", "3"),)),
        ("a[1].b,c[2]\nx y,zener\n", (("x y", "zener"),)),
        ("a [1/(MPa s)],b (1/(MPa s))\n5,6\n", (("5 1/(MPa s)", "6 1/(MPa s)"),)),
        ("load.force [N],\n5,\n", (("5 N",),)),
    ],
)
def test_a_table_has_a_run_in_each_row(tmp_path: Path, text: str, rows: object) -> None:
    assert read_design(table(tmp_path, text)).rows == rows


def test_keys_of_a_table_are_its_headings_without_units(tmp_path: Path) -> None:
    text = "a.b[1] [N],a.b[2],indenter[2].radius [mm],c\n1,2 N,3,4\n\n5,6 N,7,8\n"
    design = read_design(table(tmp_path, text))
    assert design.keys == ("a.b[1]", "a.b[2]", "indenter[2].radius", "c")
    assert design.lines == (2, 4)
    assert [design.name(row) for row in range(2)] == ["0000", "0001"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("load.force [N]\n", "plan.csv: has a header and no rows"),
        ("5,6\n7,8\n", "plan.csv:1: there is no header, but '5' in column 1"),
        ("load.force [N],,x\n5,6,7\n", "plan.csv:1: column 2: the heading is empty, names no key"),
        ("load force\n5\n", "plan.csv:1: column 1: the heading 'load force' names no key"),
        ("a [N],b,a (kN)\n5,6,7\n", "plan.csv:1: 2 columns are a; leave one of them"),
        ("a [N],b\n5,6\n7\n", "plan.csv:3: has 1 cell, the header 2; add a value of 'b'"),
        ("a [N],b\n5,6,7\n", "plan.csv:2: has 3 cells, the header 2; write a cell with commas in"),
        ("a [N],b\n5,6\n,7\n", "plan.csv:3: column 'a [N]': the cell is empty"),
        ("a [N],b\n5,\n", "plan.csv:2: column 'b': the cell is empty"),
        ("a [N]\n5 N\n", "'a [N]': '5 N' is not a number; write it without unit, as"),
        ("a [N]\nabc\n", "plan.csv:2: column 'a [N]': 'abc' is not a number"),
        ("a [N]\nnan\n", "plan.csv:2: column 'a [N]': must be a finite number"),
        ("a [N];b [N]\n0,5;0.5\n", "in a file of decimal commas"),
    ],
)
def test_a_faulty_cell_is_named_by_line_and_column(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(ValueError, match=r"plan\.csv") as caught:
        read_design(table(tmp_path, text))
    assert said in str(caught.value)


@pytest.mark.parametrize("name", ["plan.csv", "plan.xlsx", "plan.ods#Runs"])
def test_a_missing_file_is_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="no such file"):
        read_design(tmp_path / name)


@given(
    st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=5),
    st.sampled_from([";", "\t", ","]),
)
def test_numbers_of_a_table_keep_all_digits(
    tmp_path_factory: pytest.TempPathFactory, values: list[float], separator: str
) -> None:
    rows = "\n".join(f"{value!r}{separator}x" for value in values)
    if separator != ",":
        rows = rows.replace(".", ",")
    path = table(tmp_path_factory.mktemp("plan"), f"a [N]{separator}b\n{rows}\n")
    assert numbers(read_design(path)) == values


@given(BOUNDS, BOUNDS, st.booleans(), st.integers(1, 40), st.integers(0, 2**40))
def test_samples_lie_within_their_ranges(
    one: float, other: float, logarithmic: bool, number: int, seed: int
) -> None:
    low, high = min(one, other), max(one, other) * 2
    design = sample_design([Range("a", low, high, "N", logarithmic)], number, seed)
    assert len(design.rows) == number
    for value in numbers(design):  # written with 12 digits
        assert low * (1 - 1e-11) <= value <= high * (1 + 1e-11)


@given(st.integers(1, 64), st.integers(1, 64), st.integers(0, 1000))
def test_a_longer_sobol_sequence_begins_with_the_shorter_one(n: int, more: int, seed: int) -> None:
    short, long = (sample_design(RANGES, count, seed) for count in (n, n + more))
    assert long.rows[:n] == short.rows
    assert [long.name(row) for row in range(n)] == [short.name(row) for row in range(n)]


@pytest.mark.parametrize("method", ["sobol", "latin-hypercube"])
def test_every_stratum_of_every_range_has_one_point(method: str) -> None:
    """A net in base 2 in each projection (Sobol' 1967; scrambled: Owen 1995), a hypercube always.

    McKay, Beckman and Conover (1979) define the latin hypercube by this property.
    """
    number = 64 if method == "sobol" else 50
    design = sample_design(RANGES, number, 7, method)  # type: ignore[arg-type]
    strata = range(number)
    force = [math.floor((x - 5) / 15 * number) for x in numbers(design)]
    end = [math.floor(math.log(x) / math.log(1000) * number) for x in numbers(design, 1)]
    assert sorted(force) == list(strata)
    assert sorted(end) == list(strata)  # even on the logarithmic scale


@pytest.mark.parametrize("method", ["sobol", "latin-hypercube"])
@pytest.mark.parametrize("number", [1, 3, 100])
def test_any_number_of_runs_is_drawn_without_a_warning(method: str, number: int) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        first = sample_design(RANGES, number, 5, method)  # type: ignore[arg-type]
    assert first == sample_design(RANGES, number, 5, method)  # type: ignore[arg-type]
    assert first != sample_design(RANGES, number, 6, method)  # type: ignore[arg-type]
    assert len(set(first.rows)) == number


def test_bounds_in_different_units_are_those_of_one_dimension() -> None:
    found = read_range("load.force = 500 N : 2 kN")
    assert (found.low, found.high, found.unit) == (500.0, 2000.0, "N")
    found = read_range("load.force=2 kN:9000 N")
    assert (found.low, found.high, found.unit) == (2000.0, 9000.0, "N")
    percent = read_range("grid.tolerance=1 %:5 %")
    assert percent.value(0.5) == "3 %"
    assert read_range("material.poisson_ratio=0.3:0.5").value(0.0) == "0.3"
    middle = parse_quantity(read_range("a=0.5 / GPa:2 / GPa:log").value(0.5), "compliance")
    assert middle == close_to(1e-9, rel=1e-11)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("load.force", "write KEY=LOW:HIGH"),
        ("load.force=5 kN", "write KEY=LOW:HIGH"),
        ("=5 kN:6 kN", "write KEY=LOW:HIGH"),
        ("load.force=5 kN:", "write KEY=LOW:HIGH"),
        ("load.force=5 kN:6 kN:lin", "write KEY=LOW:HIGH"),
        ("load.force=5 kN:6 kN:log:log", "write KEY=LOW:HIGH"),
        ("load.force=6 kN:5 kN", "the lower bound comes first"),
        ("load.force=5 kN:5000 N", "the lower bound comes first, and differs"),
        ("load.force=0 N:5 N:log", "a logarithmic range needs bounds above zero, got 0 N"),
        ("load.force=5:6 kN", "both bounds need a unit, or none"),
        ("load.force=5 kN:6 mm", "the units of '5 kN' and '6 mm' do not fit"),
        ("load.force=5 kN:6 kNn", "the units of '5 kN' and '6 kNn' do not fit"),
        ("a=0 degC:300 K", "write one unit in both"),
        ("grid.shape=[32, 32]:[64, 64]", "'[32, 32]' is not a number with a unit"),
        ("indenter.shape=cone:sphere", "'cone' is not a number with a unit"),
        ("load.force=5,5 kN:6 kN", "'5,5 kN' is not a number with a unit"),
        ("load.force=1e999 N:2e999 N", "the bounds must be finite"),
    ],
)
def test_a_faulty_range_is_refused(text: str, said: str) -> None:
    with pytest.raises(ValueError, match=r".+") as caught:
        read_range(text)
    assert said in str(caught.value)


def test_faulty_numbers_of_runs_and_seeds_are_refused() -> None:
    with pytest.raises(ValueError, match="must be a number of runs from 1 to 1000000, got 0"):
        sample_design(RANGES, 0)
    with pytest.raises(ValueError, match="seed must be zero or more, got -1"):
        sample_design(RANGES, 4, -1)


def test_corners_of_a_large_grid_represent_it() -> None:
    forces = [f"{n} N" for n in (*range(30, 0, -1), *range(31, 41))]
    ends = [f"{n} ms" for n in range(500, 520)] + ["2 s"]  # 0.5 s to 2 s
    design = grid_design({"load.force": forces, "time.end": ends})
    found = {design.rows[row] for row in extreme_rows(design)}
    corners = {(force, end) for force in ("1 N", "40 N") for end in ("500 ms", "2 s")}
    assert found == corners | {design.rows[0]}


def test_samples_with_the_extreme_values_represent_the_others() -> None:
    ranges = [Range(f"k{n}", 1.0, 2.0, "mm") for n in range(7)]
    design = sample_design(ranges, 200, 1)
    rows = extreme_rows(design)
    values = np.array([[float(text.split()[0]) for text in row] for row in design.rows])
    assert set(values.argmin(axis=0)) | set(values.argmax(axis=0)) | {0} == set(rows)
    assert extreme_rows(sample_design(ranges, 100, 1)) == list(range(100))
