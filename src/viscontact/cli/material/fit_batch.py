"""Fit of many force curves or indentation records: one table, figures, and what failed."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Indenter
from viscontact.cli.material import fit_kinds
from viscontact.cli.material.curve_files import holds_several
from viscontact.cli.material.fit_options import FitArguments
from viscontact.cli.material.fit_report import DeferredFigure, draw_fit
from viscontact.cli.terminal.messages import put, refuse, say
from viscontact.cli.terminal.progress import counted
from viscontact.identification import (
    AdhesionFit,
    FittedCurve,
    ForceCurve,
    IndentationFit,
    IndentationRecord,
    find_contact,
    read_force_curve,
    read_force_map,
)
from viscontact.identification.curve_batch import CurveFits, fit_each
from viscontact.identification.instrument_curves import is_instrument_file, split_number
from viscontact.studies.executors.executor_choice import chosen_workers
from viscontact.tables import read_table

#: Table of the fits where none is named.
TABLE = Path("fits.csv")
#: Quantities of indentations.
_COLUMNS = ("force", "approach", "position", "deflection", "signal")
#: Most failures that are printed, and curves from which on processes are started.
_SHOWN, _WORTH_PROCESSES = 10, 8


@dataclass(frozen=True)
class _Curves:
    """Curves by name, as files or as they were read from a map, and what is known of them."""

    sources: dict[str, Path | ForceCurve]
    places: dict[str, tuple[float, float]]
    failed: tuple[FittedCurve, ...]

    @classmethod
    def of(cls, files: Sequence[Path], arguments: FitArguments) -> _Curves:
        """Curves of files, each of a map by its own name."""
        sources: dict[str, Path | ForceCurve] = {}
        places: dict[str, tuple[float, float]] = {}
        failed: list[FittedCurve] = []
        for name, file in zip(_names(files), files, strict=True):
            if not holds_several([file]):
                sources[name] = file
                continue
            fit_kinds.INSTRUMENT_CURVE.refuse_idle(file.name, arguments.given)
            try:
                found = read_force_map(file, spring_constant=arguments.stiffness())
            except (ValueError, OSError) as error:
                failed.append(FittedCurve(name, {}, {}, {}, failure=str(error)))
                continue
            # As in `read_force_map`, by the name that tells files of different directories apart.
            sources |= {_renamed(curve, name): each for curve, each in found.curves.items()}
            places |= {_renamed(curve, name): each for curve, each in found.places.items()}
            failed += [
                FittedCurve(_renamed(curve, name), {}, {}, {}, failure=why)
                for curve, why in found.failures.items()
            ]
        # Each map has a place of its own for its origin: two would lie on each other.
        maps = {curve.rpartition("#")[0] for curve in places}
        return cls(sources, places if len(maps) == 1 else {}, tuple(failed))


def _renamed(curve: str, file: str) -> str:
    """Name of a curve of a map with the name of its file."""
    return f"{file}#{curve.rpartition('#')[2]}"


def report_fits(
    files: Sequence[Path],
    arguments: FitArguments,
    output: Path | None,
    table: Path | None,
    *,
    width: str | float | None = None,
    jobs: int | None = None,
    quiet: bool = False,
) -> None:
    """Fit each of many curves; print a summary, and write a table and a figure."""
    try:
        curves = _Curves.of(files, arguments)
    except (ValueError, OSError) as error:
        refuse(str(error))
    if not curves.sources:
        _print_failures(CurveFits(curves.failed))
        refuse(f"none of {len(curves.failed)} curves could be read")
    total = len(curves.sources)
    workers = jobs if total >= _WORTH_PROCESSES else 1
    lines = "{done} of {total} curves, about {left:.0f} s left"
    with (
        chosen_workers(workers, most=total) as chosen,
        counted("curves", quiet=quiet, line=lines) as progress,
    ):
        fit = partial(fitted_curve, arguments)
        fits = fit_each(
            *(fit, curves.sources),
            executor=chosen.executor,
            progress=progress,
            places=curves.places,
        )
    found = CurveFits((*fits.curves, *curves.failed))
    _print_failures(found)
    if not found.fitted:
        refuse(f"none of {len(found.curves)} curves could be fitted")
    put(repr(found))
    path = table or TABLE
    try:
        found.write(path)
    except OSError as error:
        refuse(f"{path}: {error.strerror or error}")
    put(path)
    if output is not None:
        draw_fit(DeferredFigure("curve_fits", found), output, width)


def fitted_curve(
    arguments: FitArguments, source: Path | ForceCurve
) -> IndentationFit | AdhesionFit:
    """Fit of a curve, or of the curve or record in a file; ValueError or OSError without one."""
    if isinstance(source, ForceCurve):
        return _fit_of(source, arguments.indenter_of("the map"), arguments)
    file = source
    if is_instrument_file(split_number(file)[0]):
        fit_kinds.INSTRUMENT_CURVE.refuse_idle(file.name, arguments.given)
        indenter = arguments.indenter_of(file.name)
        curve = read_force_curve(file, spring_constant=arguments.stiffness())
    else:
        table = read_table(file, arguments.columns, wanted=_COLUMNS)
        indenter = arguments.indenter_of(file.name)
        if "force" in table and "approach" in table:
            fit_kinds.INDENTATION.refuse_idle(file.name, arguments.given, table.contents)
            record = IndentationRecord(indenter, table["time"], table["approach"], table["force"])
            return arguments.fitted(record)
        if "position" not in table:
            raise ValueError(
                f"{file.name}: several tables are fitted one by one if they are indentations, with "
                "columns time, and approach and force, or position and deflection; others belong "
                "to a case (--case)"
            )
        kind = fit_kinds.VOLTAGE_CURVE if "signal" in table else fit_kinds.FORCE_CURVE
        kind.refuse_idle(file.name, arguments.given, table.contents)
        curve = arguments.force_curve(table)
    return _fit_of(curve, indenter, arguments)


def _fit_of(
    curve: ForceCurve, indenter: Indenter, arguments: FitArguments
) -> IndentationFit | AdhesionFit:
    """Fit of adhesion, or of a law, to a force curve."""
    if arguments.adhesion:
        return arguments.adhering(curve, indenter)
    options = {} if arguments.reach is None else {"reach": arguments.reach}
    return arguments.fitted(find_contact(curve, indenter, **options).record())


def _names(files: Sequence[Path]) -> list[str]:
    """Names of the files, with their directories where these alone tell them apart."""
    short = [each.name for each in files]
    names = short if len(set(short)) == len(short) else [str(each) for each in files]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        refuse(f"{twice}: is named twice; name each curve once")
    return names


def _print_failures(found: CurveFits) -> None:
    """Print the first curves that have no fit, with the reasons."""
    for each in found.failed[:_SHOWN]:
        reason = each.failure.removeprefix("fit_indentation: ").removeprefix("fit_adhesion: ")
        say(reason if reason.startswith(each.name) else f"{each.name}: {reason}")
    if (left := len(found.failed) - _SHOWN) > 0:
        say(f"and {left} more have no fit; the table has the reasons")
