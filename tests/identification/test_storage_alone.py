"""Series from the storage modulus alone, which determines the losses (Kramers-Kronig)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from closeness import close_to
from viscontact.bodies.series_fits.prony import fit_dynamic
from viscontact.case import read_material
from viscontact.cli import main
from viscontact.laws import RelaxationSeries

LAW = RelaxationSeries(5e8, [6e7, 8e7, 1.2e8], [0.004, 0.05, 1.2])
FREQUENCIES = np.geomspace(0.6, 600.0, 14)
MODULUS = LAW.complex_modulus(FREQUENCIES)


def test_exact_storage_gives_the_series_and_its_losses() -> None:
    fit = fit_dynamic(FREQUENCIES, MODULUS.real, data="shear")
    assert fit.measured.keys() == {"storage"}
    assert fit.law.times == close_to([0.004, 0.05, 1.2], rel=1e-3)
    assert fit.law.equilibrium == close_to(5e8, rel=1e-3)
    np.testing.assert_allclose(fit.law.complex_modulus(FREQUENCIES).imag, MODULUS.imag, rtol=2e-3)


def test_scattered_storage_gives_losses_in_the_middle_to_a_part_of_them() -> None:
    noise = np.random.default_rng(5).standard_normal(FREQUENCIES.size)
    fit = fit_dynamic(FREQUENCIES, MODULUS.real * (1 + 2e-3 * noise), data="shear", tolerance=2e-3)
    middle = slice(3, -3)
    losses = fit.law.complex_modulus(FREQUENCIES).imag
    # Of 40 seeds the largest deviation is 6.6 % there, and 26 % at the ends.
    np.testing.assert_allclose(losses[middle], MODULUS.imag[middle], rtol=0.07)


def test_weights_of_a_loss_that_is_not_measured_are_refused() -> None:
    with pytest.raises(ValueError, match="weights are those of storage, got one of 'loss'"):
        fit_dynamic(FREQUENCIES, MODULUS.real, data="shear", weights={"loss": 2.0})


def test_command_and_case_take_a_table_of_storage_and_state_what_is_missing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = zip(FREQUENCIES.tolist(), MODULUS.real.tolist(), strict=True)
    text = "\n".join(["omega (rad/s),Storage Modulus (Pa)", *(f"{w:.9g},{g:.9g}" for w, g in rows)])
    (tmp_path / "dma.csv").write_text(text)
    out = ["--data", "shear", "--poisson-ratio", "0.4", "--yaml", str(tmp_path / "law.yaml")]
    assert main(["fit", str(tmp_path / "dma.csv"), *out, "-o", str(tmp_path / "fit.png")]) == 0
    said = " ".join(capsys.readouterr().err.split())
    assert "dma.csv: there is no loss modulus: the losses of the law follow from" in said
    found = read_material(tmp_path / "law.yaml")
    assert found.law.complex_modulus(10.0).imag == close_to(
        LAW.complex_modulus(10.0).imag, rel=5e-3
    )
    (tmp_path / "case.yaml").write_text(
        "material: {law: table, file: dma.csv, data: shear, poisson_ratio: 0.4}\n"
    )
    direct = read_material(tmp_path / "case.yaml")
    assert direct.law.complex_modulus(10.0).imag == close_to(
        found.law.complex_modulus(10.0).imag, rel=1e-3
    )
