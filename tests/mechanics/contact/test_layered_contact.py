"""Contact with an elastic layer against the Fredholm equation of `reference.layer`."""

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.mechanics.contact.domain import ContactDomain
from viscontact.mechanics.contact.equilibrium import solve_contact
from viscontact.mechanics.contact.problem import ContactProblem
from viscontact.mechanics.contact.rigid_balance import Constraints
from viscontact.mechanics.contact.rim import trace_rim
from viscontact.mechanics.halfspace.elastic_stack import ElasticBase, ElasticLayer, ElasticStack
from viscontact.mechanics.halfspace.layered_influence import layered_influence_table
from viscontact.mechanics.halfspace.surface_response import HALF_SPACE, SummedResponse
from viscontact.reference import layer_punch, layer_sphere

RADIUS = 10.0  # of the sphere; all lengths over the contact radius, stresses over G


def layer(ratio, nu, **options):
    return ElasticStack((ElasticLayer(1 / ratio, 1.0, nu, **options),), None)


def solved(open_gap, grid, response, nu, constraints, tolerance=1e-6):
    domain = ContactDomain(grid, response=response, mirrored=(True, True))
    problem = ContactProblem(
        domain.reduce_by_symmetry(open_gap),
        (1 - nu) / 2,
        domain.reduced_constraints(constraints),
        1e-15,
    )
    found = solve_contact(problem, domain, tolerance=tolerance)
    assert found.converged
    return found, domain


def pressed_sphere(ratio, nu, cells, **options):
    """A sphere under the force of the contact radius 1, on cells of this number on the radius."""
    exact = layer_sphere(1.0, RADIUS, 1 / ratio, shear_modulus=1.0, poisson_ratio=nu, **options)
    count = 2 * int(1.25 * cells)
    grid = vc.Grid((count, count), (count / cells, count / cells))
    gap = (grid.x[:, None] ** 2 + grid.y**2) / (2 * RADIUS)
    found, domain = solved(
        gap, grid, layer(ratio, nu, **options), nu, Constraints((exact.force, 0.0, 0.0))
    )
    return exact, grid, found, domain


@pytest.mark.parametrize("nu", [0.3, 0.38, 0.5])
@pytest.mark.parametrize("ratio", [0.2, 1.0, 4.0, 20.0])
def test_a_sphere_on_a_bonded_layer_follows_the_fredholm_equation(ratio, nu):
    exact, grid, found, domain = pressed_sphere(ratio, nu, 50)
    # Measured: 5e-5, with 2.5 cells per thickness 4e-4 in an incompressible layer.
    allowed = 1e-3 if (ratio, nu) == (20.0, 0.5) else 1e-4
    assert found.motion[0] == close_to(exact.approach, rel=allowed)
    pressure = domain.expand_by_symmetry(found.found.pressure)
    middle = grid.shape[0] // 2
    centre = exact.pressure(np.hypot(grid.x[middle], grid.y[middle]))
    assert pressure[middle, middle] == close_to(centre, rel=allowed)
    rim = trace_rim(grid, pressure > 0, domain.expand_by_symmetry(found.gap))
    assert rim.area == close_to(np.pi, rel=2e-4 if ratio < 8 else 2e-3)
    # The preconditioner of the half-space would take up to 118 directions.
    assert found.convolutions <= 30


@pytest.mark.parametrize("nu", [0.3, 0.5])
def test_the_approach_converges_at_second_order(nu):
    off = []
    for cells in (12, 24, 48):
        exact, _, found, _ = pressed_sphere(2.0, nu, cells, bonded=False)
        off.append(abs(found.motion[0] / exact.approach - 1))
    assert np.log2(off[0] / off[2]) / 2 > 1.5
    assert off[2] < 1e-4


@pytest.mark.parametrize(("ratio", "nu"), [(0.2, 0.3), (1.0, 0.38), (4.0, 0.5), (20.0, 0.3)])
def test_a_flat_punch_on_a_bonded_layer_follows_the_fredholm_equation(ratio, nu):
    grid = vc.Grid((120, 120), (2.4, 2.4))
    gap = np.where(grid.x[:, None] ** 2 + grid.y**2 < 1, 0.0, np.inf)
    given = Constraints((None, None, None), (0.01, 0.0, 0.0))

    def force_on(response):
        found, domain = solved(gap, grid, response, nu, given)
        return float(domain.expand_by_symmetry(found.found.pressure).sum()) * grid.cell_area

    # Stairs of cells in place of the rim shift it in the same way on all bodies: by as much as on a
    # half-space, where F = 2 E* a w.
    radius = force_on(HALF_SPACE) * (1 - nu) / (4 * 0.01)
    exact = layer_punch(radius, 0.01, 1 / ratio, shear_modulus=1.0, poisson_ratio=nu)
    # Asked: 5e-4.
    assert force_on(layer(ratio, nu)) == close_to(exact.force, rel=5e-4)


