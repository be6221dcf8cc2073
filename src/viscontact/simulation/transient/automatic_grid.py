"""Automatic grid of a run, without the run."""

from __future__ import annotations

from collections.abc import Sequence

from viscontact.bodies.adhesion import Adhesion
from viscontact.bodies.grid import GRID_QUANTITIES, AutomaticGrid, Grid
from viscontact.bodies.indenters import Indenter
from viscontact.bodies.loads import LoadHistory
from viscontact.bodies.loads.temperature import TemperatureHistory, as_temperature
from viscontact.bodies.materials.body import Body
from viscontact.bodies.materials.layers import Layered
from viscontact.bodies.materials.material import Material
from viscontact.mechanics.problem.problem import Problem
from viscontact.simulation.checks.ends import check_ends
from viscontact.simulation.checks.periodicity import check_endless
from viscontact.simulation.meshing.mesh_choice import choose_mesh


def auto_grid(  # noqa: PLR0913
    indenter: Indenter,
    material: Material | Layered | Body,
    load: LoadHistory,
    tolerance: float = 0.01,
    *,
    quantities: Sequence[str] = GRID_QUANTITIES,
    end: float | None = None,
    indenter_material: Material | Layered | Body | None = None,
    temperature: TemperatureHistory | float | None = None,
    adhesion: Adhesion | None = None,
) -> Grid:
    """Choose a grid for a run.

    Parameters
    ----------
    indenter : Indenter
        Shape of the pressed body.
    material : Material, Layered or Body
        Material of the half-space, a body of layers, or one that ends.
    load : LoadHistory
        Force or approach, eccentricity and prescribed tilts over time.
    tolerance : float, optional
        Aimed-at relative error of the named quantities, between 1e-4 and 0.5 [-].
    quantities : sequence of str, optional
        Quantities to which the tolerance applies, as in `AutomaticGrid`.
    end : float, optional
        Last instant of the run [s]; the load's last point, or the end of all creep, when left
        out.
    indenter_material : Material, Layered or Body, optional
        Material of the indenter; rigid when left out.
    temperature : TemperatureHistory or float, optional
        Temperature of the bodies over time, or a constant one [K], as in `simulate`.
    adhesion : Adhesion, optional
        Adhesion between the bodies, round where they touch: the cells resolve the cohesive zone,
        and the attraction is negligible at the edge.

    Returns
    -------
    Grid
        Holds the contact at the largest compliance under every corner of the load's history,
        with a margin; fine enough for the tolerance under the largest load, from its first
        instant on. A peak pressure that has no limit (at a sharp edge or tip) is left out. On a
        body that relaxes, the error of the peak pressure counts at every instant, relative to its
        largest value, as fresh material at the edge of a growing contact is stiff.

    Raises
    ------
    ValueError
        If the tolerance is invalid, no end of the creep is known, no grid fits, or the
        tolerance would need millions of cells.

    Notes
    -----
    Elastic contacts are solved on a mesh and on cells twice as long, each way; what changes by
    less than the tolerance on halving the cells, and falls at least as fast as they do, is off by
    less. Where the change is too large the mesh is refined the way that causes it.

    Examples
    --------
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> vc.auto_grid(vc.Sphere(0.01), rubber, vc.step(1.0)).shape
    (40, 40)
    """
    request = AutomaticGrid(tolerance, quantities)
    problem = Problem(
        *(indenter, material, load, request),
        indenter_material=indenter_material,
        temperature=as_temperature(temperature),
        adhesion=adhesion,
    )
    check_ends(problem)
    check_endless(problem.cut_indenter, None)
    return choose_mesh(problem, end).grid
