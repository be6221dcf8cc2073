"""Drawing of a roller's profile as DXF, by ezdxf."""

from __future__ import annotations

from os import PathLike

import numpy as np
from numpy.typing import ArrayLike

from viscontact.units.numbers import finite, real_array

try:
    import ezdxf
except ModuleNotFoundError:  # an extra, without which a profile is a table only
    ezdxf = None  # type: ignore[assignment]

#: Name of the layer of the drawing.
LAYER = "PROFILE"


def write_dxf(
    path: str | PathLike[str], x: ArrayLike, drop: ArrayLike, radius: float | None = None
) -> None:
    """Write a generating line as a polyline of a DXF drawing in mm.

    Parameters
    ----------
    path : path-like
        The drawing, by custom ending in ``.dxf``.
    x, drop : array_like
        Positions along the roller and drops there, of one length [m].
    radius : float, optional
        Radius of the roller [m]: the line is then drawn at the height of the surface above the
        axis, which is y = 0; without it at minus the drop.

    Raises
    ------
    ModuleNotFoundError
        If ezdxf is not installed, as by the extra ``drawing``.

    Notes
    -----
    DXF R2010. The header states millimetres ($INSUNITS = 4) and the metric system ($MEASUREMENT =
    1). The line is an LWPOLYLINE on the layer PROFILE; it is drawn to scale, so that the drop of
    some micrometres is not seen without a magnification along y.

    Examples
    --------
    >>> import tempfile
    >>> file = tempfile.mkdtemp() + "/crown.dxf"
    >>> write_dxf(file, [-1e-2, 0.0, 1e-2], [5e-6, 0.0, 5e-6], radius=5e-3)
    >>> (line,) = ezdxf.readfile(file).modelspace()
    >>> [(float(x), round(float(y), 6)) for x, y, *_ in line.get_points()]
    [(-10.0, 4.995), (0.0, 5.0), (10.0, 4.995)]
    """
    if ezdxf is None:
        raise ModuleNotFoundError(
            "a drawing needs ezdxf, which is not installed; type: "
            "pip install 'viscontact[drawing]'",
            name="ezdxf",
        )
    drawing = ezdxf.filemanagement.new("R2010")
    drawing.units = ezdxf.units.MM
    drawing.header["$MEASUREMENT"] = 1
    drawing.layers.add(LAYER)
    top = 0.0 if radius is None else finite("radius", radius, "m")
    height = top - real_array("drop", drop, "m")
    points = np.column_stack([real_array("x", x, "m"), height]) * 1e3
    drawing.modelspace().add_lwpolyline(points.tolist(), dxfattribs={"layer": LAYER})
    drawing.saveas(path)