def test_displacements_are_reciprocal_and_pressures_do_positive_work():
    # Betti: p1 · K p2 = p2 · K p1; and p · K p > 0 for any pressure, so no layer gives work.
    stacks = [
        layer(20.0, 0.5),
        ElasticStack((ElasticLayer(0.1, 100.0, 0.3), ElasticLayer(1.0, 1.0, 0.5)), None),
        ElasticStack((ElasticLayer(0.1, 0.01, 0.499),), ElasticBase(1.0, 0.3)),
    ]
    rng = np.random.default_rng(7)
    grid = vc.Grid((24, 20), (1.0, 1.5))
    for stack in stacks:
        convolution = ContactDomain(grid, response=stack).convolution
        one, two = rng.standard_normal((2, *grid.shape))
        forth = (one * convolution.apply(two)).sum()
        back = (two * convolution.apply(one)).sum()
        assert forth == close_to(back, rel=1e-9)
        assert all((p * convolution.apply(p)).sum() > 0 for p in (one, two, np.ones(grid.shape)))


def test_the_convolution_is_the_sum_over_all_cells():
    grid = vc.Grid((9, 12), (1.0, 1.5))
    stack = layer(2.0, 0.4)
    table = layered_influence_table(grid.shape, grid.cell_size, stack)
    pressure = np.random.default_rng(3).standard_normal(grid.shape)
    i, j = np.indices(grid.shape)
    apart = np.abs(i[..., None, None] - i), np.abs(j[..., None, None] - j)
    expected = (table[apart] * pressure).sum(axis=(2, 3))
    found = ContactDomain(grid, response=stack).convolution.apply(pressure)
    assert found == close_to(expected, abs=1e-13)


def test_a_period_of_waves_is_displaced_by_its_own_response():
    stack = ElasticStack((ElasticLayer(0.2, 1.0, 0.3),), None)
    grid = vc.Grid((16, 12), (1.0, 1.0), periodic=True)
    wave = 2.0 + np.cos(2 * np.pi * grid.x)[:, None] + 0 * grid.y
    found = ContactDomain(grid, response=stack).convolution.apply(wave)
    swing = 2 / (2 * np.pi) * float(stack.ratio(np.array(2 * np.pi)))
    assert found == close_to(2 * stack.mean_displacement + swing * (wave - 2), abs=1e-14)


@pytest.mark.parametrize("periodic", [False, (True, False), True], ids=str)
def test_a_sum_of_kept_parts_is_the_operator_of_the_sum(periodic):
    parts = HALF_SPACE, layer(4.0, 0.45), layer(2.0, 0.3, bonded=False)
    grid = vc.Grid((24, 20), (3.0, 2.0), periodic=periodic)
    mirrored = (not grid.periodic[0], False)
    domain = ContactDomain(grid, response=parts[0], mirrored=mirrored)
    cells = np.zeros(domain.shape, dtype=bool)
    cells[2:7, 5:9] = True
    domain.patch_around(cells)
    pressure = np.random.default_rng(5).standard_normal(domain.shape)
    for weights in ((0.5, 0.7, -0.2), (0.1, 0.1, 0.8)):
        domain.set_response(parts, weights)
        whole = ContactDomain(grid, response=SummedResponse(parts, weights), mirrored=mirrored)
        expected = whole.convolution.apply(pressure)
        assert domain.convolution.apply(pressure) == close_to(expected, abs=1e-12)
        terms = zip(weights, parts, strict=True)
        by_parts = sum(w * domain.unit_displacement(pressure, part) for w, part in terms)
        # On a period a half-space has no datum: displacement counts from its mean.
        datum = np.mean(by_parts) if all(grid.periodic) else 0.0
        assert by_parts - datum == close_to(expected, abs=1e-12)
        patch, afresh = domain.patch_around(cells), whole.patch_around(cells)
        block = patch.cut(pressure)
        assert (patch.rows, patch.columns) == (afresh.rows, afresh.columns)
        # In single precision.
        for one, other in (
            (patch.convolution, afresh.convolution),
            (patch.preconditioner, afresh.preconditioner),
        ):
            found, same = one.apply(block), other.apply(block)
            assert found == close_to(same, abs=1e-5 * np.abs(same).max())
