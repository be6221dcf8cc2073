"""Plain data of a run: bits that come back as they were, and damage that is noticed."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
import pytest

from viscontact.runs.directory.npz_archive import read_plain, write_plain


def test_plain_data_come_back_to_the_last_bit() -> None:
    fixed = np.array([1.5, -0.0, np.nan])
    fixed.flags.writeable = False
    signalling = np.array([0x7FF0000000000001], dtype="u8").view("f8")
    given: dict[str, Any] = {
        "fixed": fixed,
        "payload": signalling,
        "columns": np.asfortranarray(np.arange(6.0).reshape(2, 3)),
        "every other": np.arange(10.0)[::2],
        "empty": np.empty((0, 3)),
        "scalar": np.array(3.0),
        "words": ["ü", None, True, 7, 5e-324, -0.0],
        "deep": {"a": [{"b": fixed}, [fixed]]},
        "not finite": [float("inf"), float("-inf")],
    }
    file = io.BytesIO()
    write_plain(file, given)
    read = read_plain(file)
    assert list(read) == list(given)
    for name in ("fixed", "payload", "columns", "every other", "empty", "scalar"):
        assert read[name].tobytes() == given[name].tobytes()
        assert read[name].shape == given[name].shape
    # of whether a sum over it runs by rows or by columns, its last bits may depend
    assert read["columns"].flags.f_contiguous
    assert read["fixed"].flags.writeable  # who goes on from it may write to it
    assert read["words"] == given["words"]
    assert str(read["words"][-1]) == "-0.0"
    assert read["deep"]["a"][1][0].tobytes() == fixed.tobytes()
    assert read["not finite"] == given["not finite"]


def test_damage_anywhere_is_refused_or_without_effect() -> None:
    given = {"time": 1.5, "field": np.arange(6.0), "past": [np.ones((2, 2)), None]}
    file = io.BytesIO()
    write_plain(file, given)
    whole = file.getvalue()
    refused = 0
    for position in range(len(whole)):
        for changed in (whole[position] ^ 0x01, whole[position] ^ 0xFF):
            damaged = whole[:position] + bytes([changed]) + whole[position + 1 :]
            try:
                read = read_plain(io.BytesIO(damaged))
            except ValueError:
                refused += 1
                continue
            assert read["time"] == 1.5, position
            assert read["field"].tobytes() == given["field"].tobytes(), position
            assert read["past"][0].tobytes() == np.ones((2, 2)).tobytes(), position
    # what is left is padding, dates and the like
    assert refused > len(whole)


def test_plain_data_cut_short_anywhere_are_refused() -> None:
    file = io.BytesIO()
    write_plain(file, {"field": np.arange(6.0)})
    whole = file.getvalue()
    for end in range(len(whole)):
        with pytest.raises(ValueError, match="damaged"):
            read_plain(io.BytesIO(whole[:end]))


def test_pickled_objects_are_never_loaded() -> None:
    file = io.BytesIO()
    np.savez(file, outline=np.array({"a": 1}, dtype=object))
    with pytest.raises(ValueError, match="damaged, or was written by something else"):
        read_plain(file)
