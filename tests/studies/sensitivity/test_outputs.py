"""Scalars of a sensitivity study."""

from __future__ import annotations

from viscontact.studies.sensitivity.outputs import checked_outputs


def test_outputs_are_separated_by_commas() -> None:
    assert checked_outputs("peak_pressure, approach") == ("peak_pressure", "approach")
