"""Data that are given as a case are named, whatever their numbers would mean in YAML."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest

from viscontact.case import CaseError, read_case


def _array() -> bytes:
    stream = io.BytesIO()
    np.save(stream, np.zeros((4, 4)))
    return stream.getvalue()


@pytest.mark.parametrize(
    "content", [_array(), b"\n0.1 0.2 -3e-7\n0.1 0.2 0.4\n", b"0,1,2\n" * 20000]
)
def test_a_height_map_is_no_case(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "case.yaml"
    path.write_bytes(content)
    with pytest.raises(CaseError, match=r"no case file|not a text file") as refused:
        read_case(path)
    if not content.startswith(b"\x93"):
        assert "as a table or a height map does" in str(refused.value)
