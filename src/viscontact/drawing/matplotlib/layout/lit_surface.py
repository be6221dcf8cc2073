"""Lit surface in three-dimensional axes."""

from __future__ import annotations

import numpy as np
from matplotlib.cm import ScalarMappable
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from mpl_toolkits.mplot3d.axes3d import Axes3D

from viscontact.backend.arrays import Floats
from viscontact.drawing.content.relief import Relief

#: Towards the light, over the viewer's left shoulder, and what reaches the shade.
_LIGHT = np.array([-0.55, -0.45, 0.7]) / np.linalg.norm([-0.55, -0.45, 0.7])
_SHADE = 0.58


def draw_relief(axes: Axes3D, surface: Relief, colours: ScalarMappable) -> None:
    """Draw a lit surface into axes whose limits and box are set."""
    paint = np.asarray(colours.to_rgba(surface.values))
    paint[:, :3] *= _brightness(axes, surface.corners)[:, None]
    # Edges of the same colour close the hairlines between neighbours.
    axes.add_collection3d(
        Poly3DCollection(
            surface.corners,
            facecolors=paint,
            edgecolors=paint,
            linewidths=0.3,
            # Thousands of facets are an image in PDF and SVG; texts and lines are not.
            rasterized=True,
        )
    )


def _brightness(axes: Axes3D, corners: Floats) -> Floats:
    """Brightness of each quadrilateral, in the proportions of the drawing."""
    limits = np.array([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()])
    scale = np.asarray(axes.get_box_aspect()) / (limits[:, 1] - limits[:, 0])
    placed = corners * scale
    normal = np.cross(placed[:, 2] - placed[:, 0], placed[:, 3] - placed[:, 1])
    length = np.linalg.norm(normal, axis=1)
    normal /= np.where(length > 0, length, 1.0)[:, None]
    return np.asarray(_SHADE + (1 - _SHADE) * np.maximum(normal @ _LIGHT, 0.0))
