"""Force curves of instrument files: against what the files state, and what was written."""

from __future__ import annotations

import csv
import zipfile
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest

import viscontact as vc
from closeness import close_to
from viscontact.cli import main
from viscontact.identification.instrument_curves import is_instrument_file, split_number

pytest.importorskip("afmformats")

# Curve of a cell on a JPK CellHesion 200; cell.jpk-force.txt has its source and license.
CELL = Path(__file__).with_name("cell.jpk-force")


def stated(name: str) -> float:
    """Number in the header of the file."""
    with zipfile.ZipFile(CELL) as archive:
        for part in ("header.properties", "segments/0/segment-header.properties"):
            for line in archive.read(part).decode().splitlines():
                if line.startswith(name + "="):
                    return float(line.partition("=")[2])
    raise KeyError(name)


def test_curve_of_jpk_has_the_times_and_the_setpoint_of_its_header():
    curve = vc.read_force_curve(CELL)
    points = int(stated("force-segment-header.num-points"))
    assert curve.times.size == 2 * points
    # Approach and retraction of one second each; the clock of a segment starts at 0.
    assert stated("force-segment-header.duration") == close_to(1.0)
    assert np.ptp(curve.times) == close_to(2.0, rel=1e-3)
    assert curve.spring_constant == close_to(0.0434937, rel=1e-5)
    # The approach stops when the force above the baseline reaches the setpoint. It is sampled
    # every 0.5 ms, in which the piezo moves by 2.5 nm; the rest is drift of the baseline.
    force = curve.spring_constant * curve.deflection
    assert force.max() - force[: points // 4].mean() == close_to(4e-9, rel=0.08)
    assert np.argmax(force) == close_to(points, rel=0.01)


def test_contact_point_is_where_the_force_leaves_the_baseline():
    curve = vc.read_force_curve(CELL)
    contact = vc.find_contact(curve, vc.Sphere(2.5e-6))
    force = curve.spring_constant * curve.deflection[: curve.loading_rows]
    position = curve.position[: curve.loading_rows]
    far = position < contact.position - 2e-7
    # Before contact the force scatters about a line; behind it, it rises above the scatter.
    line = np.polyfit(position[far], force[far], 1)
    rest = force - np.polyval(line, position)
    scatter = rest[far].std()
    assert scatter == close_to(contact.noise * curve.spring_constant, rel=0.2)
    behind = rest[position > contact.position + 1e-7]
    assert behind.size > 50
    assert behind.min() > 5 * scatter


def written(path: Path, curves: int = 1, **changed: object) -> tuple[np.ndarray, ...]:
    """Write curves in the HDF5 of afmformats, each with a larger force than the one before.

    Return times, height and bending of the first one.
    """
    times = np.linspace(0.0, 1.0, 200)
    height = 5e-6 - 4e-6 * times
    bending = np.maximum(3e-6 - height, 0.0) * 0.3
    columns = {"time": times, "force": 0.1 * bending, "height (piezo)": height}
    metadata = {"spring constant": 0.1, "imaging mode": "force-distance", **changed}
    with h5py.File(path, "w") as file:
        file.attrs.update({"software": "afmformats", "software version": "0.18.7"})
        for number in range(curves):
            curve = file.create_group(str(number))
            curve.attrs.update({k: v for k, v in metadata.items() if v is not None})
            for name, values in columns.items():
                curve[name] = (number + 1) * values if name == "force" else values
    return times, height, bending


def test_a_later_spring_constant_changes_the_force_and_not_the_deflection(tmp_path):
    times, height, bending = written(tmp_path / "one.h5")
    curve = vc.read_force_curve(tmp_path / "one.h5")
    other = vc.read_force_curve(tmp_path / "one.h5", spring_constant=0.2)
    np.testing.assert_allclose(curve.times, times, atol=1e-12)
    np.testing.assert_allclose(curve.position, -height, rtol=1e-6)  # turned over
    np.testing.assert_allclose(curve.deflection, bending, rtol=1e-6, atol=1e-16)
    np.testing.assert_array_equal(other.deflection, curve.deflection)
    assert (curve.spring_constant, other.spring_constant) == (0.1, 0.2)


def test_curves_of_a_map_are_named_by_their_numbers(tmp_path):
    _, _, bending = written(tmp_path / "map.h5", curves=11)
    with pytest.raises(ValueError, match=r"has 11 curves; name one by its number, map.h5#0 to"):
        vc.read_force_curve(tmp_path / "map.h5")
    for number in (2, 10):
        curve = vc.read_force_curve(f"{tmp_path}/map.h5#{number}")
        np.testing.assert_allclose(curve.deflection, (number + 1) * bending, rtol=1e-6, atol=1e-16)
    with pytest.raises(ValueError, match=r"map.h5: has no curve 11; the last one is 10"):
        vc.read_force_curve(f"{tmp_path}/map.h5#11")


def gel_map(path: Path, moduli: np.ndarray, untouched: int, **stated: object) -> None:
    """Map of Hertz's curves for moduli of shape (across, along), numbered along x first [Pa]."""
    times, far = np.linspace(0.0, 1.0, 240), np.linspace(0.0, 2e-6, 120)
    depth = np.linspace(0.0, 8e-7, 120)
    noise = np.random.default_rng(3)
    with h5py.File(path, "w") as file:
        file.attrs.update({"software": "afmformats", "software version": "0.18.7"})
        for number, modulus in enumerate(moduli.T.ravel()):
            i, j = number % moduli.shape[0], number // moduli.shape[0]
            bent = 4 / 3 * modulus / 0.75 * np.sqrt(5e-6) * depth**1.5 / 0.1
            bent = np.concatenate([0 * far, bent if number != untouched else 0 * bent])
            position = np.concatenate([far, 2e-6 + depth]) + bent
            curve = file.create_group(str(number))
            curve.attrs.update({"spring constant": 0.1, "imaging mode": "force-distance"})
            curve.attrs.update({"grid index x": i, "grid index y": j, **stated})
            curve["time"], curve["height (piezo)"] = times, 5e-6 - position
            curve["force"] = 0.1 * (bent + 1e-10 * noise.standard_normal(bent.size))


MODULI = 1e3 * (1 + np.add.outer(np.arange(3), 0.1 * np.arange(2)))
GRID = {f"grid {key} {axis}": value for key, value in (("center", 5e-6),) for axis in "xy"}
GRID |= {"grid shape x": 3, "grid shape y": 2, "grid size x": 3e-6, "grid size y": 2e-6}


def test_a_map_gives_all_curves_with_their_places(tmp_path):
    gel_map(tmp_path / "gel.h5", MODULI, -1, **GRID)
    gel = vc.read_force_map(tmp_path / "gel.h5")
    assert list(gel.curves) == [f"gel.h5#{number}" for number in range(6)]
    assert not gel.failures
    # Numbers go along x first; the centre of the grid is at 5 um.
    assert gel.places["gel.h5#0"] == close_to((4e-6, 4.5e-6), rel=1e-9)
    assert gel.places["gel.h5#5"] == close_to((6e-6, 5.5e-6), rel=1e-9)
    alone = vc.read_force_curve(f"{tmp_path}/gel.h5#4")
    np.testing.assert_array_equal(gel.curves["gel.h5#4"].deflection, alone.deflection)


def test_a_map_is_fitted_to_a_table_and_drawn_over_its_places(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    gel_map(tmp_path / "gel.h5", MODULI, 2, **GRID)
    options = ["--indenter", "sphere 5 um", "--law", "elastic", "--poisson-ratio", "0.5"]
    assert main(["fit", "gel.h5", *options, "-o", "gel.png", "-j", "1"]) == 0
    printed = capsys.readouterr()
    assert "5 of 6 curves" in printed.out
    assert "gel.h5#2: " in printed.err
    with Path("fits.csv").open(encoding="utf-8", newline="") as file:
        rows = {row["curve"]: row for row in csv.DictReader(file)}
    for number, modulus in enumerate(MODULI.T.ravel()):
        row = rows[f"gel.h5#{number}"]
        assert float(row["x [m]"]) == close_to((4 + number % 3) * 1e-6)
        assert float(row["y [m]"]) == close_to((4.5 + number // 3) * 1e-6)
        if number != 2:
            assert float(row["youngs_modulus [Pa]"]) == close_to(modulus, rel=0.01)
    assert Path("gel.png").stat().st_size > 10_000
    assert main(["fit", "gel.h5", "--law", "elastic"]) == 2
    assert "gel.h5 has several curves: give --indenter" in capsys.readouterr().err


def test_curves_without_a_place_are_fitted_without_maps(tmp_path):
    gel_map(tmp_path / "gel.h5", MODULI[:2], -1)
    gel = vc.read_force_map(tmp_path / "gel.h5")
    assert not gel.places
    assert repr(gel) == "ForceMap: 4 curves, 0 with places, 0 that cannot be read"
    records = {
        name: vc.find_contact(curve, vc.Sphere(5e-6)).record() for name, curve in gel.curves.items()
    }
    fits = vc.fit_each(
        lambda record: vc.fit_indentation(record, "elastic", poisson_ratio=0.5),
        records,
        places=gel.places,
    )
    labels = [axes.get_xlabel() for axes in vc.plot.curve_fits(fits).axes]
    assert labels == ["Shear modulus [Pa]", "Young's modulus [kPa]"]
    # A map of a parameter that only curves without a place have is left out.
    placed = replace(fits.curves[0], values={}, place=(0.0, 0.0))
    mixed = vc.identification.CurveFits((placed, *fits.curves[1:]))
    assert len(vc.plot.curve_fits(mixed).axes) == 2


def test_maps_of_one_name_keep_all_curves_and_a_bad_one_only_fails_itself(
    tmp_path, capsys, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        gel_map(tmp_path / folder / "gel.h5", MODULI[:1], -1, **GRID)
    written(tmp_path / "k.h5", curves=2, **{"spring constant": None})
    options = ["--indenter", "sphere 5 um", "--law", "elastic", "--poisson-ratio", "0.5"]
    assert main(["fit", "a/gel.h5", "b/gel.h5", "k.h5", *options, "-j", "1"]) == 0
    assert "k.h5" in capsys.readouterr().err
    with Path("fits.csv").open(encoding="utf-8", newline="") as file:
        names = [row["curve"] for row in csv.DictReader(file) if row["shear_modulus [Pa]"]]
    assert names == [f"{folder}/gel.h5#{number}" for folder in "ab" for number in range(2)]
    assert main(["fit", "k.h5", *options]) == 2
    assert "none of " in capsys.readouterr().err


def test_a_curve_of_a_map_that_lacks_a_column_is_named_and_the_others_are_read(tmp_path):
    written(tmp_path / "map.h5", curves=3)
    with h5py.File(tmp_path / "map.h5", "a") as file:
        del file["1"]["height (piezo)"]
    gel = vc.read_force_map(tmp_path / "map.h5")
    assert list(gel.curves) == ["map.h5#0", "map.h5#2"]
    assert gel.failures == {"map.h5#1": "map.h5: states no position; there are force, time"}


def test_a_table_is_a_force_curve_with_a_spring_constant(tmp_path):
    path = tmp_path / "gel.csv"
    bent = 2 * np.concatenate([np.arange(12), np.arange(12)[::-1]])
    rows = "".join(f"{i},{each},{each}\n" for i, each in enumerate(bent))
    path.write_text(f"time [s],position [um],deflection [nm]\n{rows}")
    curve = vc.read_force_curve(path, spring_constant=0.1)
    assert curve.spring_constant == 0.1
    np.testing.assert_allclose(curve.deflection, 1e-9 * bent)
    with pytest.raises(ValueError, match=r"gel.csv: a table needs spring_constant=, in N/m"):
        vc.read_force_curve(path)


def test_files_that_cannot_be_used_are_refused_by_name(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"none.jpk-force: there is no such file"):
        vc.read_force_curve(tmp_path / "none.jpk-force")
    (tmp_path / "bad.jpk-force").write_bytes(CELL.read_bytes()[:9000])
    with pytest.raises(ValueError, match=r"^bad.jpk-force: cannot be read as force curves; the fi"):
        vc.read_force_curve(tmp_path / "bad.jpk-force")
    written(tmp_path / "k.h5", **{"spring constant": None})
    with pytest.raises(ValueError, match=r"k.h5: states no spring constant"):
        vc.read_force_curve(tmp_path / "k.h5")


def without(path: Path, part: str) -> Path:
    """Copy of the cell's file whose headers have no line with a part of a property's name."""
    with zipfile.ZipFile(CELL) as old, zipfile.ZipFile(path, "w") as new:
        for entry in old.infolist():
            content = old.read(entry)
            if entry.filename.endswith(".properties"):
                kept = [line for line in content.splitlines(True) if part.encode() not in line]
                content = b"".join(kept).replace(b"list=distance force", b"list=distance")
            new.writestr(entry, content)
    return path


def test_a_given_spring_constant_is_used_where_a_file_has_none(tmp_path):
    bare = without(tmp_path / "bare.jpk-force", "conversion.force.scaling")
    with pytest.raises(ValueError, match="spring constant; give it") as caught:
        vc.read_force_curve(bare)
    assert str(caught.value).startswith("bare.jpk-force: ")
    own, given = vc.read_force_curve(CELL), vc.read_force_curve(bare, spring_constant=0.05)
    assert given.spring_constant == close_to(0.05)
    np.testing.assert_allclose(given.deflection, own.deflection, rtol=1e-6, atol=1e-15)
    *_, bending = written(tmp_path / "k.h5", **{"spring constant": None})
    curve = vc.read_force_curve(tmp_path / "k.h5", spring_constant=0.1)
    np.testing.assert_allclose(curve.deflection, bending, rtol=1e-6, atol=1e-16)


@pytest.mark.parametrize("part", ["volts", "num-points", "height"])
def test_damaged_files_are_refused_in_one_sentence_and_nothing_else_is_printed(
    part, tmp_path, capfd, caplog
):
    tip = ["--indenter", "sphere 5 um", "--poisson-ratio", "0.5"]
    assert main(["fit", str(without(tmp_path / "bad.jpk-force", part)), *tip]) == 2
    said = capfd.readouterr()
    assert said.err.count("bad.jpk-force") == 1
    for word in ("Traceback", "index out of range", "Error", str(tmp_path)):
        assert word not in said.err + said.out
    assert not caplog.records


def test_fit_takes_the_file_of_an_instrument(tmp_path, capsys):
    options = ["--indenter", "sphere 2.5 um", "--poisson-ratio", "0.5", "--law", "elastic"]
    written_to = tmp_path / "cell.yaml"
    assert main(["fit", str(CELL), *options, "--yaml", str(written_to)]) == 0
    said = capsys.readouterr()
    assert "ContactPoint: at -18.055 µm" in said.out
    assert "law: elastic" in written_to.read_text(encoding="utf-8")
    for idle in (["--sensitivity", "50 nm/V"], ["--stress", "5 MPa"], ["--columns", "time [s]"]):
        assert main(["fit", str(CELL), *options, *idle]) == 2
        said = capsys.readouterr().err
        assert f"cell.jpk-force: {idle[0]} goes with " in said
        assert f"this is a force curve in a file of an instrument; leave {idle[0]} out" in said
    assert main(["fit", str(CELL), "--poisson-ratio", "0.5"]) == 2
    assert "cell.jpk-force: an indentation record needs --indenter" in capsys.readouterr().err


def test_number_of_a_curve_is_behind_the_name_of_its_file():
    named = Path("a/map.jpk-force-map#12")
    assert split_number(named) == (Path("a/map.jpk-force-map"), 12)
    assert is_instrument_file(named)
    assert is_instrument_file(Path("cell.jpk-force"))
    assert not is_instrument_file(Path("cell.csv"))
