"""A case of a ball on rubber, and the calculator page in a browser."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

import web.served_page as seen

# A ball of 10 mm radius pressed by 100 N onto a material with G = 1 GPa, nu = 0.5.
BALL = """\
title: Ball on rubber
indenter:
  shape: sphere
  radius: 10 mm   # of the ball
material:
  law: zener
  shear_modulus: 1 GPa
  delayed_modulus: 1 GPa
  viscosity: 10 GPa s
  poisson_ratio: 0.5
load:
  kind: step
  force: 100 N
time:
  end: 100 s
  steps: 12
grid:
  shape: [64, 64]
  size: [4 mm, 4 mm]
"""
# As above, and long enough to be interrupted: ten seconds, and one for its error bars.
LONG = (
    BALL.replace("[64, 64]", "[1536, 1536]").replace("steps: 12", "steps: 150")
    + """\
output: {fields: [0 s, 100 s]}
"""
)


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[seen.Server]:
    with seen.served(tmp_path_factory.mktemp("served")) as server:
        yield server


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with seen.opened_browser() as browser:
        yield browser


@pytest.fixture
def page(browser: Any, server: seen.Server) -> Iterator[Any]:
    """A new visitor's page; whatever goes wrong on it fails the test."""
    page, watched = seen.new_page(browser, server)
    yield page
    page.context.close()
    assert watched.faults == []
    assert watched.outside == []
