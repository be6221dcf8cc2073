"""Fit of a measured table: printed, drawn and written."""

from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from viscontact import identification
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.series_fits import Fit
from viscontact.bodies.series_fits.prony import fit_creep, fit_relaxation
from viscontact.bodies.series_fits.table_fit import fit_measured, loss_note, measured_columns
from viscontact.cli.material import fit_kinds
from viscontact.cli.material.fit_kinds import Kind
from viscontact.cli.material.fit_options import FitArguments, read_kelvin, read_stress
from viscontact.cli.material.table_choice import as_option, say_chosen
from viscontact.cli.results.figure_files import plot_package
from viscontact.cli.terminal.messages import put, refuse, say
from viscontact.identification import (
    ForceCurve,
    IndentationRecord,
    find_contact,
    material_section,
    read_force_curve,
)
from viscontact.identification.instrument_curves import is_instrument_file
from viscontact.identification.tabulated_sets import with_volume
from viscontact.tables import Table, read_table

# Quantities one of which a table has that can be fitted.
_FITTED = (
    *("storage_modulus", "complex_modulus", "relaxation_modulus", "modulus"),
    *("creep_compliance", "creep_modulus", "strain", "stress"),
    *("force", "approach", "position", "deflection", "signal"),
)


def report_fit(
    file: Path,
    arguments: FitArguments,
    output: Path | None,
    section: Path | None,
    *,
    width: str | float | None = None,
) -> None:
    """Fit a law to a table; print it, and draw and write it where files are named."""
    if is_instrument_file(file):
        text, draw = _from_instrument(file, arguments)
    else:
        text, draw = _from_table(file, arguments)
    put(f"\n{text}")
    if output is not None:
        draw_fit(draw, output, width)
    if section is not None:
        write_section(section, text + "\n")


def _from_table(file: Path, arguments: FitArguments) -> tuple[str, DeferredFigure]:
    table = _read_table(file, arguments)
    say_chosen(file, table)
    try:
        return _fit_table(table, arguments)
    except ValueError as error:
        refuse(table.located(error))


def _from_instrument(file: Path, arguments: FitArguments) -> tuple[str, DeferredFigure]:
    try:
        fit_kinds.INSTRUMENT_CURVE.refuse_idle(file.name, arguments.given)
        indenter = arguments.indenter_of(file.name)
        curve = read_force_curve(file, spring_constant=arguments.stiffness())
        return _from_force_curve(curve, indenter, arguments)
    except (ValueError, OSError) as error:
        refuse(str(error))


class DeferredFigure:
    """Figure that is drawn only when it is saved, as matplotlib may be missing."""

    def __init__(self, name: str, *shown: object, **options: object) -> None:
        self._name, self._shown, self._options = name, shown, options

    def save(self, path: Path, width: str | float | None) -> None:
        """Draw the figure on a page of a width [m] and save it."""
        plot = plot_package()
        draw = getattr(plot, self._name)
        plot.save_figure(draw(*self._shown, width=width, **self._options), path)


def _fit_table(table: Table, arguments: FitArguments) -> tuple[str, DeferredFigure]:
    """Return the material section and the figure for a table."""
    if "force" in table and "approach" in table:
        return _from_indentation(table, arguments)
    if "position" in table and any(c in table for c in ("deflection", "signal", "force")):
        return _from_tabulated_curve(table, arguments)
    if table.has_varying_temperature:
        return _from_varying_temperature(table, arguments)
    if len(table.sets()) > 1:
        return _from_sets(table, arguments)
    points, measured = measured_columns(table)
    _refuse_idle(fit_kinds.one_set(measured), table, arguments)
    if note := loss_note(measured):
        say(f"{table.source.name}: {note}")
    options = arguments.options(table)
    with _warnings_said(table.located):
        fit = fit_measured(points, measured, weights=arguments.weights, **options)
    put(table.located(repr(fit)))
    fit = with_volume(_with_lines(fit, table), *arguments.volume())
    return material_section(fit), DeferredFigure("fitted_series", fit)


def _from_varying_temperature(table: Table, arguments: FitArguments) -> tuple[str, DeferredFigure]:
    """Find law and shift of a test during which the temperature varied."""
    points, measured = measured_columns(table)
    _refuse_idle(fit_kinds.varying_temperature(measured), table, arguments)
    options, on_clock = arguments.options(table), arguments.on_clock(table["temperature"])
    with _warnings_said(table.located):
        if "compliance" in measured:
            creep, strain = measured["compliance"], arguments.expands
            fit = fit_creep(points, creep, **options, **on_clock, thermal_strain=strain)
        else:
            fit = fit_relaxation(points, measured["modulus"], **options, **on_clock)
    put(table.located(repr(fit)))
    fit = with_volume(_with_lines(fit, table), *arguments.volume())
    assert fit.found_shift is not None
    drawing = DeferredFigure("fitted_series", fit)
    if arguments.temperature is None:
        return material_section(fit), drawing
    wanted = read_kelvin("--temperature", arguments.temperature)
    factor = fit.found_shift.shift.factor(wanted)
    from viscontact.identification.shift_rows import celsius

    put(f"At {celsius(wanted)} all times are {factor:.4g} times as long.")
    law, series = (each.slowed(factor) for each in (fit.law, fit.series))
    moved = dataclasses.replace(fit, law=law, series=series)
    return material_section(moved, temperature=wanted), drawing


