"""Instants and speeds whose fields a result keeps."""

from __future__ import annotations

import numpy as np
import pytest

from viscontact.mechanics.problem.kept_fields import ALL_FIELDS, NO_FIELDS, KeptFields

TIMES = np.array([0.0, 0.1, 0.2, 1.0])


@pytest.mark.parametrize("rounding", [-1e-12, 0.0, 1e-12])
def test_instant_is_found_within_rounding(rounding: float) -> None:
    assert KeptFields([0.1 * (1 + rounding), 1.0]).among(TIMES).tolist() == [0.1, 1.0]


def test_other_instants_are_refused_with_the_nearest_one() -> None:
    with pytest.raises(ValueError, match=r"120 ms is not among .* the nearest is 100 ms"):
        KeptFields([0.12]).among(TIMES)


def test_words_choose_all_or_none() -> None:
    assert ALL_FIELDS.among(TIMES).tolist() == TIMES.tolist()
    assert NO_FIELDS.among(TIMES).size == 0
    assert NO_FIELDS.axis("speed") == "field_speed"
