"""How many cases of a campaign are tried: a sample, or all with VISCONTACT_CAMPAIGNS=whole."""

import os


def tried(sample: int, whole: int) -> int:
    """Number of cases: a sample takes about a minute, the whole campaign five to ten."""
    return whole if os.environ.get("VISCONTACT_CAMPAIGNS") == "whole" else sample