def _from_sets(table: Table, arguments: FitArguments) -> tuple[str, DeferredFigure]:
    """Join sets of several temperatures to a master curve; print the shift factors and the fit."""
    # Superposition takes a quarter of a second to import.
    from viscontact.cli.material.shift_table import print_shifts
    from viscontact.identification.shift_rows import celsius, shift_rules

    _refuse_idle(fit_kinds.several_sets(measured_columns(table)[1]), table, arguments)
    options = arguments.options(table)
    reference = None
    if arguments.reference is not None:
        reference = read_kelvin("--reference", arguments.reference)
    with _warnings_said():
        curve = identification.build_master_curve(table, reference, **arguments.superposition())
    rules = shift_rules(curve)
    print_shifts(curve, rules)
    with _warnings_said():
        fit = identification.fit_master_curve(curve, weights=arguments.weights, **options)
    fit = with_volume(fit, *arguments.volume())
    put(f"\nAt {celsius(curve.reference_temperature)}:\n{fit!r}")
    drawing = DeferredFigure("master_curve", curve, fit=fit, rules=rules)
    if arguments.temperature is None:
        return material_section(fit, curve), drawing
    wanted = read_kelvin("--temperature", arguments.temperature)
    factor, raised = curve.shift.factor(wanted), curve.shift.vertical_factor(wanted)
    put(
        f"At {celsius(wanted)} all times are {factor:.4g} times as long and all moduli "
        f"{raised:.4g} times as large (from the table above)."
    )
    law, series = (each.slowed(factor).stiffened(raised) for each in (fit.law, fit.series))
    moved = dataclasses.replace(fit, law=law, series=series)
    return material_section(moved, curve, wanted), drawing


def _from_indentation(table: Table, arguments: FitArguments) -> tuple[str, DeferredFigure]:
    _refuse_idle(fit_kinds.INDENTATION, table, arguments)
    indenter = arguments.indenter_of(table.source.name)
    record = IndentationRecord(indenter, table["time"], table["approach"], table["force"])
    return _from_record(record, arguments)


def _from_tabulated_curve(table: Table, arguments: FitArguments) -> tuple[str, DeferredFigure]:
    is_voltage = "signal" in table
    kind = fit_kinds.VOLTAGE_CURVE if is_voltage else fit_kinds.FORCE_CURVE
    _refuse_idle(kind, table, arguments)
    indenter = arguments.indenter_of(table.source.name)
    return _from_force_curve(arguments.force_curve(table), indenter, arguments)


def _from_force_curve(
    curve: ForceCurve, indenter: Indenter, arguments: FitArguments
) -> tuple[str, DeferredFigure]:
    """Fit adhesion, or find the contact point, print it, and fit a law to the indentation."""
    if arguments.adhesion:
        with _warnings_said():
            fit = arguments.adhering(curve, indenter)
        put(repr(fit))
        return identification.adhesive_sections(fit), DeferredFigure("fitted_adhesion", fit)
    contact = (
        find_contact(curve, indenter)
        if arguments.reach is None
        else find_contact(curve, indenter, reach=arguments.reach)
    )
    put(repr(contact))
    return _from_record(contact.record(), arguments)


def _from_record(record: IndentationRecord, arguments: FitArguments) -> tuple[str, DeferredFigure]:
    with _warnings_said():
        fit = arguments.fitted(record)
    put(repr(fit))
    return material_section(fit), DeferredFigure("fitted_indentation", fit)


def _refuse_idle(kind: Kind, table: Table, arguments: FitArguments) -> None:
    """Refuse options that do not apply to a table of a kind."""
    kind.refuse_idle(table.source.name, arguments.given, table.contents)


@contextmanager
def _warnings_said(worded: Callable[[Exception | str], str] = str) -> Iterator[None]:
    """Print warnings about the accuracy of a fit."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", AccuracyWarning)
        yield
    for warning in caught:
        say(f"warning: {worded(warning.message)}")


def _read_table(file: Path, arguments: FitArguments) -> Table:
    try:
        stress = read_stress(arguments.stress)
        return read_table(file, arguments.columns, stress=stress, wanted=_FITTED)
    except (ValueError, OSError) as error:
        refuse(as_option(str(error)))


def _with_lines(fit: Fit, table: Table) -> Fit:
    """Return the fit with lines of the table in the message of its misfit."""
    if fit.misfit is None:
        return fit
    misfit = dataclasses.replace(fit.misfit, message=table.located(fit.misfit.message))
    return dataclasses.replace(fit, misfit=misfit)


def write_section(path: Path, text: str) -> None:
    """Write a section of a case, and print the name of its file."""
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        refuse(f"{path}: {error.strerror or error}")
    put(path)


def draw_fit(drawing: DeferredFigure, output: Path, width: str | float | None) -> None:
    """Save a figure, and print the name of its file."""
    try:
        drawing.save(output, width)
    except (ValueError, OSError) as error:
        refuse(f"{output}: {error}")
    put(output)
