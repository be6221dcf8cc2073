"""Reports without their still pictures, for tests of all else in them: most of their time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from xml.etree.ElementTree import Element

import pytest
from matplotlib.figure import Figure

from viscontact.drawing.svg.html import element


def _left_out(draw: Callable[[], Figure], about: str) -> Element:
    image = element("img", src="data:image/svg+xml,", alt=about, width="1", height="1")
    return element("div", image, class_="scroll")


def _framed(draw: Callable[[], Figure], about: str) -> Element:
    return element("figure", _left_out(draw, about), class_="single")


@contextmanager
def pictures_left_out() -> Iterator[None]:
    """Draw no still pictures in a block."""
    with pytest.MonkeyPatch.context() as patched:
        for module in ("drawings", "measured"):
            patched.setattr(f"viscontact.report.{module}.drawn", _left_out)
        patched.setattr("viscontact.report.still_figures.framed", _framed)
        yield


@pytest.fixture
def without_pictures() -> Iterator[None]:
    """Leave the still pictures out of the reports of a test."""
    with pictures_left_out():
        yield
