"""Generator of states: `march`, and the same for a run that has been set up."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from typing import Literal

from numpy.typing import ArrayLike

from viscontact.backend.errors import AccuracyWarning
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
from viscontact.mechanics.state import ContactState
from viscontact.mechanics.time_integration.requested_times import AdaptiveTimes
from viscontact.simulation.transient.found_events import carried_out
from viscontact.simulation.transient.march import March
from viscontact.simulation.transient.progress_bar import ProgressBar, reported
from viscontact.simulation.transient.setup import RunSetup, prepare_run

#: Called after each requested state: the state, the number of states done, and of all (with
#: adaptive steps the expected one).
Progress = Callable[[ContactState, int, int], None]


def march(  # noqa: PLR0913
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
    motion: Motion | None = None,
    temperature: TemperatureHistory | float | None = None,
    friction: Friction | float | None = None,
    tangential: TangentialLoad | None = None,
    adhesion: Adhesion | None = None,
) -> Iterator[ContactState]:
    """Simulate an indenter pressed on a creeping half-space, and yield its state at each instant.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    material : Material or Layered
        Material of the half-space, or a body of layers.
    load : LoadHistory or LoadProgram
        Force or approach, eccentricity and prescribed tilts over time. A program, whose segments
        may end on conditions, is carried out once to find their instants; it needs times.
    grid : Grid or AutomaticGrid, optional
        Cells that carry the pressure, or requirements on cells that the run chooses; chosen by
        the run as well when left out.
    times : array_like or AdaptiveTimes, optional
        Instants of the states, strictly increasing, none before 0 [s]; chosen from load and
        law when left out. At a jump the state is the one just after it. With `adaptive_times`
        there is a state for each step that the run chooses, and one at each instant of
        `fields`.
    indenter_material : Material or Layered, optional
        Material of the indenter; rigid when left out.
    tolerance : float, optional
        Relative error of gap and balances at every instant.
    fields : {"all", "none"} or sequence of float, optional
        As in `simulate`, checked but not needed here: states carry their fields.
    threads : int, optional
        Threads of one Fourier transform.
    progress : bool or callable, optional
        True: show a bar on stderr. A function is called with (state, done, total) after each
        instant.
    motion : Travel or Reciprocation, optional
        Motion of the body over the surface, see `Travel` and `reciprocating`; at rest when left
        out. The grid is fixed to the surface; an automatic one covers the whole path.
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
    iterator of ContactState
        All checks of the input are done before it is returned.

    Raises
    ------
    ValueError
        If an argument is invalid, before the first step; the message says what to change.
    ConvergenceError
        If the contact solver stagnates, from the iterator.
    DomainError
        If pressure reaches the outermost cells of a grid that was given, or of one that cannot be
        enlarged any further, or the largest contact has fewer than four cells across; from the
        iterator.

    Notes
    -----
    Steps also end at the load's kinks and jumps. Within a step the pressure is linear in time,
    so the error falls with the square of the step; the paper's piecewise-constant rule (Spinu &
    Cerlinca 2018, eq. 12) is of first order. Over steps long against the law (always, if it is a
    dashpot at first) the pressure rises over a part of the step only, to avoid ringing, and the
    error is of first order; an `AccuracyWarning` reports it where it matters.

    Examples
    --------
    A sphere on an elastic half-space, E* = 4/3 MPa, R = 0.75 m, sinks like Hertz's:

    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6 / 3), poisson_ratio=0.5)
    >>> grid = vc.Grid((40, 40), (0.26, 0.26))
    >>> states = vc.march(vc.Paraboloid(0.75, 0.75), rubber, vc.step(2370.0), grid, [0.0])
    >>> round(next(states).approach, 4)
    0.0133
    """
    report = reported(progress, ProgressBar("step"))
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
    run = prepare_run(carried_out(problem, threads), threads)
    return march_run(run, report)


def march_run(run: RunSetup, progress: Progress | None = None) -> Iterator[ContactState]:
    """Yield the states of a run that has been set up; see `march`."""
    loop = March(run)
    for state in loop:
        if state is None:
            continue
        for text in state.warnings:
            warnings.warn(text, AccuracyWarning, stacklevel=2)
        if progress is not None:
            progress(state, loop.done, loop.done + loop.left)
        yield state
