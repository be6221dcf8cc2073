"""A run, checked: everything that can be refused is refused before the first step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viscontact.checks.arguments import (
    check_balance,
    check_creep,
    check_jumps,
    check_kinds,
    check_magnitudes,
    check_numbers,
    check_touch,
)
from viscontact.checks.periodicity import check_period
from viscontact.contact.domain import mirrored_axes
from viscontact.fourier import fastest_transforms
from viscontact.grid import AutomaticGrid, Grid
from viscontact.indenters import Indenter
from viscontact.loads import LoadHistory
from viscontact.materials.compliance import ContactCompliance
from viscontact.materials.material import Material
from viscontact.meshing.mesh_choice import Mesh, choose_mesh
from viscontact.time_integration.adaptive_steps import AdaptiveSteps, estimated_steps
from viscontact.time_integration.fixed_steps import FixedSteps, plan_steps, step_ends
from viscontact.time_integration.plan import HereditaryPlan, plan_hereditary_integral
from viscontact.time_integration.requested_times import AdaptiveTimes
from viscontact.time_integration.run_times import field_instants, run_instants

#: Adaptive steps that the memory is planned for: at least so many, and so many times those that are
#: likely; more are remembered as well.
ADAPTIVE_STEPS, STEP_COUNT_SAFETY = 500, 3.0

#: Where the steps of a run come from.
Steps = FixedSteps | AdaptiveSteps


@dataclass(frozen=True, eq=False)
class RunSetup:
    """What a run needs, checked and complete.

    Attributes
    ----------
    indenter : Indenter
        Shape of the pressed body.
    material : Material
        Material of the half-space.
    indenter_material : Material or None
        Material of the pressed body; None for a rigid one.
    compliance : ContactCompliance
        J(t) of both bodies together.
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    grid : Grid
        The cells.
    automatic : AutomaticGrid or None
        What was asked of them; None for a grid that was given.
    mesh : Mesh or None
        What is expected of them where they were chosen.
    open_gap : ndarray, shape (nx, ny)
        The indenter's gap on the grid [m], +inf outside its outline.
    times : ndarray
        Instants of the states [s]; those that adaptive steps have to hit, the last their end.
    adaptive : AdaptiveTimes or None
        The wish for steps that the run chooses itself.
    memory : HereditaryPlan
        How the past is remembered.
    tolerance : float
        Relative error of gap and balances.
    threads : int
        Threads of one Fourier transform.
    transforms : str
        Whose they are. Libraries differ in rounding, so a run stays with the one it began with.
    """

    indenter: Indenter
    material: Material
    indenter_material: Material | None
    compliance: ContactCompliance
    load: LoadHistory
    grid: Grid
    automatic: AutomaticGrid | None
    mesh: Mesh | None
    open_gap: NDArray[np.float64]
    times: NDArray[np.float64]
    adaptive: AdaptiveTimes | None
    memory: HereditaryPlan
    tolerance: float
    threads: int
    transforms: str

    @property
    def grows(self) -> bool:
        """Whether the grid may be enlarged when the contact overruns it: who gave none said so."""
        return self.automatic is not None

    @property
    def mirrored(self) -> tuple[bool, bool]:
        """Whether shape and load are even across x = 0, and y = 0: then one half tells all."""
        return _mirrored(self.open_gap, self.load, self.grid)

    @property
    def bodies(self) -> tuple[Material, ...]:
        """The materials of the bodies that give way."""
        both = (self.material, self.indenter_material)
        return tuple(body for body in both if body is not None)

    @property
    def measured_until(self) -> float:
        """Last time on which the laws rest on data [s]; inf for formulas."""
        return min(body.known_until for body in self.bodies)

    def on(self, grid: Grid) -> RunSetup:
        """The same run on another grid."""
        return replace(self, grid=grid, open_gap=_gap_on(self.indenter, grid))

    def steps(self) -> Steps:
        """The run's steps from the start."""
        if self.adaptive is None:
            return FixedSteps(plan_steps(self.times, self.load))
        return AdaptiveSteps(self.adaptive, self.times, self.load, self.compliance)


