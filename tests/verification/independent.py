"""The physics once more, by another route: what results are checked against.

Nothing here uses the package's numerics. Coefficients are Love's logarithms in extended
precision, sums over cells are `scipy.signal.fftconvolve`, and the past is summed as the paper
does it, step by step over the whole history (Spinu & Cerlinca 2018, eqs. 7 to 12, with pressure
rising linearly in time instead of constant).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq
from scipy.signal import fftconvolve

import viscontact as vc


def love(x, y, dx, dy):
    """Mean of 1/r over a cell times its area over pi: Johnson (1985), eq. 3.25, as printed."""
    a, b = np.longdouble(dx) / 2, np.longdouble(dy) / 2
    x, y = np.broadcast_arrays(np.asarray(x, np.longdouble), np.asarray(y, np.longdouble))

    def term(first, second, other):
        return first * np.log((second + np.hypot(second, first)) / (other + np.hypot(other, first)))

    # Offsets are taken positive: the logarithms cancel for negative ones.
    x, y = np.abs(x), np.abs(y)
    with np.errstate(divide="ignore", invalid="ignore"):
        terms = [
            term(x + a, y + b, y - b),
            term(y + b, x + a, x - a),
            -term(x - a, y + b, y - b),
            -term(y - b, x + a, x - a),
        ]
    # On the line of an edge the factor in front is zero, and so is the term.
    total = sum(np.where(np.isfinite(part), part, 0) for part in terms)
    return np.asarray(total / np.pi, dtype=float)


def deflection(pressure, cell_size):
    """Surface displacement per unit compliance: the sum over all cells of love() p."""
    # Scaled to order one, so that no unit leaves the transforms' range.
    size = max(cell_size)
    kernel = _kernel(pressure.shape, (cell_size[0] / size, cell_size[1] / size))
    return fftconvolve(kernel, pressure, mode="valid") * size


@lru_cache(maxsize=2)
def _kernel(shape, cell_size):
    x, y = (
        np.arange(1 - cells, cells) * edge for cells, edge in zip(shape, cell_size, strict=True)
    )
    return love(x[:, None], y[None, :], *cell_size)


def mean_creep(compliance, start, length):
    """Mean of J over [start, start + length]: in closed form for a series, else by quadrature."""
    if not hasattr(compliance, "amplitudes"):
        return _mean_by_quadrature(compliance, start, length)
    ratio = length / compliance.times
    kept = np.exp(-start / compliance.times) * (-np.expm1(-ratio) / ratio if length else 1.0)
    delayed = float((compliance.amplitudes * (1 - kept)).sum())
    return compliance.instant + delayed + compliance.fluidity * (start + length / 2)


def _graded_rule():
    """Nodes and weights of a mean over [0, 1]: J bends most where an interval begins.

    Eight Gauss-Legendre nodes on each of [1/2, 1], [1/4, 1/2] and so on, 24 times: within 1e-9 for
    powers of time from 0 on, and wherever J is smooth over a factor 2 of time.
    """
    nodes, weights = np.polynomial.legendre.leggauss(8)
    ends = np.append(2.0 ** -np.arange(24), 0.0)
    lengths = ends[:-1] - ends[1:]
    points = ends[1:, None] + lengths[:, None] * (nodes + 1) / 2
    return points.ravel(), (lengths[:, None] * weights / 2).ravel()


NODES, WEIGHTS = _graded_rule()


def _mean_by_quadrature(compliance, start, length):
    """Mean of J, piece by piece between the rows of a table."""
    if length == 0:
        return float(compliance(start))
    inner = [time for time in _bends(compliance) if start < time < start + length]
    ends = np.array([0.0, *(time - start for time in inner), length])
    values = compliance(start + ends[:-1, None] + np.diff(ends)[:, None] * NODES)
    return float((values @ WEIGHTS) @ np.diff(ends) / length)


def _bends(compliance):
    """Instants at which J is not smooth: the rows of measured laws."""
    parts = getattr(compliance, "parts", ())
    law = getattr(compliance, "law", None)
    measured = np.isfinite(getattr(law, "measured_until", np.inf))
    while hasattr(law, "law"):
        law = law.law
    return sorted({*(law.times if measured else ()), *(t for part in parts for t in _bends(part))})


@lru_cache(maxsize=512)
def rise(compliance, duration, after_jump):
    """How long a value rises in a step, before it is held; what the package says it does.

    All the step, unless what the body then owes to the old value, J(T) less the mean of J,
    exceeds what it gives at once, J(0), or two thirds of it in a first step after a jump: then as
    long as these are equal. Without J(0), half of the mean of J stands in their place.
    """

    limit = compliance.instant * (2 / 3 if after_jump else 1)

    def debt(part):
        held = duration * (1 - part)
        new = mean_creep(compliance, held, duration * part)
        return compliance(duration) - new - (limit or new / 2)

    if debt(1.0) <= 0:
        return duration
    return duration * brentq(debt, 0.0, 1.0, xtol=1e-15)


def superposed(compliance, times, fields, kinks=None):
    """Boltzmann's integral at the last instant: a jump at times[0] and at doubled instants.

    No step continues the one before after `kinks` of the load, or anywhere if none are given.
    """
    end = times[-1]
    total = compliance(end - times[0]) * fields[0]
    for start, length, increment in linear_parts(compliance, times, fields, kinks):
        age = max(end - start - length, 0.0)  # not negative by rounding
        total = total + mean_creep(compliance, age, length) * increment
    return total


def linear_parts(compliance, times, fields, kinks):
    """Start and length of each part of the steps over which the fields are linear, and increment.

    What the package says it does in steps longer than their rise: the line to the new value begins,
    at the end of the rise, on the one from the mean of the same part of the step before.
    """
    mean = age = None
    for i in range(1, len(times)):
        start, step = times[i - 1], times[i] - times[i - 1]
        after_jump = i == 1 or times[i - 1] == times[i - 2]
        length = rise(compliance, step, after_jump) if step > 0 else 0.0
        smooth = kinks is not None and i > 1 and start not in kinks and step > 0
        turn = fields[i]
        if smooth and mean is not None and compliance.instant > 0 and step - length <= 4.8 * age:
            part = (length + age) / (step + age)
            turn = part * fields[i] + (1 - part) * mean
        yield start, length, turn - fields[i - 1]
        yield start + length, step - length, fields[i] - turn
        mean = age = None
        if smooth and length < step and fields[i].any():
            mean, age = (turn + fields[i]) / 2, (step - length) / 2


@dataclass(frozen=True)
class Violations:
    """Relative violations of what a contact has to satisfy."""

    tension: float
    gap_under_pressure: float
    penetration: float
    force: float
    moment_x: float
    moment_y: float

    @property
    def worst(self):
        return max(vars(self).values())


def violations(grid, open_gap, state, displacement, point, scale=0.0):
    """Check eqs. 1 to 5 of a state, given the displacement found by another route."""
    x, y = grid.x[:, None], grid.y[None, :]
    plane = state.approach + state.tilt_x * x + state.tilt_y * y
    gap = open_gap + displacement - plane
    touching = state.pressure > 0
    scale = max(scale, float(displacement.max()))
    sums = [float((state.pressure * arm).sum()) * grid.cell_area for arm in (1.0, x, y)]
    force = max(point.force, np.finfo(float).tiny)
    # The contact's longer extent turns a moment's error into a force's.
    rows, columns = np.nonzero(touching)
    reach = max((np.ptp(rows) + 1) * grid.cell_size[0], (np.ptp(columns) + 1) * grid.cell_size[1])
    free_x, free_y = point.tilt_x is None, point.tilt_y is None
    return Violations(
        tension=max(-float(state.pressure.min()), 0.0),
        gap_under_pressure=float(np.abs(gap[touching]).max()) / scale,
        penetration=max(-float(gap.min()), 0.0) / scale,
        force=abs(sums[0] - point.force) / force,
        moment_x=abs(sums[1] / force - point.eccentricity_x) / reach * free_x,
        moment_y=abs(sums[2] / force - point.eccentricity_y) / reach * free_y,
    )


@dataclass(frozen=True)
class Audit:
    """What an audited run did, and the violations at its instants with contact."""

    states: list
    violations: list

    @property
    def worst(self):
        return max((found.worst for found in self.violations), default=0.0)


def audit(indenter, material, load, grid, times, tolerance=1e-6, indenter_material=None):
    """March, and check every instant against eqs. 1 to 5 with a displacement of our own."""
    bodies = [body for body in (material, indenter_material) if body is not None]
    compliance = sum(
        (body.contact_compliance() for body in bodies[1:]), bodies[0].contact_compliance()
    )
    times = np.unique(np.concatenate([times, [stop for stop in load.stops if stop <= times[-1]]]))
    options = {"tolerance": tolerance, "indenter_material": indenter_material}
    states = list(vc.march(indenter, material, load, grid, times, **options))
    open_gap = indenter.gap(grid.x[:, None], grid.y[None, :])
    instants, fields, found, scale = [], [], [], 0.0
    bends = np.append(load.kinks, load.touches)
    for state in states:
        if state.time > 0 and state.time in load.jumps:
            instants.append(state.time)
            fields.append(_before_jump(indenter, material, load, grid, times, state.time, options))
            scale = max(scale, float(superposed(compliance, instants, fields, bends).max()))
        instants.append(state.time)
        fields.append(deflection(state.pressure, grid.cell_size))
        displacement = superposed(compliance, instants, fields, bends)
        scale = max(scale, float(displacement.max()))
        point = load.at(state.time)
        if point.force > 0:
            found.append(violations(grid, open_gap, state, displacement, point, scale))
        else:
            _check_apart(state, open_gap, displacement, grid, scale)
    return Audit(states, found)


def _before_jump(indenter, material, load, grid, times, instant, options):
    """Deflection just before a jump, from a run whose load does not jump there."""
    names = ("eccentricity_x", "eccentricity_y", "tilt_x", "tilt_y")
    aside = {name: getattr(load, name) for name in names}
    before = int(np.searchsorted(load.times, instant))
    held = vc.ForceHistory(load.times[: before + 1], load.force[: before + 1], **aside)
    *_, last = vc.march(indenter, material, held, grid, times[times <= instant], **options)
    return deflection(last.pressure, grid.cell_size)


def _check_apart(state, open_gap, displacement, grid, scale):
    """Without force: no pressure, and the body where it just touches the dented surface."""
    x, y = grid.x[:, None], grid.y[None, :]
    plane = state.approach + state.tilt_x * x + state.tilt_y * y
    assert state.outcome == vc.Outcome.NO_CONTACT
    assert not state.pressure.any()
    assert state.force == state.contact_area == state.peak_pressure == state.mean_pressure == 0.0
    nearest = float((open_gap + displacement - plane).min())
    if state.displacement.any():
        assert abs(nearest) <= 1e-9 * max(scale, 1e-300)
    else:
        # A flat surface is touched by the lowest point, which is no cell's centre on most grids.
        tilted = open_gap - (plane - state.approach)
        assert (
            -1e-12 * scale
            <= nearest
            <= max(float(tilted.min()) - state.approach, 0.0) + 1e-12 * scale
        )
