"""The bodies of `hard_problems`: all that the package knows, smooth, sharp and rough."""

import math
from dataclasses import dataclass

import numpy as np

import viscontact as vc


@dataclass(frozen=True)
class Body:
    """An indenter, with the force (by compliance) that suits it, and how far aside it may act."""

    kind: str
    indenter: vc.Indenter
    press: float  # force times compliance [m²]
    reach: tuple[float, float]  # largest eccentricities [m], or of the outermost cells' [-]
    outline: tuple[float, float] | None = None  # grid size where the body rules it [m]
    deepest: float = 0.0  # approach that suits it, where no elastic estimate says [m]


def hard_body(rng, length):
    """One of all kinds, about as long as requested."""
    depth = 10.0 ** rng.uniform(-4, -1.5)
    press = depth * length**2
    kind = str(rng.choice(list(_BODIES)))
    return _BODIES[kind](rng, kind, length, depth, press)


def _sphere(rng, kind, length, depth, press):
    del rng
    return Body(kind, vc.Sphere(length), press * math.sqrt(depth), (0.05 * length, 0.05 * length))


def _paraboloid(rng, kind, length, depth, press):
    ratio = 10.0 ** rng.uniform(-3, 3)
    size = length * math.sqrt(depth * min(ratio, 1.0))
    shape = vc.Paraboloid(length, ratio * length)
    return Body(kind, shape, press * math.sqrt(depth * ratio), (0.3 * size, 0.3 * size))


def _cone(rng, kind, length, depth, press):
    del depth
    size = math.sqrt(press)
    cone = vc.Cone(math.radians(rng.uniform(70, 89.5)))
    return Body(kind, cone, press, (0.1 * size, 0.1 * size))


def _round_punch(rng, kind, length, depth, press):
    del rng
    size = (2.2 * length, 2.2 * length)
    return Body(kind, vc.FlatPunch(length), press, (0.65, 0.65), size, depth * length)


def _block(rng, kind, length, depth, press):
    width = length * 10.0 ** rng.uniform(-1.5, 0)
    shape = vc.FlatPunch(half_length=length, half_width=width)
    size = (2.2 * length, 2.2 * width)
    return Body(kind, shape, press * width / length, (1.0, 1.0), size, depth * width)


def _crowned_roller(rng, kind, length, depth, press):
    crown = length * 10.0 ** rng.uniform(0.5, 3)
    return Body(kind, vc.Roller(length, 2 * length, crown), press, (2 * length, 0.0))


def _sharp_roller(rng, kind, length, depth, press):
    del rng
    # Ten times the half width of a line contact, Johnson (1985), eq. 4.43: for a load at its end.
    size = (4.4 * length, 10 * length * math.sqrt(depth / math.pi))
    return Body(kind, vc.Roller(length, 2 * length), press, (0.9, 0.0), size, depth * length)


def _rough(rng, kind, length, depth, press):
    axis = np.linspace(-length, length, 40)
    # Rough, but so that the force presses a few peaks down to their size.
    sigma = length * math.sqrt(depth) * float(rng.uniform(0.003, 0.03))
    height = sigma * _relief(rng)
    if kind == "single precision":
        # Heights above a far reference, which float32 rounds to steps of 0.03 to 0.5 sigma.
        far = sigma * 2.0**23 * 10.0 ** rng.uniform(-1.5, -0.3)
        axis, height = axis.astype(np.float32), (far + height).astype(np.float32)
    shape = vc.HeightMap(axis, axis, height)
    reach = (0.95, 0.95)
    if rng.random() < 0.4:
        shape, reach = shape + vc.Paraboloid(20 * length, 20 * length), (0.2, 0.1)
    return Body(kind, shape, press, reach, (2.4 * length, 2.4 * length), 3 * sigma)


def _relief(rng):
    """White or self-affine heights of unit deviation, shape (40, 40)."""
    white = rng.standard_normal((40, 40))
    if rng.random() < 0.5:
        return white
    wave = np.fft.fftfreq(40)
    q = np.hypot(wave[:, None], wave[None, :])
    q[0, 0] = np.inf
    height = np.fft.ifft2(np.fft.fft2(white) * q**-1.8).real
    return height / height.std()


_BODIES = {
    "sphere": _sphere,
    "paraboloid": _paraboloid,
    "cone": _cone,
    "round punch": _round_punch,
    "block": _block,
    "crowned roller": _crowned_roller,
    "sharp roller": _sharp_roller,
    "rough": _rough,
    "single precision": _rough,
}
