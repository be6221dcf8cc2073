"""Contacts of a body in steady motion at one speed or a curve of speeds: `steady`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import xarray as xr
from numpy.typing import ArrayLike

from viscontact.bodies.adhesion import Adhesion
from viscontact.bodies.friction import Friction
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.steady_motion import steady_motion
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.problem_from_arguments import contact_problem
from viscontact.runs.coupled_creepages import at_each_creepage, over_creepages
from viscontact.runs.over_speed import OverSpeed
from viscontact.runs.solving import solve
from viscontact.simulation.steady_motion.preparation import prepare
from viscontact.simulation.steady_motion.problem import steady_problem
from viscontact.simulation.transient.progress_bar import ProgressBar, reported
from viscontact.simulation.transient.state_generator import Progress


def steady(  # noqa: PLR0913
    indenter: Indenter,
    material: Material | Layered,
    load: LoadHistory,
    speed: ArrayLike,
    *,
    along: Literal["x", "y"] = "y",
    rolling: bool | None = None,
    grid: Grid | AutomaticGrid | None = None,
    indenter_material: Material | Layered | None = None,
    tolerance: float = 1e-6,
    fields: Literal["all", "none"] | Sequence[float] = "all",
    threads: int = 1,
    progress: Progress | bool | None = None,
    errors: bool = True,
    temperature: TemperatureHistory | float | None = None,
    adhesion: Adhesion | None = None,
    friction: Friction | float | None = None,
    creepage: ArrayLike | None = None,
    lateral_creepage: float | None = None,
    spin: float | None = None,
) -> xr.Dataset:
    """Contact of a body that moves over a creeping half-space or layers at constant speed.

    The steady state is solved for at once, without steps in time, at one speed or at each of a
    curve of speeds. Without friction the body is held back by the loss in the material alone. With
    `friction` and `creepage` it rolls with traction, at each speed under each of the creepages.

    Parameters
    ----------
    indenter : Indenter
        Shape of the moving body.
    material : Material or Layered
        Material of the half-space, or a body of layers.
    load : LoadHistory
        Constant load, such as ``step(force)``. Give the tilt along the motion (``tilt_y=0.0``) for
        a body on an axle; if it is left out, the body turns until that moment vanishes.
    speed : float or array_like
        Speeds towards +x or +y, each positive [m/s].
    along : {"x", "y"}, optional
        Axis of the motion; a roller rolls along y.
    rolling : bool, optional
        True if the body rolls, so that its own material flows through the contact as well; false if
        it slides. Needed if the indenter's material is viscoelastic.
    grid : Grid or AutomaticGrid, optional
        Cells that carry the pressure, in coordinates relative to the body's axis, or requirements
        on cells that the run chooses; chosen by the run as well when left out, for each speed. A
        grid that is periodic across the motion holds a line contact, whose approach has no datum;
        one that is periodic along both axes holds a body that repeats.
    indenter_material : Material or Layered, optional
        Material of the indenter, such as a covered roll; rigid when left out.
    tolerance : float, optional
        Relative error of gap and balances at every speed.
    fields : {"all", "none"} or sequence of float, optional
        Speeds [m/s] whose pressure, gap and displacement are kept: all on the dimension
        ``speed``, some on ``field_speed``.
    threads : int, optional
        Threads of one Fourier transform.
    progress : bool or callable, optional
        True: show a bar on stderr. A function is called with (state, done, total) after each
        speed, in their order.
    errors : bool, optional
        Estimate the errors of the scalars, ``friction_coefficient_error`` and so on, from a
        contact on a coarser grid.
    temperature : float, optional
        Constant temperature of the bodies [K], to which the shifts of their materials take the
        laws; when left out, laws are used as they are.
    adhesion : Adhesion, optional
        Not supported in steady motion, and refused; leave it out.
    friction : Friction or float, optional
        Coulomb friction under a body that rolls, or its coefficient; it needs a `creepage`.
    creepage : float or array_like, optional
        Surface speed of the body over its travel, less 1, or several, each between -1 and 1:
        positive where the body drives, and pushes the half-space backwards; negative where it
        brakes.
    lateral_creepage : float, optional
        Beside the creepage, which may be 0, the speed of the body's surface across its travel over
        that, as of a wheel that is askew: positive to the right of the travel, which is +x for one
        towards +y, and the half-space is pushed there. Not of coupled bodies.
    spin : float, optional
        Beside the creepage, which may be 0, the rotation of the body's surface about its axis over
        the travel, from x to y, as of a wheel with camber: the sine of its angle over its radius
        [rad/m]. Not of coupled bodies, nor of those without end.

    Returns
    -------
    xarray.Dataset
        Scalars over ``speed``, in the order given, and fields over (speed or field_speed, x, y), in
        SI units, each with ``units`` and ``long_name``; the case, warnings and tolerance as
        attributes. ``x`` and ``y`` are relative to the body's axis. ``resistance_x`` and
        ``resistance_y`` are forces of the half-space against +x and +y, ``friction_coefficient`` is
        the resistance over the force, and ``dissipation`` the power lost.

        Under friction there is the dimension ``creepage``. Over (speed, creepage) are
        ``tangential_force_x`` and ``tangential_force_y`` [N], the forces of the body on the
        half-space; ``drive_torque`` [N m], their moment that the drive balances; ``stick_area``
        [m²], ``slip_fraction``, ``friction_power`` [W], the heat of friction, and
        ``traction_dissipation`` [W], the power lost in the bodies under the tractions, beside
        ``dissipation`` under the pressure; over (speed or field_speed, creepage, x, y)
        ``traction_x``, ``traction_y``, ``slip_x``, ``slip_y``, ``slip_state`` and
        ``friction_work``. Of coupled bodies under several creepages, each of which has a pressure
        of its own, all that is over the speed is over ``creepage``, too;
        ``ds.viscontact.at_creepage(0.01)`` is the result at one of them, which figures take.

        On chosen grids the fields of all speeds are on the smallest grid that holds their grids;
        beyond its own, pressure is 0, and gap and displacement are NaN. On a fluid the approach is
        NaN: it grows without limit with the distance travelled, and the displacement holds an
        unknown constant. A line contact on a fluid has no steady state and is refused.

    Raises
    ------
    ValueError
        If an argument is invalid, or there is no steady state; the message says what to change.
    ConvergenceError, DomainError
        If a contact is not found, or reaches the edge of a given grid; ``partial`` holds the speeds
        before that one as a dataset, or None.

    Warns
    -----
    AccuracyWarning
        If the result is less accurate than expected; kept in the attribute ``warnings``.

    See Also
    --------
    simulate : Contact over time.

    Notes
    -----
    The displacement is u = J0 q + Σ Ji ∫ exp(-z/li) q(ξ + z) dz/li, with the deflection q of an
    elastic half-space of unit compliance under the same pressure, and the retardation lengths
    li = speed times retardation time (Hunter 1961); of layers it is the sum of a few such terms.
    The resistance is ∫ p (∂h/∂ξ) dA, or the power of the dashpots over the speed, whichever is the
    more accurate; their difference is part of its error.

    Tractions displace the surface along itself in the same way. Where the surface sticks its
    displacement grows backwards by the creepage times the way, from the leading edge on; it slips
    where this would take more than friction times the pressure (Carter 1926). Where pressure and
    tractions are coupled (two bodies that differ, not of Poisson's ratio 1/2) they are solved
    together, of half-spaces, with a pressure of its own at each creepage (Bufler 1959); of layers
    ``Friction(..., coupling=False)`` neglects it.

    References
    ----------
    S. C. Hunter, J. Appl. Mech. 28 (1961) 611; I. G. Goryacheva, *Contact Mechanics in Tribology*,
    Kluwer 1998, chapter 6; F. W. Carter, Proc. R. Soc. Lond. A 112 (1926) 151; H.
    Bufler, Ing.-Arch. 28 (1959) 157.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Zener(9e6, 1e6, 1e4), poisson_ratio=0.5)
    >>> ball, load = vc.Paraboloid(0.01, 0.01), vc.step(1.0, tilt_x=0.0, tilt_y=0.0)
    >>> ds = vc.steady(ball, rubber, load, [0.001, 0.1, 10.0])
    >>> ds.friction_coefficient.values.round(4).tolist()
    [0.0009, 0.0476, 0.0025]

    The same ball drives, with a surface speed that is 0.5 or 5 % above its travel:

    >>> ds = vc.steady(ball, rubber, load, 0.1, friction=0.5, creepage=[0.005, 0.05])
    >>> ds.tangential_force_y.values.round(2).tolist()
    [[-0.07, -0.45]]
    """
    report = reported(progress, ProgressBar("speed"))
    motion = steady_motion(speed, along, rolling, creepage, lateral_creepage, spin)
    contact = contact_problem(
        indenter=indenter,
        material=material,
        load=load,
        grid=grid,
        indenter_material=indenter_material,
        tolerance=tolerance,
        fields=fields,
        motion=motion,
        temperature=temperature,
        adhesion=adhesion,
        friction=friction,
    )
    setup = prepare(steady_problem(contact, motion), threads)
    if not setup.problem.has_several_pressures:
        return solve(OverSpeed(setup, errors), report)
    parts = []
    for each in at_each_creepage(setup):
        parts.append(solve(OverSpeed(each, errors), report))  # warns as from here
    return over_creepages(setup, parts)
