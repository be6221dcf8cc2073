"""A thousand random problems of `hard_problems`, every instant audited.

Truth: eqs. 1 to 5 and 7 of Spinu & Cerlinca (2018), evaluated by `auditing`, which shares no
numerics with the package. A run may refuse a problem, if it says why; what it has yielded till then
counts like all the rest. The thousand take two to four minutes on two cores.
"""

from collections import Counter

import pytest

import viscontact as vc
from campaigns import tried
from verification.auditing import audit
from verification.hard_problems import hard_problem

pytestmark = pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")

TOLERANCE = 1e-6

#: What a solve may be off by, over its tolerance: two roads to the same displacement differ by
#: rounding, and by the quadrature of laws that are no series (1e-9). Measured: 0.9999.
PROMISE = 1.01

#: What a run may say instead of a result: the grid that was drawn does not suit the contact, or
#: a tilt presses at once on a law that cannot follow.
REFUSALS = ("the contact reaches the edge of the grid", "largest contact", "presses from time 0 on")


def findings(seeds):
    """What was found, by seed; and what failed, with the reason."""
    found, failed = {}, {}
    for seed in seeds:
        problem = hard_problem(seed)
        try:
            found[seed] = audit(problem, TOLERANCE)
        except (vc.ConvergenceError, ArithmeticError, AssertionError) as error:
            failed[seed] = f"{problem.kinds}: {type(error).__name__}: {error}"
            continue
        worst = max(found[seed].gap, found[seed].balance, found[seed].fields)
        if worst > PROMISE * TOLERANCE:
            failed[seed] = f"{problem.kinds}: violation {worst:.3g}"
        reason = found[seed].stopped
        if reason and not any(text in reason for text in REFUSALS):
            failed[seed] = f"{problem.kinds}: refused: {reason}"
    return found, failed


def figures(name, found, failed):
    """The campaign's line."""
    count = Counter()
    for run in found.values():
        count.update(instants=run.instants, apart=run.apart, refused=bool(run.stopped))
    worst = [max(getattr(run, name) for run in found.values()) for name in ("gap", "balance")]
    return (
        f"{name}: {len(found)} problems, {count['instants']} instants audited "
        f"({count['apart']} without contact), worst gap {worst[0]:.3g}, worst imbalance "
        f"{worst[1]:.1g}, {len(failed)} failed, {count['refused']} refused with a message"
    )


def test_six_hard_problems_are_in_equilibrium_throughout(campaign):
    found, failed = findings(range(1000, 1006))
    campaign(figures("hard problems, sample", found, failed))
    assert not failed


@pytest.mark.slow
@pytest.mark.parametrize("hundred", range(tried(1, 10)))
def test_many_hard_problems_are_in_equilibrium_throughout(hundred, campaign):
    # In parts, for the processes of pytest-xdist; about 25 s each.
    found, failed = findings(range(100 * hundred, 100 * hundred + 100))
    campaign(figures(f"hard problems, part {hundred}", found, failed))
    assert not failed
    assert sum(bool(run.stopped) for run in found.values()) < 15
