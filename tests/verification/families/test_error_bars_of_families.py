"""Error bars against independent truths, over random families of bodies, laws, loads and meshes.

The promise of `error_bars`: 95 of 100 errors are smaller than their bar, in every family and
quantity about as many; at most 5 in 1000 are larger than three bars, nearly all of them with a
warning that names the reason; half of the bars are less than five times the error. Families and
seeds on which factors were chosen are reported apart from those that were left out of every choice
(`drawn.py`).
"""

import numpy as np
import pytest

from campaigns import tried
from verification.families.drawn import (
    ADHERING,
    BLUNT,
    CALIBRATED,
    COUPLED,
    GRIPPING,
    HELD_OUT,
    LAYERED,
    drawn,
)
from verification.families.solved import solve
from verification.families.tally import least_within, report, shortfalls, values_of

#: Instants of a run that count; more of them would err alike.
SAMPLED = 2

#: False in a whole campaign, in which each family has enough runs to be judged by itself.
SAMPLE = bool(tried(1, 0))


def solved(seed: int, count: int, families: dict) -> list[dict]:
    names = tuple(families)
    return [solve(name, run, sampled=SAMPLED) for name, run in drawn(seed, count, names)]


#: All of them but two, whose many steps take as long as all others.
LONG = ("harmonic_load", "held_ball")
SHORT = {name: family for name, family in HELD_OUT.items() if name not in LONG}


@pytest.mark.parametrize(
    "families",
    [
        pytest.param(SHORT, id="held out"),
        pytest.param(BLUNT, id="blunt"),
        pytest.param(CALIBRATED, id="calibrated", marks=pytest.mark.slow),
    ],
)
def test_bars_hold_in_a_sample_of_all_families(families: dict) -> None:
    records = solved(100, len(families), families)
    values = values_of(records)
    assert not any("refused" in record for record in records)
    lines = "\n".join(report(records))
    assert np.mean([value.ratio >= 1 for value in values]) >= 0.93, lines
    assert all(value.warned for value in values if value.ratio < 1 / 3), lines


@pytest.mark.slow
def test_bars_hold_in_families_that_were_used_to_choose_factors(campaign) -> None:
    """A seed of the last choice; `docs/accuracy.md` has the figures of one that is not."""
    records = solved(300, tried(5, 36) * len(CALIBRATED), CALIBRATED)
    for each in report(records):
        campaign(f"calibrated families, {each}")
    assert shortfalls(values_of(records), sample=SAMPLE) == []


@pytest.mark.slow
def test_bars_hold_in_families_that_were_held_out(campaign) -> None:
    """Families only the common factors of which were looked at, on this seed and others."""
    records = solved(304, tried(5, 40) * len(HELD_OUT), HELD_OUT)
    for each in report(records):
        campaign(f"held-out families, {each}")
    values = values_of(records)
    assert shortfalls(values, sample=SAMPLE) == []
    assert all(value.warned for value in values if value.ratio < 1 / 3)


@pytest.mark.slow
def test_bars_hold_on_blunt_bodies_eccentric_ones_and_after_events(campaign) -> None:
    """A seed of the last choice; `docs/accuracy.md` has the figures of others."""
    records = solved(308, tried(5, 60) * len(BLUNT), BLUNT)
    for each in report(records):
        campaign(f"blunt bodies, {each}")
    assert shortfalls(values_of(records), sample=SAMPLE) == []


@pytest.mark.slow
def test_bars_hold_under_friction(campaign) -> None:
    """Nothing was chosen on these families; `docs/accuracy.md` has the figures of more runs."""
    records = [solve(*each) for each in drawn(2051, tried(3, 5) * len(GRIPPING), tuple(GRIPPING))]
    assert not any("refused" in record for record in records)
    for each in report(records):
        campaign(f"friction, {each}")
    ratios = np.array([value.ratio for value in values_of(records)])
    # Measured: 99.0 % of 10 833 values of 180 runs.
    assert np.mean(ratios >= 1) >= 0.95
    assert np.mean(ratios < 1 / 3) <= 0.01


@pytest.mark.slow
def test_bars_hold_under_friction_of_coupled_bodies(campaign) -> None:
    """A seed on which nothing was chosen; `docs/accuracy.md` has the figures of more runs."""
    records = [solve(*each) for each in drawn(7310, tried(8, 60), tuple(COUPLED))]
    assert not any("refused" in record for record in records)
    for each in report(records):
        campaign(f"friction of coupled bodies, {each}")
    ratios = np.array([value.ratio for value in values_of(records)])
    # Measured: 99.5 % of 7515 values of 109 runs.
    assert np.mean(ratios >= 1) >= 0.95
    assert np.mean(ratios < 1 / 3) <= 0.01


@pytest.mark.slow
def test_bars_hold_where_bodies_adhere(campaign) -> None:
    """A seed that was not looked at when the limits were set, on seeds 1 and 2."""
    records = solved(23, tried(3, 30) * len(ADHERING), ADHERING)
    for each in report(records):
        campaign(f"adhesion, {each}")
    assert not any("refused" in record for record in records)
    ratios = np.array([value.ratio for value in values_of(records)])
    # Measured: 97.7 % of 23 168 values of 170 runs.
    assert np.mean(ratios >= 1) >= (least_within(len(ratios), 0.95) if SAMPLE else 0.95)
    assert np.mean(ratios < 1 / 3) <= 0.01


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::viscontact.AccuracyWarning")  # of the finer runs
def test_bars_hold_on_layers(campaign) -> None:
    """A seed that was not looked at when the limits on thin layers were set."""
    records = solved(306, tried(4, 8) * len(LAYERED), LAYERED)
    assert not any("refused" in record for record in records)
    for each in report(records):
        campaign(f"layers, {each}")
    ratios = np.array([value.ratio for value in values_of(records)])
    # Measured: 95.9 % of 194 values, 98.2 % of 1108 of 70 runs.
    assert np.mean(ratios >= 1) >= (least_within(len(ratios), 0.93) if SAMPLE else 0.93)
    assert np.mean(ratios < 1 / 3) <= 0.01
    assert np.median(ratios) < 8
