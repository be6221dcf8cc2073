"""Runs of a case with varied values, from Python."""

from __future__ import annotations

import json
import os
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from inspect import signature
from os import PathLike
from pathlib import Path
from typing import Any, Literal

import numpy as np
import xarray as xr

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.case import CaseError, read_case
from viscontact.runs.command_error import CommandError
from viscontact.runs.single import simulate
from viscontact.studies.case_values import result_of, without_option
from viscontact.studies.space import given_range
from viscontact.studies.sweep.common_cells import (
    KEY,
    common_cells,
    keeps_own_cells,
    recorded_cells,
)
from viscontact.studies.sweep.design_table import read_design
from viscontact.studies.sweep.designs import (
    METHODS,
    MOST_RUNS,
    Design,
    EqualValuesError,
    Method,
    grid_design,
    paired_design,
    sample_design,
)
from viscontact.studies.sweep.extremes import extreme_rows
from viscontact.studies.sweep.manifest import SweepRun
from viscontact.units.numbers import whole

#: Values of the varied keys, or the path of a table of runs.
Values = Mapping[str, Sequence[Any]] | str | PathLike[str]


@dataclass(frozen=True)
class VariedRun:
    """Run of a case file with settings; a call without arguments computes its result."""

    case: Path  # absolute
    settings: Mapping[str, str]  # all values in place of those of the case, by dotted key
    varied: tuple[str, ...]  # keys of the settings that differ between the runs
    name: str
    directory: str  # name of its run directory
    design: str
    has_common_cells: bool = False  # chosen for all runs, and not given in the settings

    @property
    def assignments(self) -> tuple[str, ...]:
        """Settings, as KEY=VALUE."""
        return tuple(f"{key}={value}" for key, value in self.settings.items())

    def __call__(self) -> xr.Dataset:
        """Simulate the run."""
        return result_of(read_case(self.case, self.assignments))

    @property
    def arguments(self) -> dict[str, Any]:
        """Arguments of `simulate` by name."""
        case = read_case(self.case, self.assignments)
        given = signature(simulate).parameters.keys() - {"threads", "progress"}
        return {name: getattr(case, name) for name in given}


def vary(
    case: str | PathLike[str],
    values: Values,
    *,
    design: Literal["grid", "zip", "sample"] = "grid",
    runs: int | None = None,
    seed: int = 0,
    method: Method = "sobol",
    settings: Mapping[str, Any] | None = None,
) -> list[VariedRun]:
    """Vary values of a case file: the runs for `simulate_many`, as of ``viscontact run``.

    Parameters
    ----------
    case : path-like
        Case file, YAML or TOML.
    values : mapping or path-like
        Values of each dotted key, such as ``{"load.force": ["5 kN", "10 kN"]}``: texts with
        units, numbers for keys without unit, or paths of files; entries of lists are numbered
        from 1. For a sample, two bounds, and ``"log"`` for a logarithmic scale:
        ``{"load.force": ("1 N", "1 kN", "log")}``. Or the path of a CSV file with a run in each
        row, whose headings are keys with units.
    design : {"grid", "zip", "sample"}, optional
        All combinations of the values; pairs, the first values of all keys, then the second
        ones; or points that fill the ranges evenly.
    runs : int, optional
        Number of runs of a sample.
    seed : int, optional
        Seed of a sample. The same seed gives the same runs, and more of them begin with these.
    method : {"sobol", "latin-hypercube"}, optional
        Points of a sample: a scrambled Sobol sequence (Sobol' 1967, Matousek 1998), or a latin
        hypercube (McKay, Beckman and Conover 1979).
    settings : mapping, optional
        Values of other keys, the same in all runs.

    Returns
    -------
    list of VariedRun
        The runs; automatic grids have common cells, as on the command line. Each can be called
        without arguments, and has the attributes ``name`` and ``settings``.

    Raises
    ------
    ValueError
        If an argument does not fit, a key or a value is refused (as `CaseError`, with all
        problems), numbers of values differ in pairs, or the table cannot be read. Of more than
        100 runs, only those with extreme values are checked, the others when they are computed.

    Examples
    --------
    >>> import tempfile
    >>> file = Path(tempfile.mkdtemp(), "ball.yaml")
    >>> _ = file.write_text(
    ...     "{indenter: {shape: sphere, radius: 5 mm}, "
    ...     "material: {law: elastic, shear_modulus: 1 MPa, poisson_ratio: 0.5}, "
    ...     "load: {kind: step, force: 1 N}, time: {end: 1 s, steps: 1}, "
    ...     "grid: {shape: [32, 32], size: [2.4 mm, 2.4 mm]}}"
    ... )
    >>> one, eight = vary(file, {"load.force": ["0.1 N", "0.8 N"]})
    >>> one.name
    'force=0.1N'
    >>> round(float(eight().approach[-1] / one().approach[-1]), 1)  # Hertz: 8**(2/3)
    4.0

    Four random forces, evenly over a logarithmic scale:

    >>> sample = vary(file, {"load.force": ("0.1 N", "0.8 N", "log")}, design="sample", runs=4)
    >>> len(sample), sample[3].name, 0.1 <= float(sample[3].settings["load.force"][:-2]) <= 0.8
    (4, '0003', True)
    """
    path = Path(case)
    chosen = _design(values, design, runs, seed, method, (settings or {}).keys())
    fixed = tuple(f"{key}={_text(value)}" for key, value in (settings or {}).items())
    own_cells = _keep_own_cells(path, chosen, fixed, str(values))
    added = fixed if own_cells else (*fixed, *_common_cells(path, chosen, fixed))
    whole = path.parent.resolve() / path.name
    return [
        VariedRun(
            whole,
            dict(text.split("=", 1) for text in (*added, *chosen.settings(row))),
            chosen.keys,
            chosen.name(row),
            f"{path.stem}_{chosen.name(row)}",
            chosen.kind,
            has_common_cells=not own_cells,
        )
        for row in range(len(chosen.rows))
    ]


