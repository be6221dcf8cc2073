"""Trials of a design, its trade-offs, and profiles of a roller."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np
import xarray as xr

from viscontact.backend.arrays import Bools, Floats
from viscontact.drawing.content.key_axis import key_axis, places_on
from viscontact.drawing.content.panel import (
    FIRST,
    PALE,
    TEXT,
    Axis,
    Curve,
    Ink,
    Mark,
    MarkLook,
    Panel,
)
from viscontact.results.variables import SCALARS, error_name
from viscontact.units.formatting import readable_unit
from viscontact.units.parsing import parse_any_quantity

#: Largest drop that is drawn, as a multiple of that of most of the line: this part of its length.
_MOST, _INNER = 4.0, 0.9


def parameters_of(table: xr.Dataset) -> list[str]:
    """Keys of the parameters of a design."""
    return [str(name) for name in table.coords if name not in ("trial", "scenario")]


def shown_scalars(table: xr.Dataset) -> list[str]:
    """Scalars of a design: its goals, and where those are parameters, also those of constraints."""
    goals = str(table.attrs["goal"]).split()
    bounded = [text.split()[0] for text in constraints_of(table)]
    wanted = [*goals, *bounded] if any(goal in table.coords for goal in goals) else goals
    return [name for name in dict.fromkeys(wanted) if name in table.data_vars]


def constraints_of(table: xr.Dataset) -> list[str]:
    """Constraints of a design, as ``peak_pressure <= 1.2 MPa``."""
    return [text for text in str(table.attrs.get("constraints", "")).split("; ") if text]


def trial_panels(table: xr.Dataset, scalar: str | None = None) -> list[Panel]:
    """Panels of a scalar over each parameter: by default the first goal, or what bounds it."""
    name = scalar or shown_scalars(table)[0]
    if name not in table.data_vars:
        known = ", ".join(shown_scalars(table))
        raise ValueError(f"trials: scalar: the table has no {name!r}; its scalars are {known}")
    y, values, errors = _scalar(table, name)
    bounds = tuple(_bounds_of(table, name))
    feasible, is_coarse = table["feasible"].values.astype(bool), table["level"].values == "coarse"
    best = np.arange(values.size) == int(table.attrs["best"])
    groups: tuple[tuple[Bools, str, Ink, MarkLook], ...] = (
        (feasible & is_coarse, "coarse cells", PALE, "points"),
        (feasible & ~is_coarse, "cells of the case", FIRST, "points"),
        (~feasible, "not feasible", PALE, "cross"),
        (best, "best", TEXT, "square"),
    )
    panels = []
    for key in parameters_of(table):
        x = key_axis(table, key)
        places = places_on(x, table[key].values)
        curves = (
            Curve(
                *(places[chosen], values[chosen], name, ink, look),
                error=errors[chosen] if ink is FIRST else None,
            )
            for chosen, name, ink, look in groups
            if chosen.any()
        )
        panels.append(Panel(x, y, tuple(curves), marks=bounds))
    return panels


def _bounds_of(table: xr.Dataset, name: str) -> Iterator[Mark]:
    """Lines at the bounds of a scalar."""
    for text in constraints_of(table):
        scalar, sign, bound = text.split(maxsplit=2)
        if scalar == name:
            words = f"{'at most' if sign == '<=' else 'at least'} {bound}"
            yield Mark(parse_any_quantity(bound)[0], "y", words, "dashed")


def trade_off_panels(table: xr.Dataset) -> list[Panel]:
    """Panels of each pair of the goals: what is not dominated, the rest, and the compromise."""
    pairs = list(combinations(str(table.attrs["goal"]).split(), 2))
    front = table["on_front"].values.astype(bool)
    others = np.flatnonzero(table["feasible"].values & (table["level"].values == "case") & ~front)
    panels = []
    for names in pairs:
        (x, along, error_x), (y, up, error) = (_scalar(table, name) for name in names)
        best, rows = [int(table.attrs["best"])], np.flatnonzero(front)[np.argsort(along[front])]
        look: MarkLook = "joined" if len(pairs) == 1 else "points"
        curves = [
            Curve(along[rows], up[rows], "not dominated", FIRST, look, error[rows], error_x[rows]),
            Curve(along[best], up[best], "compromise", TEXT, "square"),
        ]
        if others.size:
            curves.insert(0, Curve(along[others], up[others], "dominated", PALE, "points"))
        panels.append(Panel(x, y, tuple(curves)))
    return panels


def _scalar(table: xr.Dataset, name: str) -> tuple[Axis, Floats, Floats]:
    """Axis of a scalar or of a parameter, its values and their errors."""
    values = table[name].values
    if name in table.coords:
        return key_axis(table, name), values, np.zeros(values.size)
    axis = Axis.of(SCALARS[name].label, SCALARS[name].units, values)
    return axis, values, table[error_name(name)].values


def profile_panel(table: xr.Dataset) -> Panel:
    """Panel of drops over the position along a roller, without what is steep next to its ends."""
    x, drops = table["x"].values, table["drop"].transpose("profile", "x").values
    inner = drops[:, np.abs(x) <= _INNER * np.abs(x).max()]
    deepest = min(_MOST * float(np.nanmax(inner, initial=0.0)), float(np.nanmax(drops)))
    limits = (-0.05 * deepest, deepest) if deepest > 0 else None
    return Panel(
        Axis.of("x", "m", x),
        Axis("Drop", readable_unit("m", deepest or 1e-6), limits, is_reversed=True),
        tuple(
            Curve(x, drop, name, Ink(place=number), "bold" if name == "free" else "line")
            for number, (name, drop) in enumerate(
                zip(table["profile"].values.tolist(), drops, strict=True)
            )
        ),
    )
