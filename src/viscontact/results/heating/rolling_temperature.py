"""Temperatures that a rolling body takes by its own loss: `rolling_temperature`."""

from __future__ import annotations

import warnings

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.errors import AccuracyWarning
from viscontact.bodies.loads.steady_motion import checked_speeds
from viscontact.results.heating.balances import (
    Balance,
    Sink,
    balance_line,
    balances_at,
    reach_of,
    runaway,
)
from viscontact.results.heating.heat_arguments import HeatArguments
from viscontact.results.heating.heat_notes import across_note, general_notes, reach_notes
from viscontact.results.heating.heat_table import heat_table, with_heating
from viscontact.results.heating.power_curve import PowerCurve
from viscontact.results.heating.result import RollingTemperature
from viscontact.results.heating.rolling_body import RollingBody


def rolling_temperature(  # noqa: PLR0913
    curve: xr.Dataset,
    *,
    cooling: float,
    ambient: float,
    area: float | None = None,
    speed: ArrayLike | None = None,
    conductivity: float | None = None,
    core_temperature: float | None = None,
    heat_capacity: float | None = None,
    density: float | None = None,
    thickness: float | None = None,
) -> RollingTemperature:
    """Find the temperatures at which a rolling body gives off the heat of its own loss.

    No contact is solved: a curve over speed at one temperature has the power at all temperatures,
    if all that creeps has one time-temperature shift.

    Parameters
    ----------
    curve : xarray.Dataset
        Result of `steady`, or of a case in steady motion, at four speeds or more. The materials
        that creep must have a shift.
    cooling : float
        Heat transfer coefficient of the surface [W/(m² K)].
    ambient : float
        Temperature of the surroundings [K].
    area : float, optional
        Cooled area of the length that the force of the curve acts on [m²]. For a covered roll
        (``indenter_material``, ``rolling=True``) by default its circumference times its length.
    speed : array_like, optional
        Speeds [m/s]; by default those of the curve.
    conductivity : float, optional
        Thermal conductivity of the cover [W/(m K)]. The temperature then varies through the cover;
        without it, it is uniform.
    core_temperature : float, optional
        Temperature of the core below the cover [K]; None: no heat flows into the core.
    heat_capacity, density : float, optional
        Of the cover [J/(kg K)], [kg/m³], for the heating over time.
    thickness : float, optional
        Of the cover [m]; by default that of the layers in the case.

    Returns
    -------
    RollingTemperature
        All balances at each speed, whether they are stable, and the speed of thermal runaway.

    Raises
    ------
    ValueError
        If an argument is invalid, a material that creeps has no shift or two of them differ, or the
        curve reaches no balance at any speed; the message says what to change.

    Warns
    -----
    AccuracyWarning
        Where a balance may lie beyond the curve, and for what is left out; kept as `notes`.

    Notes
    -----
    The times of a thermorheologically simple law are multiplied by a_T(T), so that the resistance
    at the speed V and the temperature T is that of the curve at V a_T(T); it is interpolated there,
    and never extrapolated. A balance is P(T) = V R(V a_T(T)) = A (T - T_0)/r, with the temperature
    T_0 at rest and the thermal resistance r, 1/h for a uniform temperature. It is stable where
    dP/dT < A/r. The runaway is at the speed beyond which the coldest balance is gone, where power
    and cooling touch.

    Through the cover, conduction is one-dimensional with a uniform source [1]_; T is the mean over
    the thickness, and r = 1/h + t/(3k) above an insulated core. A vertical shift is left out, and
    its range noted. The heating over time begins at rest.

    References
    ----------
    .. [1] H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 2nd ed., Oxford 1959,
       chapter 3.

    Examples
    --------
    >>> import numpy as np
    >>> import viscontact as vc
    >>> shift = vc.Arrhenius(296.0, 100e3)
    >>> rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5, shift=shift)
    >>> ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    >>> speeds, coarse = np.geomspace(0.1, 2.0, 7), vc.AutomaticGrid(0.04)
    >>> ds = vc.steady(ball, rubber, load, speeds, grid=coarse, errors=False, fields="none")
    >>> found = vc.rolling_temperature(ds, cooling=10.0, ambient=296.0, area=4e-4, speed=[0.5])
    >>> round(float(found.temperature[0, 0]), 1), bool(found.stable[0, 0])
    (302.1, True)
    """
    given = HeatArguments(
        *(cooling, ambient, area, thickness),
        *(conductivity, core_temperature, heat_capacity, density),
    )
    body = RollingBody.of(curve)
    given = given.completed(body)
    speeds = body.curve.speeds if speed is None else np.sort(checked_speeds("speed", speed))
    table = _balanced(body, given, speeds)
    found = RollingTemperature(table)
    for note in found.notes:
        warnings.warn(f"rolling_temperature: {note}", AccuracyWarning, stacklevel=2)
    return found


def _balanced(body: RollingBody, given: HeatArguments, speeds: Floats) -> xr.Dataset:
    """Table of all balances, with the notes on them."""
    curve, cover = body.curve, given.cover
    assert given.area is not None  # completed
    sink = Sink(given.area / cover.resistance, cover.idle)
    try:
        reaches = [reach_of(curve, sink, v) for v in speeds.tolist()]
    except ValueError as error:
        raise ValueError(f"ambient: {error}") from error
    balances = [balances_at(curve, sink, *each) for each in zip(speeds, reaches, strict=True)]
    notes = list(reach_notes(curve, sink, speeds, reaches))
    if not any(balances):
        raise ValueError(f"curve: reaches no balance at any speed: {'; '.join(notes)}")
    line = balance_line(curve, sink, float(speeds.max()))
    found = runaway(curve, sink, line)
    if found is not None:  # both branches are drawn up to there
        place = int(np.searchsorted(line[0], found[1]))
        line = np.insert(line[0], place, found[1]), np.insert(line[1], place, found[0])
    table = heat_table(curve, cover, sink, speeds, balances, reaches, line)
    table = table.assign_attrs(_facts(body, given, found))
    notes += _further_notes(body, given, curve, balances, table)
    if given.is_over_time:
        table = with_heating(table, cover, given.area, curve, reaches)
    return table.assign_attrs(notes="\n".join(notes))


def _further_notes(
    body: RollingBody,
    given: HeatArguments,
    curve: PowerCurve,
    balances: list[list[Balance]],
    table: xr.Dataset,
) -> list[str]:
    stable = np.array([b.temperature for each in balances for b in each if b.is_stable])
    notes = list(general_notes(body, curve, stable))
    if given.conductivity is not None:
        power = table["power"].values[table["stable"].values]
        notes += across_note(given.cover, curve, power / table.attrs["area"])
    return notes


def _facts(
    body: RollingBody, given: HeatArguments, found: tuple[float, float] | None
) -> dict[str, float | str]:
    """Attributes of the table: arguments [SI], and the runaway."""
    numbers = {name: getattr(given, name) for name in given.UNITS}
    speed, temperature = found or (np.nan, np.nan)
    return {
        "title": str(body.results.attrs.get("title") or "Rolling body"),
        **{name: value for name, value in numbers.items() if value is not None},
        "idle_temperature": given.cover.idle,
        "runaway_speed": speed,
        "runaway_temperature": temperature,
    }
