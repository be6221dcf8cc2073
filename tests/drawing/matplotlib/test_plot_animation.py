"""Animations: frames and files."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
import xarray as xr
from PIL import Image

from closeness import close_to
from returned import some
from synthetic_results import maxwell_sphere, roller
from viscontact.cli import main
from viscontact.drawing.matplotlib.animations import saving
from viscontact.plot import animation, save_animation
from viscontact.results.variables import SCALARS


@pytest.fixture(scope="module")
def sphere() -> xr.Dataset:
    return maxwell_sphere([0.0, 1.0, 3.0, 10.0, 30.0, 100.0], cells=16)


@pytest.mark.parametrize("scale", ["linear", "symlog"])
def test_frames_are_at_equal_steps_of_the_time_axis(scale: str) -> None:
    middle = [20.0, 30.0, 60.0, 90.0] if scale == "linear" else [0.1, 0.3, 1.0, 10.0]
    sphere = maxwell_sphere([0.0, *middle, 100.0], cells=12)
    film = animation(sphere, seconds=6.0, fps=10.0)
    assert film.instants.size == 60
    assert film.seconds == close_to(6.0)
    assert film.instants[0] == 0.0
    assert film.instants[-1] == 100.0
    assert np.all(np.diff(film.instants) >= 0)
    # Where the axis of the histories says that an instant is, there its frames are.
    axes = next(axes for axes in film.figure.axes if axes.get_xlabel().startswith("Time"))
    assert axes.get_xscale() == scale
    place = axes.transData.transform([(t, axes.get_ylim()[0]) for t in sphere.time.values])[:, 0]
    wanted = np.linspace(place[0], place[-1], 60)
    nearest = sphere.time.values[np.abs(place - wanted[:, None]).argmin(axis=1)]
    np.testing.assert_array_equal(film.instants, nearest)


def test_section_has_room_for_the_largest_pressure_of_all_frames(sphere: xr.Dataset) -> None:
    """That of the first one: the pressure falls while a Maxwell body creeps."""
    section = animation(sphere, seconds=1.0, fps=6.0).figure.axes[2]
    unit = {"kPa": 1e3, "MPa": 1e6}[section.get_ylabel()[-4:-1]]
    assert float(sphere.pressure[0].max()) == float(sphere.pressure.max())
    assert section.get_ylim()[1] * unit > 0.99 * float(sphere.pressure.max())


def test_each_frame_shows_the_numbers_of_its_instant(sphere: xr.Dataset) -> None:
    film = animation(sphere, seconds=1.0, fps=6.0)
    surface, _, section, *histories = film.figure.axes
    for instant in (30.0, 3.0):
        film.show(instant)
        then = sphere.sel(time=instant)
        assert surface.get_title(loc="left") == f"t = {instant:g} s"
        at, pressure = section.get_lines()[0].get_data()
        middle = then.pressure.isel(y=[7, 8]).mean("y").values
        unit = {"kPa": 1e3, "MPa": 1e6}[section.get_ylabel()[-4:-1]]
        np.testing.assert_allclose(pressure, middle / unit, rtol=1e-12)
        assert at[0] < 0 < at[-1]
        # One contact at a time: what was drawn before is gone.
        assert len(surface.patches) == 1
        for axes, name in zip(
            histories, ("peak_pressure", "contact_area", "approach"), strict=True
        ):
            bar, dot = axes.get_lines()[-2:]
            assert np.asarray(bar.get_xdata()) == close_to(instant)
            curve = axes.get_lines()[0].get_ydata()
            here = int(np.flatnonzero(sphere.time.values == instant)[0])
            assert dot.get_ydata()[0] == curve[here]
            assert curve[here] / curve[0] == close_to(float(then[name]) / float(sphere[name][0]))


def test_an_instant_without_contact_is_shown_empty(sphere: xr.Dataset) -> None:
    lifted = sphere.copy(deep=True)
    lifted["pressure"][-1] = 0.0
    for name in ("peak_pressure", "contact_area", "contact_length", "force"):
        lifted[name][-1] = 0.0
    film = animation(lifted, seconds=1.0, fps=4.0)
    film.show(100.0)
    surface = film.figure.axes[0]
    assert surface.get_title(loc="left") == "t = 100 s, no contact"
    assert not surface.patches
    lifted["pressure"][:] = 0.0
    with pytest.raises(ValueError, match="animation: the bodies do not touch"):
        animation(lifted)


def test_a_gif_has_the_requested_length_and_a_frame_for_each_instant(
    sphere: xr.Dataset, tmp_path: Path
) -> None:
    seen: list[tuple[int, int]] = []
    path = tmp_path / "film.gif"
    film = animation(sphere, seconds=3.1, fps=7.0)
    shown = len(set(film.instants.tolist()))
    assert shown >= 5
    save_animation(film, path, lambda *done: seen.append(done))
    with Image.open(path) as read:
        assert read.n_frames == shown
        durations = []
        for number in range(read.n_frames):
            read.seek(number)
            durations.append(read.info["duration"])
        assert read.info["loop"] == 0
        assert read.size[0] == 720
        assert read.convert("RGB").getpixel((1, 1)) == (255, 255, 255)
    assert sum(durations) == close_to(1000 * 22 / 7.0, abs=10)
    assert seen[-1] == (22, 22)
    assert [done for done, _ in seen] == sorted(done for done, _ in seen)
    assert [file.name for file in tmp_path.iterdir()] == ["film.gif"]


@pytest.mark.slow
def test_an_mp4_has_the_requested_frames(sphere: xr.Dataset, tmp_path: Path) -> None:
    path = tmp_path / "film.mp4"
    save_animation(animation(sphere, seconds=1.0, fps=5.0, width=0.12), path)
    frames, seconds = imageio_ffmpeg.count_frames_and_secs(path)
    assert frames == 5
    assert seconds == close_to(1.0, abs=0.05)
    said = subprocess.run(
        [imageio_ffmpeg.get_ffmpeg_exe(), "-i", path], capture_output=True, text=True, check=False
    ).stderr
    # What browsers and slides play: H.264, colours in half resolution, even sides.
    assert re.search(r"Video: h264 .*yuv420p", said)
    width, height = map(int, re.search(r" (\d+)x(\d+)[, ]", said).groups())
    assert width % 2 == height % 2 == 0
    assert width == close_to(0.12 / 25.4e-3 * 150, abs=6)


def test_a_film_of_a_long_contact_holds_its_labels(tmp_path: Path) -> None:
    figure = animation(roller(shape=(48, 16)), seconds=1.0, fps=5.0, width="single").figure
    figure.draw_without_rendering()
    for axes in some(figure.axes):
        box = axes.get_tightbbox()
        assert box.x0 >= 0
        assert box.y0 >= 0
        assert box.x1 <= figure.bbox.x1
        assert box.y1 <= figure.bbox.y1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"fps": 0.0}, "fps must be above 0, got 0"),
        ({"seconds": np.nan}, "seconds must be above 0"),
        ({"seconds": 0.01}, "2 to 5000 frames"),
        ({"times": [30.0, 31.0]}, "at least two steps"),
    ],
)
def test_invalid_animation_is_refused(
    options: dict[str, float], message: str, sphere: xr.Dataset
) -> None:
    with pytest.raises(ValueError, match=rf"animation: .*{message}"):
        animation(sphere, **options)


def test_a_film_that_cannot_be_written_leaves_nothing(sphere: xr.Dataset, tmp_path: Path) -> None:
    film = animation(sphere, seconds=1.0, fps=2.0)
    with pytest.raises(ValueError, match=r"must end in \.gif or \.mp4"):
        save_animation(film, tmp_path / "film.png")
    for name in ("no/film.gif", "no/film.mp4"):
        with pytest.raises(OSError, match="no"):
            save_animation(film, tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_missing_encoder_is_named_with_its_extra(
    sphere: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(saving, "write_frames", None)
    film = animation(sphere, seconds=1.0, fps=2.0)
    with pytest.raises(ValueError, match=r"pip install 'viscontact\[animation\]'"):
        save_animation(film, tmp_path / "film.mp4")
    save_animation(film, tmp_path / "film.gif")
    assert [file.name for file in tmp_path.iterdir()] == ["film.gif"]


# --- the command -------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def run(sphere: xr.Dataset, tmp_path_factory: pytest.TempPathFactory) -> str:
    directory = tmp_path_factory.mktemp("run")
    zeros = ("time", np.zeros(sphere.sizes["time"]))
    missing = [name for name in SCALARS if name not in sphere]
    sphere.assign(dict.fromkeys(missing, zeros)).to_netcdf(directory / "result.nc")
    return str(directory)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["animaton"], "no figure is called 'animaton'; did you mean animation?"),
        (["animation", "-o", "a.png"], "must end in .gif or .mp4"),
        (["history", "-o", "a.gif"], "must end in .png, .pdf or .svg"),
        (["history", "--fps", "3"], "--fps: does not apply to the figure history"),
        (["animation", "--along", "y"], "--along: does not apply to the figure animation"),
        (["history", "--width", "5 MPa"], "or write single (89 mm) or double (183 mm)"),
        (["history", "--width", "5 mm"], "from 60 mm to 1.2 m"),
        (["pressure-profile", "--along", "z"], "along must be 'x' or 'y'"),
        (["animation", "--seconds", "-1"], "seconds must be above 0"),
    ],
)
def test_the_command_refuses_in_one_line(
    arguments: list[str], message: str, run: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", run, *arguments]) == 2
    said = capsys.readouterr().err.strip()
    assert message in said
    assert "\n" not in said


@pytest.mark.slow
def test_the_command_writes_a_film_into_the_run(
    run: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", run, "animation", "--seconds", "2", "--fps", "15"]) == 0
    said = capsys.readouterr()
    assert said.out.strip() == str(Path(run) / "animation.gif")
    assert "30 frames show 5 stored instants" in said.err
    assert (Path(run) / "animation.gif").read_bytes().startswith(b"GIF89a")
