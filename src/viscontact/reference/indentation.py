"""Axisymmetric viscoelastic contact under an arbitrary load history, for circular contact areas."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.reference.axisymmetric_contact import AxisymmetricContact
from viscontact.reference.hereditary import TimeFunction
from viscontact.reference.indentation_march import (
    LagCompliance,
    LoadSteps,
    OutgrownError,
    StepEnd,
    deepest_approach,
    load_steps,
    march,
)
from viscontact.reference.lag_means import instant_compliance, lag_mean
from viscontact.reference.profiles import Profile
from viscontact.reference.rods import Rods, placed_rods
from viscontact.units.numbers import real_array

_COARSE_ELEMENTS = 24  # of a first solution that finds the largest approach under a force


def press_axisymmetric(
    profile: Profile,
    times: ArrayLike,
    *,
    approach: ArrayLike | None = None,
    force: ArrayLike | None = None,
    creep_compliance: TimeFunction,
    elements: int = 200,
    substeps: int = 1,
) -> AxisymmetricContact:
    """Press a round indenter on a viscoelastic half-space by any history of approach or force.

    Loading, holding, unloading, loss of contact, recovery of the surface and renewed contact, in
    any order, as long as the contact is one full circle.

    Parameters
    ----------
    profile : SphereProfile, ConeProfile or PunchProfile
        The indenter.
    times : array_like, shape (n,)
        Instants of the history; a repeated one is a jump. Before the first there is no
        contact, and the indenter just touches: a first value other than 0 is a jump [s].
    approach : array_like, shape (n,), optional
        Approach at those instants and linear in between; negative when drawn back [m].
    force : array_like, shape (n,), optional
        Force instead, 0 or more [N]. Exactly one of the two.
    creep_compliance : callable
        Contact compliance J(t), taking an array of times [s], in the place of 1/E* [1/Pa]. Its
        method ``mean(start, end)``, the mean over lags, is used where it has one.
    elements : int, optional
        Elements between the axis and the largest contact radius.
    substeps : int, optional
        Equal steps that each interval of `times` is cut into.

    Returns
    -------
    AxisymmetricContact
        Force, approach and contact radius at `times`, the instants where contact was made and
        lost, pressure and displacement.

    Raises
    ------
    ValueError
        If times, histories or numbers are inconsistent, if the load jumps where J(0) = 0, or if
        the contact is found to be a ring, by steps too long for the law or otherwise.

    Notes
    -----
    The displacement u = integral of J(t - t') d(Kp), Kp = (1/π) integral of p/r, separates in
    the transform χ(s) = 2 integral of r p(r)/sqrt(r² - s²) over r > s of the pressure (Green
    and Collins; Sneddon 1965). Its inverse, p(r) = -(1/π) integral of χ'(s)/sqrt(s² - r²) over
    s > r, vanishes outside the circle with χ; F = 2 integral of χ over s > 0. The
    displacement is u(r) = (2/π) integral of v(s)/sqrt(r² - s²) over s < r, where for each s by
    itself v(s, t) = integral of J(t - t') dχ(s, t'). Under the indenter u = w - f(r) is
    v = w - g(s), g(s) = s integral of f'(r)/sqrt(s² - r²) over r < s. Outside χ = 0 and
    v >= w - g, with which u >= w - f. A smooth edge carries no infinite pressure: χ(a) = 0. So
    an s loses contact when its χ falls to 0, and takes it when w - g(s) meets its own recovery.
    During first loading χ(s, t) = integral of M(t - t') dw(t') from t_s, where w = g(s), to t;
    that it falls to 0 is Ting's equation for t_1 = t_s.

    Each s is a scalar Volterra equation. The transform is linear in time within a step, with the
    instants of contact and loss found inside it, and linear in g(s) between the elements' ends: on
    an elastic body the force is exact, otherwise the error is of second order in both. Under a
    rising force the approach begins like t^(2/3), and ends so under a falling one, which evenly
    spaced `times` follow with order 5/3 only: see `clustered_times`. With J(0) = 0, J like t^n,
    the order in time is 2 - n. Steps must resolve the law: where J grows by many times J(0)
    within one, linear χ may ring; `resolution_error` shows it.

    References
    ----------
    S. C. Hunter, J. Mech. Phys. Solids 8 (1960) 219-234;
    G. A. C. Graham, Int. J. Eng. Sci. 3 (1965) 27-46 and 5 (1967) 495-514;
    I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47-57;
    T. C. T. Ting, J. Appl. Mech. 33 (1966) 845-854.

    Examples
    --------
    A sphere on a Maxwell body, in and out at constant speed: contact is lost at
    t = ln(2 e - 1) relaxation times (Ting), long before the unloading ends.

    >>> from viscontact.reference.profiles import SphereProfile
    >>> contact = press_axisymmetric(
    ...     SphereProfile(0.01), np.linspace(0, 2, 101), creep_compliance=lambda t: (1 + t) / 2e9,
    ...     approach=1e-5 * np.minimum(np.linspace(0, 2, 101), np.linspace(2, 0, 101)))
    >>> print(f"{contact.lost[0]:.4f} s, exactly {np.log(2 * np.e - 1):.4f} s")
    1.4899 s, exactly 1.4899 s
    """
    if (approach is None) == (force is None):
        raise ValueError("press_axisymmetric: wanted either approach= or force=, not both or none")
    instants = real_array("times", times, "s")
    controlled: Literal["approach", "force"] = "force" if approach is None else "approach"
    given, unit = (force, "N") if approach is None else (approach, "m")
    load = real_array(controlled, given, unit)
    _require_history(instants, load, controlled)
    _require_counts(elements=elements, substeps=substeps)
    steps = load_steps(instants, load, by_approach=approach is not None, substeps=substeps)
    law = LagCompliance(lag_mean(creep_compliance), instant_compliance(creep_compliance))
    rods, results = _march(profile, steps, law, elements)
    kept = [results[k] for k in steps.given]
    radii = profile.reach(np.array([result.state.front for result in kept]))
    return AxisymmetricContact(
        profile=profile,
        creep_compliance=creep_compliance,
        controlled=controlled,
        elements=elements,
        substeps=substeps,
        times=instants,
        force=np.array([result.state.force for result in kept]),
        approach=np.array([result.state.approach for result in kept]),
        contact_radius=np.where([result.state.reached > 0 for result in kept], radii, 0.0),
        work=np.cumsum([result.work for result in results])[steps.given],
        touched=np.array([result.touched for result in results if result.touched is not None]),
        lost=np.array([result.lost for result in results if result.lost is not None]),
        places=rods.places,
        transformed_pressure=np.array([result.state.chi for result in kept]),
        transformed_displacement=np.array([result.displacement for result in kept]),
    )


def _march(
    profile: Profile, steps: LoadSteps, law: LagCompliance, elements: int
) -> tuple[Rods, list[StepEnd]]:
    """Solve with elements whose range covers the largest contact radius."""
    deepest = deepest_approach(profile, steps, law)
    if not steps.by_approach and elements > _COARSE_ELEMENTS:
        _, coarse = _march(profile, steps, law, _COARSE_ELEMENTS)
        deepest = 1.002 * max(result.state.approach for result in coarse) or deepest
    while True:
        rods = placed_rods(profile, deepest, elements)
        try:
            return rods, list(march(rods, steps, law))
        except OutgrownError:
            deepest *= 1.05  # the bound holds for growing contacts only


@dataclass(frozen=True)
class ResolutionError:
    """Largest errors of a contact's history, relative to its largest values.

    Attributes
    ----------
    force, approach, contact_radius : float
        Of each of them [-].

    Examples
    --------
    >>> ResolutionError(force=1e-3, approach=4e-4, contact_radius=2e-3).approach
    0.0004
    """

    force: float
    approach: float
    contact_radius: float


def resolution_error(contact: AxisymmetricContact) -> ResolutionError:
    """Estimate the error of an indentation from a second solution, twice as fine.

    Parameters
    ----------
    contact : AxisymmetricContact
        From `press_axisymmetric`.

    Returns
    -------
    ResolutionError
        4/3 of the largest differences of force, approach and contact radius between the two,
        relative to the largest values: what is left if the order is two.

    Examples
    --------
    >>> from viscontact.reference.profiles import SphereProfile
    >>> contact = press_axisymmetric(
    ...     SphereProfile(0.01), [0.0, 0.5, 1.0], approach=[0.0, 1e-5, 2e-5],
    ...     creep_compliance=lambda t: (1 + t) / 2e9, substeps=10, elements=20)
    >>> resolution_error(contact).force < 2e-3
    True
    """
    load = {contact.controlled: getattr(contact, contact.controlled)}
    finer = press_axisymmetric(
        contact.profile,
        contact.times,
        creep_compliance=contact.creep_compliance,
        elements=2 * contact.elements,
        substeps=2 * contact.substeps,
        **load,
    )

    def error(name: str) -> float:
        ours, theirs = getattr(contact, name), getattr(finer, name)
        largest = float(np.abs(theirs).max())
        return 4 / 3 * float(np.abs(ours - theirs).max()) / largest if largest > 0 else 0.0

    return ResolutionError(error("force"), error("approach"), error("contact_radius"))


def clustered_times(corners: ArrayLike, count: int) -> Floats:
    """Times between the corners of a history, clustered towards each corner.

    Parameters
    ----------
    corners : array_like, shape (n,)
        Instants where the load begins, ends or changes its rate, ascending [s].
    count : int
        Intervals between neighbouring corners.

    Returns
    -------
    ndarray, shape ((n - 1) count + 1,)
        The instants; near a corner their distance from it is proportional to the third power of
        their number, which makes the approach t^(2/3) under a rising force a smooth function [s].

    Examples
    --------
    >>> clustered_times([0.0, 1.0], 4).round(6).tolist()
    [0.0, 0.103516, 0.5, 0.896484, 1.0]
    """
    ends = real_array("corners", corners, "s")
    x = np.arange(count) / count
    placed = x**3 * (10 - 15 * x + 6 * x**2)  # the quintic with three flat derivatives at each end
    between = ends[:-1, None] + np.diff(ends)[:, None] * placed
    return np.append(between.ravel(), ends[-1])


def _require_history(times: Floats, load: Floats, controlled: str) -> None:
    """Check the times and the load history."""
    if times.ndim != 1 or times.size == 0 or not np.all(np.isfinite(times)):
        raise ValueError("times: wanted finite instants [s], one or more, in one dimension")
    backwards = np.flatnonzero(np.diff(times) < 0)
    if backwards.size:
        k = int(backwards[0])
        raise ValueError(
            f"times: wanted ascending instants, got {times[k + 1]!r} s after {times[k]!r} s "
            f"(entry {k + 1}); sort the history"
        )
    if load.shape != times.shape or not np.all(np.isfinite(load)):
        raise ValueError(
            f"{controlled}: wanted a finite value for each of {times.size} times, got shape "
            f"{load.shape} with {int(np.sum(~np.isfinite(load)))} values not finite"
        )
    if controlled == "force" and load.min() < 0:
        k = int(np.argmin(load))
        raise ValueError(
            f"force: wanted 0 N or more, got {load[k]!r} N at t = {times[k]!r} s; nothing adheres"
        )


def _require_counts(**counts: int) -> None:
    """Check that counts are at least 1."""
    for name, count in counts.items():
        if count < 1:
            raise ValueError(f"{name}: wanted 1 or more, got {count!r}")
