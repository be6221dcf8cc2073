"""All modules, and the packages of all extras, are imported in the versions installed."""

from __future__ import annotations

import importlib
import pkgutil

import pytest

import viscontact
from returned import some

#: Packages that are imported where they are needed only; tests without them would be skipped.
DEFERRED = (
    *("matplotlib", "plotly", "PIL", "imageio_ffmpeg", "SurfaceTopography", "afmformats"),
    *("fastapi", "uvicorn", "typst", "ezdxf", "distributed"),
)


def test_every_module_is_imported() -> None:
    names = [each.name for each in pkgutil.walk_packages(viscontact.__path__, "viscontact.")]
    for name in some([name for name in names if not name.endswith("__main__")]):
        assert importlib.import_module(name).__name__ == name


@pytest.mark.parametrize("name", DEFERRED)
def test_packages_of_extras_are_imported(name: str) -> None:
    assert importlib.import_module(name).__name__ == name
