"""Writer of animations to GIF and MP4 files."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from contextlib import closing
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from numpy.typing import NDArray
from PIL import Image

try:
    from imageio_ffmpeg import write_frames
except ModuleNotFoundError:  # needed for MP4 only
    write_frames = None

from viscontact.drawing.matplotlib.animations.animation import Animation
from viscontact.drawing.matplotlib.layout.saving import require_suffix

#: Formats of animations.
ANIMATION_SUFFIXES = (".gif", ".mp4")

#: Dots per inch: fewer for GIF, to limit its size.
_DOTS = {".gif": 100, ".mp4": 150}
#: GIF counts time in hundredths of a second.
_TICKS = 100
_COLOURS = 128
# Grey level from which on a colour is the background.
_WHITE = 248

#: Frames done, and how many there are.
Progress = Callable[[int, int], None]
Picture = NDArray[np.uint8]


def save_animation(
    animation: Animation, path: str | PathLike[str], progress: Progress = lambda done, total: None
) -> None:
    """Write an animation to a file.

    Parameters
    ----------
    animation : Animation
        Result of `animation`.
    path : path-like
        The file, in the format of its suffix: .gif or .mp4.
    progress : callable, optional
        Called with (frames done, frames) after each frame.

    Raises
    ------
    ValueError
        If the suffix is not one of these, or the encoder of MP4 is not installed.
    OSError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> import viscontact as vc
    >>> rubber = vc.Material(vc.Elastic(1e6), poisson_ratio=0.5)
    >>> grid = vc.Grid((24, 24), (2e-3, 2e-3))
    >>> ds = vc.simulate(vc.Sphere(0.01), rubber, vc.step(0.1), grid, [0.0, 1.0], errors=False)
    >>> from viscontact.drawing.matplotlib import animation
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_animation(animation(ds, seconds=1.0, fps=2.0), Path(folder) / "ball.gif")
    ...     (Path(folder) / "ball.gif").read_bytes()[:6]
    b'GIF89a'
    """
    suffix = require_suffix(path, ANIMATION_SUFFIXES)
    write = {".gif": _write_gif, ".mp4": _write_mp4}[suffix]
    # Written to another file first, so that an interrupted animation leaves none.
    aside = Path(path).with_name(f".{Path(path).stem}.part{suffix}")
    try:
        write(animation, aside, _pictures(animation, _DOTS[suffix], progress))
        aside.replace(path)
    finally:
        aside.unlink(missing_ok=True)


def _pictures(animation: Animation, dots: int, progress: Progress) -> Iterator[tuple[Picture, int]]:
    """Draw each picture once, with the number of its frames."""
    animation.figure.set_dpi(dots)
    canvas: Any = FigureCanvasAgg(animation.figure)  # not typed by its authors
    done = 0
    for instant, same in itertools.groupby(animation.instants.tolist()):
        animation.show(instant)
        canvas.draw()
        count = len(list(same))
        yield np.ascontiguousarray(np.asarray(canvas.buffer_rgba())[..., :3]), count
        done += count
        progress(done, animation.instants.size)


def _write_gif(animation: Animation, path: Path, pictures: Iterator[tuple[Picture, int]]) -> None:
    shown = list(pictures)
    palette = _palette([picture for picture, _ in shown])
    frames = [
        Image.fromarray(picture).quantize(palette=palette, dither=Image.Dither.NONE)
        for picture, _ in shown
    ]
    ends = np.cumsum([count for _, count in shown]) / animation.frames_per_second
    ticks = np.diff(np.rint(_TICKS * ends).astype(int), prepend=0)
    frames[0].save(
        path,
        save_all=True,
        append_images=frames[1:],
        duration=[int(1000 / _TICKS * tick) for tick in ticks],
        loop=0,
        optimize=False,
    )


def _palette(pictures: list[Picture]) -> Image.Image:
    """Common palette of all frames, so that unchanged areas are not stored again."""
    chosen = pictures[:: max(1, len(pictures) // 6)]
    palette = Image.fromarray(np.concatenate(chosen)).quantize(_COLOURS)
    colours = np.reshape(palette.getpalette() or [], (-1, 3))
    # The background is exactly white, not the mean of white and the edges of letters.
    colours[colours.min(axis=1) >= _WHITE] = 255
    palette.putpalette(colours.ravel().tolist())
    return palette


def _write_mp4(animation: Animation, path: Path, pictures: Iterator[tuple[Picture, int]]) -> None:
    if write_frames is None:
        raise ValueError(
            "MP4 needs imageio-ffmpeg: pip install 'viscontact[animation]'; or name a file .gif"
        )
    # The message of the encoder would be many lines long.
    if not path.parent.is_dir():
        raise FileNotFoundError(f"there is no directory {path.parent}")
    first, frames = next(pictures)
    height, width, _ = first.shape
    encoder = write_frames(
        str(path),
        (width, height),
        fps=animation.frames_per_second,
        codec="libx264",
        quality=None,
        # Quality for clean thin lines; playable while loading.
        output_params=["-crf", "20", "-movflags", "+faststart"],
        macro_block_size=2,
        ffmpeg_log_level="error",
    )
    with closing(encoder):
        encoder.send(None)
        for picture, count in itertools.chain([(first, frames)], pictures):
            for _ in range(count):
                encoder.send(picture)
