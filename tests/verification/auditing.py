"""An audit of any run, under a force or on a stage, under any law, to its end or to where it stops.

As `independent.audit`, whose numerics it uses: nothing is shared with the package but the laws.
"""

from dataclasses import dataclass, fields, replace

import numpy as np

import viscontact as vc
from verification.independent import deflection, superposed


@dataclass
class Findings:
    """Worst relative violations of a run, and how it ended.

    `gap` is the largest gap under pressure or penetration elsewhere, over the largest displacement
    so far; `balance` the error of force and moments; `fields` how far the displacement and the gap
    that the run returns are from ours; `instants` how many were looked at, `apart` how many of
    them without contact; `stopped` what the run said when it stopped.
    """

    gap: float = 0.0
    balance: float = 0.0
    fields: float = 0.0
    instants: int = 0
    apart: int = 0
    iterations: int = 0
    stopped: str = ""

    def see(self, **found):
        for name, value in found.items():
            # A number that is none is the worst of all.
            worst = max(getattr(self, name), value)
            setattr(self, name, worst if value == value else np.inf)


def audit(problem, tolerance=1e-6):
    """March a problem, and check all it yields against eqs. 1 to 5 and 7."""
    times = problem.times
    stops = [stop for stop in problem.load.stops if stop <= times[-1]]
    problem = replace(problem, times=np.unique(np.concatenate([times, stops])))
    bodies = [b for b in (problem.material, problem.indenter_material) if b is not None]
    compliances = [body.contact_compliance() for body in bodies]
    compliance = sum(compliances[1:], compliances[0])
    x, y = problem.grid.x[:, None], problem.grid.y[None, :]
    open_gap = problem.indenter.gap(x, y)
    found, scale = Findings(), 1e-12 * max(problem.grid.cell_size)
    instants, past = [], []
    bends = np.append(problem.load.kinks, problem.load.touches)
    for state in _states(problem, tolerance, found):
        if state.time > 0 and state.time in problem.load.jumps:
            instants.append(state.time)
            past.append(_before_jump(problem, state.time, tolerance))
            scale = max(scale, float(superposed(compliance, instants, past, bends).max()))
        instants.append(state.time)
        past.append(deflection(state.pressure, problem.grid.cell_size))
        displacement = superposed(compliance, instants, past, bends)
        scale = max(scale, float(displacement.max()))
        _check_instant(problem, state, displacement, open_gap, scale, found)
    return found


def _states(problem, tolerance, found):
    """The run's states up to where it stops, if it says why."""
    try:
        yield from problem.march(tolerance=tolerance)
    except (vc.DomainError, ValueError) as refusal:
        found.stopped = str(refusal)


def _before_jump(problem, instant, tolerance):
    """Deflection just before a jump, from a run whose load does not jump there."""
    load = problem.load
    points = int(np.searchsorted(load.times, instant)) + 1
    parts = [getattr(load, field.name) for field in fields(load)]
    cut = [part[:points] if isinstance(part, np.ndarray) else part for part in parts]
    held = replace(problem, load=type(load)(*cut), times=problem.times[problem.times <= instant])
    *_, last = _states(held, tolerance, Findings())
    return deflection(last.pressure, problem.grid.cell_size)


def _check_instant(problem, state, displacement, open_gap, scale, found):
    grid, point = problem.grid, problem.load.at(state.time)
    x, y = grid.x[:, None], grid.y[None, :]
    plane = state.approach + state.tilt_x * x + state.tilt_y * y
    gap = open_gap + displacement - plane
    solid, touching = np.isfinite(open_gap), state.pressure > 0
    found.instants += 1
    found.iterations += state.iterations
    assert state.outcome != vc.Outcome.NOT_CONVERGED
    assert state.pressure.min() >= 0
    assert not state.pressure[~solid].any()
    assert (state.gap[~solid] == np.inf).all()
    assert touching.any() == (state.outcome == vc.Outcome.CONVERGED)
    rounding = 1e-15 * float(open_gap[solid].max() + np.abs(plane).max() + abs(state.approach))
    for returned, ours in ((state.displacement, displacement), (state.gap, gap)):
        off = float(np.abs(returned[solid] - ours[solid]).max())
        found.see(fields=max(off - rounding, 0.0) / scale)
    for given, got in ((point.tilt_x, state.tilt_x), (point.tilt_y, state.tilt_y)):
        assert given is None or got == given
    if point.force is None:
        assert state.approach == point.approach
    else:
        assert touching.any() == (point.force > 0)
    if touching.any():
        found.see(gap=float(np.abs(gap[touching]).max()) / scale)
        found.see(balance=_imbalance(grid, state, point))
    else:
        found.apart += 1
        assert state.force == state.contact_area == state.peak_pressure == 0.0
        if point.force is not None:
            found.see(gap=_touch_missed(state, displacement, gap) / scale)
            return
    found.see(gap=max(-float(gap.min()), 0.0) / scale)


def _imbalance(grid, state, point):
    """Errors of force and free moments; the contact's longer extent turns one into the other."""
    rows, columns = np.nonzero(state.pressure)
    reach = max((np.ptp(rows) + 1) * grid.cell_size[0], (np.ptp(columns) + 1) * grid.cell_size[1])
    arms = (1.0, grid.x[:, None], grid.y[None, :])
    force, *moments = (float((state.pressure * arm).sum()) * grid.cell_area for arm in arms)
    errors = [] if point.force is None else [abs(force - point.force) / point.force]
    wanted = (point.eccentricity_x, point.eccentricity_y)
    for moment, arm, tilt in zip(moments, wanted, (point.tilt_x, point.tilt_y), strict=True):
        if tilt is None:
            target = (force if point.force is None else point.force) * arm
            errors.append(abs(moment - target) / (force * reach))
    return max(errors, default=0.0)


def _touch_missed(state, displacement, gap):
    """How far from touching the body stands that no force presses, beyond what cells explain.

    A dented surface is touched at a cell; a flat one by the body's lowest point, which is no
    cell's centre on most grids.
    """
    nearest = float(gap.min())
    between = 0.0 if state.displacement.any() else max(nearest, 0.0)
    rounding = 1e-15 * (abs(state.approach) + float(np.abs(displacement).max()))
    return max(abs(nearest - between) - rounding, 0.0)