def sweep_run(number: int, run: VariedRun, case: str, earlier: Sequence[SweepRun] = ()) -> SweepRun:
    """Line of the manifest of a run, whose case has a name there; common cells are kept."""
    settings = dict(run.settings)
    cells = recorded_cells(earlier, case) if run.has_common_cells else None
    if cells is not None:
        settings.pop(f"grid.{KEY}", None)
        settings |= dict(text.split("=", 1) for text in cells)
    return SweepRun(number, run.name, run.directory, settings, run.varied, case, run.design)


def case_name(case: Path, place: Path) -> str:
    """Path of a case file from the directory of a sweep, which is absolute."""
    # The file itself may be a link: the files that the case names lie next to the link.
    whole = case.parent.resolve() / case.name
    try:
        return Path(os.path.relpath(whole, place)).as_posix()
    except ValueError:  # on another drive
        return whole.as_posix()


def _design(
    values: Values, design: str, runs: int | None, seed: int, method: str, fixed: Collection[str]
) -> Design:
    """Design of the values; ValueError if an argument does not fit."""
    if design not in ("grid", "zip", "sample"):
        raise ValueError(f"design: must be 'grid', 'zip' or 'sample', got {design!r}")
    if design != "sample" and runs is not None:
        raise ValueError(f"runs: goes with design='sample', got design={design!r}")
    if isinstance(values, str | PathLike):
        found = read_design(Path(values))
    elif not isinstance(values, Mapping) or not values:
        raise ValueError("values: name a key, as {'load.force': ['5 kN', '10 kN']}")
    elif design == "sample":
        found = _sample(values, runs, seed, method)
    else:
        texts = {key: _texts(key, given) for key, given in values.items()}
        try:
            found = grid_design(texts) if design == "grid" else _pairs(texts)
        except EqualValuesError as error:
            raise ValueError(f"values: {error}") from None
    for key in fixed:
        if key in found.keys:
            raise ValueError(f"settings: {key}: is varied, too; leave one of them out")
    return found


def _pairs(texts: Mapping[str, Sequence[str]]) -> Design:
    try:
        return paired_design(texts)
    except EqualValuesError:
        raise
    except ValueError as error:
        raise ValueError(f"values: {error}; leave design='zip' out for all combinations") from None


def _sample(values: Mapping[str, Any], runs: int | None, seed: int, method: str) -> Design:
    if runs is None:
        raise ValueError("runs: must be the number of runs of the sample, e.g. runs=64")
    if method not in METHODS:
        raise ValueError(f"method: must be {' or '.join(map(repr, METHODS))}, got {method!r}")
    number, start = whole("runs", runs, 1, MOST_RUNS), whole("seed", seed, 0)
    ranges = [given_range("values", key, given) for key, given in values.items()]
    return sample_design(ranges, number, start, method)


def _texts(key: str, given: Sequence[Any]) -> list[str]:
    if isinstance(given, str) or not (isinstance(given, Sequence | np.ndarray) and len(given)):
        raise ValueError(
            f"values: {key}: must be a list of values, as ['5 kN', '10 kN'], got {given!r}"
        )
    return [_text(value) for value in given]


def _text(value: Any) -> str:
    """Value as text of YAML."""
    if isinstance(value, str):
        return value
    if isinstance(value, PathLike):  # in a case, relative to its folder
        return json.dumps(str(Path(value).resolve()), ensure_ascii=False)
    return json.dumps(value.item() if isinstance(value, np.generic) else value)


def _keep_own_cells(case: Path, design: Design, settings: Sequence[str], table: str) -> bool:
    """Check runs, and test whether they keep their own cells; problems name the table's line."""
    for row in extreme_rows(design):
        with _case_errors(f"{table}:{design.lines[row]}: " if design.lines else ""):
            read_case(case, (*settings, *design.settings(row)))
    return keeps_own_cells(case, design, settings)


def _common_cells(case: Path, design: Design, settings: Sequence[str]) -> tuple[str, ...]:
    """Setting of the common cells of checked runs; none if there are too many of them."""
    with _case_errors():
        return common_cells(case, design, settings).settings


@contextmanager
def _case_errors(place: str = "") -> Iterator[None]:
    """Raise refusals and faults of a case as a CaseError that names a place, but no option."""
    try:
        yield
    except CommandError as error:
        raise CaseError(*(f"{place}{without_option(line)}" for line in error.lines)) from None
    except CaseError as error:
        lines = (f"{place}{without_option(line)}" for line in error.problems)
        raise CaseError(*lines) from None
