"""How many cases of a campaign are tried: a sample, or all with VISCONTACT_CAMPAIGNS=whole."""

import os

from scipy.stats import binom


def tried(sample: int, whole: int) -> int:
    """Number of cases: a sample takes half a minute, the whole campaign up to ten."""
    return whole if os.environ.get("VISCONTACT_CAMPAIGNS") == "whole" else sample


def fewest_held(count: int) -> int:
    """Number of intervals of 95 % that hold the truth; fewer of a number do so once in 70 times.

    By the binomial distribution: 8 of 10, 13 of 16, 35 of 40, 90 of 100.
    """
    return int(binom.ppf(1 / 70, count, 0.95))
