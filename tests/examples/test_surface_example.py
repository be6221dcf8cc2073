"""The shipped rough ball: it is what its note says, and creeps as theory says."""

from __future__ import annotations

import math
from importlib.resources import as_file, files
from pathlib import Path

import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.case import read_case
from viscontact.cli import main


@pytest.fixture(autouse=True)
def _few_dots(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viscontact.drawing.matplotlib.layout.saving._DOTS_PER_INCH", 80)


def test_patch_is_what_its_note_says() -> None:
    source = files("viscontact.case.examples") / "rough-patch.npz"
    with as_file(source) as file:
        assert file.stat().st_size < 100_000
        patch = vc.read_surface(file)
    assert (patch.shape, patch.periodic) == ((128, 128), True)
    assert patch.size == close_to((128e-6, 128e-6), rel=1e-12)
    assert patch.rms_height == close_to(40e-9, rel=1e-4)  # float32
    spectrum = np.abs(np.fft.fft2(patch.heights)) ** 2
    waves = np.hypot(*np.meshgrid(*[np.fft.fftfreq(128)] * 2, indexing="ij"))
    # No waves shorter than 16 points; a Hurst exponent of 0.8: a power of -3.6 from 32 to 16.
    assert spectrum[waves > 1 / 16].max() < 1e-6 * spectrum.max()
    within = (waves > 1 / 32) & (waves < 1 / 16)
    slope, _ = np.polyfit(np.log(waves[within]), np.log(spectrum[within]), 1)
    # Of 138 independent waves, whose logarithms scatter by pi/sqrt(6) = 1.3 over a range whose
    # logarithm scatters by 0.18: a standard error of 0.6.
    assert slope == close_to(-3.6, abs=1.2)


@pytest.mark.slow
def test_rough_ball_spreads_as_an_elastic_one_of_its_compliance(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copied, directory = tmp_path / "my.yaml", tmp_path / "my"
    assert main(["example", "rough-ball", "-o", str(copied)]) == 0
    assert (tmp_path / "rough-patch.npz").exists()
    assert main(["check", str(copied)]) == 0
    said = capsys.readouterr().out
    assert "no problems found" in said
    assert "rough-patch.npz is periodic" in said
    assert main(["run", str(copied), "--quiet", "--set", "output.errors=false"]) == 0
    for figure in ("contact-outline", "pressure-map"):
        assert main(["plot", str(directory), figure]) == 0
    with vc.open_results(directory) as results:
        ds = results.load()
    case = read_case(copied)
    # While a contact has only grown, it is that of an elastic body under int J(t-t') dW (Lee &
    # Radok 1960), whatever its shape: ramped in 1 s, W times J's mean over the lags 999 to 1000 s.
    lags = np.linspace(999.0, 1000.0, 11)
    mean_J = np.trapezoid(case.material.contact_compliance()(lags), lags)
    elastic = vc.Material(vc.Elastic(0.5 * (1 - 0.3) / mean_J), 0.3)
    grid = case.grid
    relaxed = vc.simulate(case.indenter, elastic, vc.step(60e-3), grid, [0.0], fields="none")
    # Approach and area are sums over increments, exact in the steps: the solver's 1e-6 is left.
    assert float(ds.approach[-1]) == close_to(float(relaxed.approach[0]), rel=1e-5)
    assert float(ds.contact_area[-1]) == close_to(float(relaxed.contact_area[0]), rel=1e-4)
    # Less than a smooth ball's, Hertz: a^3 = (3/4) R W J.
    smooth = math.pi * (0.75 * 2e-3 * 60e-3 * mean_J) ** (2 / 3)
    assert 0.5 * smooth < float(ds.contact_area[-1]) < smooth