def prepare_run(
    indenter: Indenter,
    material: Material,
    load: LoadHistory,
    grid: Grid | AutomaticGrid | None = None,
    times: ArrayLike | AdaptiveTimes | None = None,
    *,
    indenter_material: Material | None = None,
    tolerance: float = 1e-6,
    fields: str | Sequence[float] = "all",
    threads: int = 1,
) -> RunSetup:
    """Check and complete the arguments of `march`.

    Parameters
    ----------
    indenter, material, load, grid, times, indenter_material, tolerance, fields, threads
        As in `march`.

    Returns
    -------
    RunSetup
        Ready to be marched.

    Raises
    ------
    ValueError
        If anything in it makes no sense, with a remedy.
    """
    check_kinds(indenter, material, load, grid, indenter_material)
    check_numbers(tolerance, threads)
    compliance = _of_both(material, indenter_material)
    adaptive = times if isinstance(times, AdaptiveTimes) else None
    instants = run_instants(times, fields, load, compliance)
    field_instants(fields, instants)
    _check_course(compliance, load, grid if isinstance(grid, Grid) else None, instants)
    end = float(instants[-1])
    automatic = mesh = None
    if not isinstance(grid, Grid):
        automatic = grid or AutomaticGrid()
        mesh = choose_mesh(indenter, compliance, load, automatic, end)
        grid = mesh.grid
    open_gap = _checked_gap(indenter, compliance, load, grid, end)
    return RunSetup(
        indenter,
        material,
        indenter_material,
        compliance,
        load,
        grid,
        automatic,
        mesh,
        open_gap,
        instants,
        adaptive,
        _hereditary_plan(compliance, load, instants, adaptive, open_gap, grid),
        float(tolerance),
        int(threads),
        fastest_transforms(),
    )


def _of_both(material: Material, indenter_material: Material | None) -> ContactCompliance:
    """J(t) of the bodies that give way."""
    compliance = material.contact_compliance()
    if indenter_material is None:
        return compliance
    return compliance + indenter_material.contact_compliance()


def _check_course(
    compliance: ContactCompliance,
    load: LoadHistory,
    grid: Grid | None,
    instants: NDArray[np.float64],
) -> None:
    """Refuse loads and laws that make no sense over the run's time, on whatever grid."""
    end = float(instants[-1])
    check_magnitudes(compliance, load, grid, end)
    check_creep(compliance, instants)
    check_jumps(compliance, load, end)


def _checked_gap(
    indenter: Indenter, compliance: ContactCompliance, load: LoadHistory, grid: Grid, end: float
) -> NDArray[np.float64]:
    """The gap on the grid, of a body that can be pressed there."""
    open_gap = _gap_on(indenter, grid)
    check_touch(compliance, open_gap, grid, load)
    check_period(indenter, open_gap, grid, load)
    check_balance(open_gap, grid, load, end)
    return open_gap


def _gap_on(indenter: Indenter, grid: Grid) -> NDArray[np.float64]:
    return indenter.gap(grid.x[:, None], grid.y[None, :])


def _mirrored(open_gap: NDArray[np.float64], load: LoadHistory, grid: Grid) -> tuple[bool, bool]:
    if grid.periodic:
        return False, False
    return mirrored_axes(open_gap, (load.is_even(0), load.is_even(1)))


def _hereditary_plan(
    compliance: ContactCompliance,
    load: LoadHistory,
    instants: NDArray[np.float64],
    adaptive: AdaptiveTimes | None,
    open_gap: NDArray[np.float64],
    grid: Grid,
) -> HereditaryPlan:
    # Pressure and deflection are remembered, of all cells that are worked with.
    numbers = 2 * open_gap.size // 2 ** sum(_mirrored(open_gap, load, grid))
    if adaptive is None:
        return plan_hereditary_integral(compliance, step_ends(plan_steps(instants, load)), numbers)
    # The steps are not known yet: as if there were many, over all decades that may count.
    count = max(
        ADAPTIVE_STEPS, round(STEP_COUNT_SAFETY * estimated_steps(adaptive, load, compliance))
    )
    expected = np.append(0.0, np.geomspace(1e-9 * adaptive.end, adaptive.end, count))
    return replace(plan_hereditary_integral(compliance, expected, numbers), instants=np.zeros(0))
