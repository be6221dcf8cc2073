"""Tractions at the interfaces of layers, from which delamination is judged."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr

from viscontact.results.stress_source import Body, stress_source

#: Long names of the fields and of their largest values.
MEANINGS = {
    "interface_normal_stress": "normal stress at an interface, tension positive",
    "interface_shear_stress_x": "shear stress xz at an interface",
    "interface_shear_stress_y": "shear stress yz at an interface",
    "interface_shear_stress": "magnitude of the shear stress at an interface",
    "largest_interface_tension": "largest tension at an interface",
    "largest_interface_compression": "largest compression at an interface",
    "largest_interface_shear": "largest shear stress at an interface",
}


def interface_stresses(
    results: xr.Dataset, *, times: Sequence[float] | None = None, body: Body = "material"
) -> xr.Dataset:
    """Normal and shear stresses at the interfaces of layers, at stored instants.

    Parameters
    ----------
    results : xarray.Dataset
        Result of `simulate` or `open_results` for a body of layers, with stored pressure.
    times : sequence of float, optional
        Instants [s], the nearest stored ones are taken; all when left out.
    body : {"material", "indenter_material"}, optional
        The pressed body or the indenter; z points into it.

    Returns
    -------
    xarray.Dataset
        Over (time, interface, x, y) ``interface_normal_stress`` (tension positive),
        ``interface_shear_stress_x`` and ``interface_shear_stress_y`` (the components xz and yz)
        and their magnitude ``interface_shear_stress`` [Pa]. Over (time, interface)
        ``largest_interface_tension``, ``largest_interface_compression`` (both 0 where there is
        none) and ``largest_interface_shear`` [Pa], of all cells of the grid. Interface 1 is below
        the uppermost layer; the coordinate ``depth`` [m] is where it lies.

    Raises
    ------
    ValueError
        If the body has no layers, or as `section_stresses`.

    Notes
    -----
    These are the tractions, which both sides share. The other components jump there:
    `section_stresses` gives them on either side. An interface without friction has no shear
    stress; it is assumed to stay closed, so that tension there means that it would open. The
    largest values are of the grid only: beyond its ends, away from the contact, they decay.

    Examples
    --------
    In layers of one material the axis of a ball is stressed by -p₀/(1 + z²/a²) (Johnson 1985,
    Contact Mechanics, eq. 3.45b):

    >>> import viscontact as vc
    >>> plastic = vc.Material(vc.Elastic(8e9), poisson_ratio=0.3)
    >>> layers = vc.Layered([vc.Layer(0.1e-3, plastic)], base=plastic)
    >>> grid = vc.Grid((49, 49), (0.6e-3, 0.6e-3))
    >>> ds = vc.simulate(vc.Paraboloid(0.01, 0.01), layers, vc.step(10.0), grid, [0.0])
    >>> largest = vc.interface_stresses(ds).largest_interface_compression[0, 0]
    >>> radius = ds.contact_length[0] / 2
    >>> round(float(largest / ds.peak_pressure[0] * (1 + (0.1e-3 / radius) ** 2)), 2)
    1.0
    """
    source = stress_source(results, body)
    if not source.interfaces:
        raise ValueError("interface_stresses: this body is a half-space and has no interfaces")
    places = source.places(times)
    found = [source.on_plane(places, depth) for depth in source.interfaces]
    normal, along, across = (
        np.stack([stress[name] for stress in found], axis=1) for name in ("zz", "xz", "yz")
    )
    shear = np.hypot(along, across)
    grid = ("time", "interface", "x", "y")
    values: dict[str, Any] = {
        "interface_normal_stress": (grid, normal),
        "interface_shear_stress_x": (grid, along),
        "interface_shear_stress_y": (grid, across),
        "interface_shear_stress": (grid, shear),
        "largest_interface_tension": (grid[:2], np.nanmax(np.maximum(normal, 0.0), axis=(2, 3))),
        "largest_interface_compression": (
            grid[:2],
            np.nanmax(np.maximum(-normal, 0.0), axis=(2, 3)),
        ),
        "largest_interface_shear": (grid[:2], np.nanmax(shear, axis=(2, 3))),
    }
    variables = {
        name: (*each, {"units": "Pa", "long_name": MEANINGS[name]}) for name, each in values.items()
    }
    numbers = np.arange(1, len(source.interfaces) + 1)
    depth = {"units": "m", "long_name": "depth of the interface", "positive": "down"}
    coordinates = {
        "time": source.time(places),
        "interface": (
            "interface",
            numbers,
            {"units": "1", "long_name": "interface, 1 below the uppermost layer"},
        ),
        "depth": ("interface", np.array(source.interfaces), depth),
        "x": results["x"],
        "y": results["y"],
    }
    attributes = {"splitting_error": source.splitting_error}
    return xr.Dataset(variables, coords=coordinates, attrs=attributes)
