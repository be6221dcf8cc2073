"""Stored fields of a result in the formats of other programs: ParaView and MATLAB."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr

from viscontact.results.snapshots import field_times

#: Longest name of a variable in MATLAB.
LONGEST_NAME = 63


def write_paraview(results: xr.Dataset, path: Path) -> None:
    """Write a ParaView collection, one image a stored instant or speed in a folder beside it.

    Parameters
    ----------
    results : xarray.Dataset
        Result with stored fields.
    path : Path
        File to write, ``NAME.pvd``. The images are ``NAME/0000.vti`` and so on: the points are the
        centres of the cells [m], the data all fields over x and y [SI], true or false as 1 or 0.

    Raises
    ------
    ValueError
        If no fields are stored.
    OSError
        If a file cannot be written.
    """
    from pyevtk.hl import imageToVTK
    from pyevtk.vtk import VtkGroup

    instants = field_times(results, path.name)
    dimension = str(results["pressure"].dims[0])
    over = {dimension, "x", "y"}
    names = [str(name) for name in results.data_vars if set(results[name].dims) == over]
    x, y = (np.asarray(results[axis].values, dtype=np.float64) for axis in ("x", "y"))
    folder = path.with_suffix("")
    folder.mkdir(exist_ok=True)
    collection = VtkGroup(str(folder))
    for number, instant in enumerate(instants.tolist()):
        fields = {name: _image(results[name].isel({dimension: number})) for name in names}
        image = imageToVTK(
            str(folder / f"{number:04d}"),
            origin=(float(x[0]), float(y[0]), 0.0),
            spacing=(_spacing(x), _spacing(y), 1.0),
            pointData=fields,
        )
        collection.addFile(image, instant)
    collection.save()


def write_matlab(results: xr.Dataset, path: Path) -> None:
    """Write all variables of a result as a MAT file, for MATLAB and Octave.

    Parameters
    ----------
    results : xarray.Dataset
        Any result.
    path : Path
        File to write, ``NAME.mat``. It has each variable under its name in SI units, vectors as
        columns, fields in the order of `result.nc`: time or speed, x, y; and the structure
        ``units`` with the unit of each.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    from scipy.io import savemat

    variables = {str(name): each for name, each in results.variables.items()}
    numbers = {
        name: each.values
        for name, each in variables.items()
        if each.dtype.kind in "fiub" and len(name) <= LONGEST_NAME
    }
    units = {name: str(variables[name].attrs.get("units", "")) for name in numbers}
    with path.open("wb") as file:
        contents = {**numbers, "units": units}
        savemat(file, contents, long_field_names=True, oned_as="column", do_compression=True)


def _image(field: xr.DataArray) -> np.ndarray:
    """Values over x, y and one plane, in the order in which VTK reads them."""
    values = field.transpose("x", "y").values
    numbers = values.astype(np.uint8) if values.dtype == bool else values
    return np.asfortranarray(numbers[:, :, np.newaxis])


def _spacing(centres: np.ndarray) -> float:
    """Distance of the centres [m]; 1 where there is one, and so no distance."""
    return float(centres[1] - centres[0]) if len(centres) > 1 else 1.0
