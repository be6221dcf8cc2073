"""Simulate one contact: `simulate`."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Literal

import xarray as xr
from numpy.typing import ArrayLike

from viscontact.bodies.adhesion import Adhesion
from viscontact.bodies.friction import Friction
from viscontact.bodies.grid import AutomaticGrid, Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadHistory, LoadProgram
from viscontact.bodies.loads.motion import Motion
from viscontact.bodies.loads.tangential import TangentialLoad
from viscontact.bodies.loads.temperature import TemperatureHistory
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.problem_from_arguments import contact_problem
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.runs.over_time import OverTime
from viscontact.runs.solving import solve
from viscontact.simulation.checks.problem_checks import unusual_radius
from viscontact.simulation.transient.found_events import carried_out
from viscontact.simulation.transient.progress_bar import ProgressBar, reported
from viscontact.simulation.transient.setup import prepare_run
from viscontact.simulation.transient.state_generator import Progress


def simulate(  # noqa: PLR0913
    indenter: Indenter,
    material: Material | Layered | Body,
    load: LoadHistory | LoadProgram,
    grid: Grid | AutomaticGrid | None = None,
    times: ArrayLike | AdaptiveTimes | None = None,
    *,
    indenter_material: Material | Layered | Body | None = None,
    tolerance: float = 1e-6,
    fields: Literal["all", "none"] | Sequence[float] = "all",
    threads: int = 1,
    progress: Progress | bool | None = None,
    errors: bool = True,
    motion: Motion | None = None,
    temperature: TemperatureHistory | float | None = None,
    friction: Friction | float | None = None,
    tangential: TangentialLoad | None = None,
    adhesion: Adhesion | None = None,
) -> xr.Dataset:
    """Simulate an indenter pressed on a creeping half-space, and return its contact over time.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body. A measured `Surface`, or a map of SurfaceTopography, is taken as
        well, and pressed as it is: level it before.
    material : Material or Layered
        Material of the half-space, or a body of layers.
    load : LoadHistory or LoadProgram
        Force or approach, eccentricity and prescribed tilts over time. A program, whose segments
        may end on conditions, is carried out once to find their instants; it needs times.
    grid : Grid or AutomaticGrid, optional
        Cells that carry the pressure, or requirements on cells that the run chooses; chosen by
        the run as well when left out.
    times : array_like or AdaptiveTimes, optional
        Instants of the result, strictly increasing, none before 0 [s]; chosen from load and
        law when left out. With `adaptive_times` the run chooses its steps, and ``time`` holds
        the instants at which they end.
    indenter_material : Material or Layered, optional
        Material of the indenter; rigid when left out.
    tolerance : float, optional
        Relative error of gap and balances at every instant.
    fields : {"all", "none"} or sequence of float, optional
        Instants [s] whose pressure, gap and displacement are kept: all on the dimension
        ``time``, some on ``field_time``.
    threads : int, optional
        Threads of one Fourier transform.
    progress : bool or callable, optional
        True: show a bar on stderr, in a notebook below the cell. A function is called with (state,
        done, total) after each instant.
    errors : bool, optional
        Estimate the errors of the scalars, ``peak_pressure_error`` and so on, from two
        coarser runs, which take about a third of the run's own time.
    motion : Travel or Reciprocation, optional
        Motion of the body over the surface, see `Travel` and `reciprocating`; at rest when left
        out. The grid is fixed to the surface; an automatic one covers the path.
    temperature : TemperatureHistory or float, optional
        Temperature of the bodies over time, or a constant one [K]. Laws hold at the reference
        temperatures of the shifts of their materials, and creep on the clocks that these make of
        the time; when left out, laws are used as they are.
    friction : Friction or float, optional
        Friction between the bodies, or its coefficient; it needs a tangential load. The bodies are
        frictionless when left out.
    tangential : TangentialHistory or TangentialHarmonic, optional
        Load along the surface: forces and a torque, or shifts and a rotation.
    adhesion : Adhesion, optional
        Work of adhesion between the bodies, its range and law. The run then chooses its steps by
        the change of the force, also between given times. The bodies do not attract each other when
        left out.

    Returns
    -------
    xarray.Dataset
        Scalars over ``time``, fields over (time or field_time, x, y), all in SI units, each
        with ``units`` and ``long_name``; the case, warnings and tolerance as attributes.

        Where errors are estimated, each scalar has a variable ``<name>_error`` over ``time``, in
        the scalar's unit: the half width of an error bar, which 95 of 100 true errors do not
        exceed. It is inf for a peak pressure without a limit (at a sharp edge or point), NaN
        where the error is unknown, 0 for a scalar that is zero without contact, and about three
        times `tolerance` for a prescribed quantity.

        If the run has enlarged its grid, the fields are on the last grid: outside the grid of an
        earlier instant, pressure is 0 and gap and displacement are NaN. The attribute
        ``grid_enlarged`` lists the times of enlargement.

    Raises
    ------
    ValueError
        If an argument is invalid; the message says what to change.
    ConvergenceError, DomainError
        If the run stops; ``partial`` holds the completed steps as a dataset.

    Warns
    -----
    AccuracyWarning
        If the result is less accurate than expected; kept in the attribute ``warnings``.
    UserWarning
        If the radius of a sphere or a roller is 2 m or more, as if it were meant in millimetres.

    See Also
    --------
    march : Generator of the states of a run, one after the other.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Zener(1e6, 1e6, 1e6), poisson_ratio=0.5)
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), times=vc.uniform_times(5.0, 20))
    >>> round(float(ds.approach[-1] / ds.approach[0]), 2)  # (J(5 s)/J(0))**(2/3)
    1.58
    """
    report = reported(progress, ProgressBar("step", "errors" if errors else ""))
    problem = contact_problem(
        indenter=indenter,
        material=material,
        load=load,
        grid=grid,
        times=times,
        indenter_material=indenter_material,
        tolerance=tolerance,
        fields=fields,
        motion=motion,
        temperature=temperature,
        friction=friction,
        tangential=tangential,
        adhesion=adhesion,
    )
    problem = carried_out(problem, threads)
    if text := unusual_radius(indenter):
        warnings.warn(text, UserWarning, stacklevel=2)
    return solve(OverTime(prepare_run(problem, threads), errors), report)
