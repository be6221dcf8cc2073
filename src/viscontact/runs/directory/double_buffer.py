"""Two copies of a result: one to be read, which is always whole, and one that is written to."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import netCDF4

from viscontact.runs.directory.atomic_files import replace, swap
from viscontact.runs.directory.hdf5_lock import is_unread
from viscontact.runs.directory.netcdf_layout import Extent, Layout, copy_rows, created, opened

#: Windows does not replace a file that somebody has open.
MAY_BE_HELD = os.name == "nt"


def hidden_copies(path: Path) -> tuple[Path, Path]:
    """Return the names of the copy that is written to, and of what is there between two swaps.

    Parameters
    ----------
    path : Path
        The published file.

    Examples
    --------
    >>> [copy.name for copy in hidden_copies(Path("result.nc"))]
    ['.result.nc.working', '.result.nc.previous']
    """
    return path.with_name(f".{path.name}.working"), path.with_name(f".{path.name}.previous")


class TwoCopies:
    """The published file of a result, and the hidden one beside it that rows are added to.

    Parameters
    ----------
    path : Path
        The published file.
    layout : Layout
        What both hold.

    Attributes
    ----------
    published : Extent or None
        Rows of this run that the published file is known to have; None while it is not this
        run's.
    """

    def __init__(self, path: Path, layout: Layout) -> None:
        self.published: Extent | None = None
        self._path, self._layout = path, layout
        self._working, self._aside = hidden_copies(path)
        self._file: netCDF4.Dataset | None = None
        # Rows the working copy is known to have while it is closed; None if there is none.
        self._closed: Extent | None = None

    def begin(self, attributes: Mapping[str, Any]) -> None:
        """Lay out a new result; what is published stays until `publish`.

        Parameters
        ----------
        attributes : mapping
            Global attributes.
        """
        self.discard()
        try:
            self._file = created(self._working, self._layout, attributes)
        except BaseException:
            with suppress(OSError):
                self._working.unlink(missing_ok=True)
            raise

    def take_over(self, extent: Extent) -> None:
        """Go on with what is published.

        Parameters
        ----------
        extent : Extent
            Rows that it has.
        """
        self.discard()
        self.published = extent

    @property
    def file(self) -> netCDF4.Dataset:
        """The working copy, open for appending, with all rows so far."""
        if self._file is None:
            self._file = self._reopened()
        return self._file

    def publish(self, extent: Extent) -> bool:
        """Put the working copy in the place of the published file.

        Parameters
        ----------
        extent : Extent
            Rows it has.

        Returns
        -------
        bool
            False if that has to wait, as a program that reads the published file holds its place.

        Notes
        -----
        The file that was published becomes the working copy, not before it is needed: a program
        that was just about to read it has locked it by then, and is left alone with it.
        """
        self._close(extent)
        try:
            if self.published is None:
                replace(self._working, self._path)
                behind = None
            else:
                swapped = swap(self._working, self._path, self._aside)
                behind = self.published if swapped else None
        except PermissionError:
            if MAY_BE_HELD:
                return False
            raise
        self.published, self._closed = extent, behind
        return True

    def cut(self, extent: Extent, attributes: Mapping[str, Any]) -> None:
        """Drop rows from the working copy; netCDF cannot, so that it is written anew.

        Parameters
        ----------
        extent : Extent
            Rows to be kept.
        attributes : mapping
            Global attributes.
        """
        self._write_anew(self._layout, extent, attributes)

    def widen(self, layout: Layout, extent: Extent, attributes: Mapping[str, Any]) -> None:
        """Lay the working copy out anew on a larger grid; what is published stays until `publish`.

        Parameters
        ----------
        layout : Layout
            The same on the larger grid.
        extent : Extent
            Rows to be kept.
        attributes : mapping
            Global attributes.
        """
        self._write_anew(layout, extent, attributes)
        self._layout = layout

    def _write_anew(self, layout: Layout, extent: Extent, attributes: Mapping[str, Any]) -> None:
        source = self.file
        self._aside.unlink(missing_ok=True)
        fresh = created(self._aside, layout, attributes)
        copy_rows(source, fresh, self._layout, Extent(0, 0), extent, wider=layout.grid)
        fresh.close()
        self._close(extent)
        self._aside.replace(self._working)
        # The published file is another one in its rows or its grid: of no use as a working copy.
        self.published = None

    def discard(self) -> None:
        """Close and remove everything but the published file."""
        # A full disk fails what is still to be written; nobody wants it.
        with suppress(OSError, RuntimeError):
            self._close(Extent(0, 0))
        self._closed = None
        self._working.unlink(missing_ok=True)
        self._aside.unlink(missing_ok=True)

    def _close(self, extent: Extent) -> None:
        file, self._file = self._file, None
        if file is not None:
            self._closed = None
            file.close()
            self._closed = extent

    def _reopened(self) -> netCDF4.Dataset:
        behind, published = self._closed, self.published
        if behind is not None and (published is None or behind.rows > published.rows):
            return opened(self._working, "a")  # could not be published
        if behind is not None and is_unread(self._working):
            # What cannot be gone on with is made again from the published file.
            with suppress(OSError, RuntimeError):
                return self._caught_up(behind)
        # A new file: the old one may be open somewhere.
        self._working.unlink(missing_ok=True)
        shutil.copyfile(self._path, self._working)
        return opened(self._working, "a")

    def _caught_up(self, behind: Extent) -> netCDF4.Dataset:
        """Open the file that was published before, and give it the rows it lacks."""
        assert self.published is not None
        file = opened(self._working, "a")
        try:
            with opened(self._path, "r") as source:
                copy_rows(source, file, self._layout, behind, self.published)
        except BaseException:
            with suppress(OSError, RuntimeError):
                file.close()
            raise
        return file
