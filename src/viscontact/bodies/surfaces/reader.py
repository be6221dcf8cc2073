"""Reader of measured surfaces, by file type."""

from __future__ import annotations

import math
from collections.abc import Callable
from os import PathLike
from pathlib import Path

from viscontact.bodies.surfaces.array_files import read_array
from viscontact.bodies.surfaces.cropping import swept
from viscontact.bodies.surfaces.instrument_files import read_instrument
from viscontact.bodies.surfaces.plausibility import require_possible
from viscontact.bodies.surfaces.surface import Surface
from viscontact.bodies.surfaces.text_files import TABLES, read_text_map
from viscontact.bodies.surfaces.units import Units
from viscontact.tables import is_spreadsheet, require_file, split_sheet
from viscontact.units.numbers import as_real

_ARRAYS = (".npy", ".npz")
_ARRAY = b"\x93NUMPY"
# A text has none of these bytes; UTF-16 has zeros, and begins with a mark or is named as a table.
_NO_TEXT = bytes(range(9)) + bytes(range(14, 32))
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_SAMPLED = 4096


def read_surface(
    path: str | PathLike[str],
    *,
    spacing: float | tuple[float, float] | None = None,
    height_unit: str | None = None,
    height_factor: float = 1.0,
    channel: str | None = None,
    width: float | None = None,
) -> Surface:
    r"""Read a measured surface without changing its heights.

    Parameters
    ----------
    path : path-like
        The file: NPY, NPZ, a text of numbers or a spreadsheet, with its sheet behind ``#``; or any
        that SurfaceTopography reads, with the extra ``surfaces``: X3P, SUR, GWY, OPD, AL3D, DI,
        netCDF and others.
    spacing : float or pair of float, optional
        Distance of the points along x and y, where the file does not state it [m].
    height_unit : str, optional
        Unit of the heights, where the file does not state it, e.g. ``"um"``.
    height_factor : float, optional
        Factor of the heights, to correct a wrong unit or sign.
    channel : str, optional
        Which of several channels or arrays; the file's own choice when left out.
    width : float, optional
        For a line scan: how wide it is swept across, as a lay of ridges [m].

    Returns
    -------
    Surface
        With NaN where no height is known; neither levelled nor filled. Its `notes` state values
        that were taken for marks of missing points.

    Raises
    ------
    ValueError
        If the file cannot be read or holds no heights, a unit is missing, or is given where the
        file has one; if no surface has such a size, as that of a map of 160 m.

    Notes
    -----
    Texts and spreadsheets are told apart by their content. The first index of arrays runs along x.
    In a table of bare numbers each row is a scan line along x, and the next one lies farther along
    y, unless the numbers are points: three columns of which the first two lie on a mesh, or two of
    which the first increases. A header ``x [um], y [um], height [nm]``, or ``x [um], height [nm]``
    of a line scan, is followed by a row for each point, in any order. Empty cells, ``nan``,
    ``BAD`` and ``***`` are missing points; so are values such as -9999, 32767 or 3.4e38 that lie
    farther from all heights than these from each other. An NPZ may carry `height`, `spacing` (one
    number or two), `unit` (a text, for both), and `periodic`.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> file = pathlib.Path(tempfile.mkdtemp(), "steps.csv")
    >>> _ = file.write_text("0, 1, 2\n0, 1, nan\n")
    >>> surface = read_surface(file, spacing=1e-6, height_unit="nm")
    >>> surface.heights[:, 0].tolist(), surface.missing_share
    ([0.0, 1e-09, 2e-09], 0.16666666666666666)
    """
    path = Path(path)
    file = require_file(split_sheet(path)[0])
    if file.stat().st_size == 0:
        raise ValueError(f"{path.name}: cannot be read as a surface: the file is empty")
    factor = as_real(height_factor)
    if factor is None or factor == 0 or not math.isfinite(factor):
        raise ValueError(f"height_factor: must be a number other than 0, got {height_factor!r}")
    surface = _reader(path, file)(path, Units(path.name, spacing, height_unit), channel)
    if factor != 1:
        surface = surface.with_heights(factor * surface.heights)
    require_possible(surface)
    return surface if width is None else swept(surface, width)


def _reader(path: Path, file: Path) -> Callable[[Path, Units, str | None], Surface]:
    """Reader of a file, by its content where this says more than the name."""
    suffix = file.suffix.lower()
    if is_spreadsheet(path):
        return read_text_map
    with file.open("rb") as opened:
        start = opened.read(_SAMPLED)
    if suffix in _ARRAYS or start.startswith(_ARRAY):
        return read_array
    is_text = start.startswith(_UTF_16) or start.translate(None, _NO_TEXT) == start
    return read_text_map if is_text or suffix in TABLES else read_instrument
