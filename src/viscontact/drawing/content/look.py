"""Colours and units of figures, the same for every renderer."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.drawing.content.panel import Ink
from viscontact.results.formatting import format_with_error, format_with_error_in
from viscontact.units.formatting import ReadableUnit, format_number, without_trailing_zeros
from viscontact.units.systems import AUTOMATIC, unit_in

#: Pressure, pale to dark, and pressure (blue) with tension (red): ColorBrewer's YlGnBu and RdBu.
PRESSURE = "ffffd9 edf8b1 c7e9b4 7fcdbb 41b6c4 1d91c0 225ea8 253494 081d58"
SIGNED = "b2182b d6604d f4a582 fddbc7 f7f7f7 d1e5f0 92c5de 4393c3 2166ac"
#: Instants, early to late: viridis, 26 of its colours.
INSTANTS = (
    "440154 471063 481e70 472b7a 453882 414487 3c4f8b 375a8c 32648e 2e6e8e 2a788e 26828e 228b8d "
    "1f958b 1f9e88 22a884 2cb17e 3aba76 4dc36c 62ca5f 7ad151 93d741 aedc30 c9e01f e4e419 fde725"
)
#: Several runs: Okabe and Ito's palette without its yellow, which is too pale on white:
#: distinguishable with any common kind of colour blindness.
RUNS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000")
#: What exceeds its limit.
RED = "#b00020"
#: Blue and orange that colour-blind readers distinguish, on white and on black.
BLUE, ORANGE = "#2f80c3", "#d9661f"


def shades(scale: str, count: int, begin: float = 0.0, end: float = 1.0) -> list[str]:
    """Colours at equal steps between two places on a scale, from 0 to 1."""
    given = np.array([[*bytes.fromhex(each)] for each in scale.split()])
    at = np.linspace(begin, end, count) * (len(given) - 1)
    mixed = np.rint([np.interp(at, np.arange(len(given)), part) for part in given.T]).astype(int)
    return ["#{:02x}{:02x}{:02x}".format(*each) for each in mixed.T.tolist()]


@dataclass(frozen=True)
class Look:
    """Colours and system of units of a figure, on a light or a dark page."""

    ink: str
    faint: str  # text of less importance
    line: str  # lines of less importance
    edge: str  # borders
    grid: str
    card: str  # background
    blue: str  # what is shown
    band: str  # its error
    warm: str  # what is compared with it
    early: float  # ends of the colours of instants in viridis
    late: float
    system: str = AUTOMATIC

    def unit(self, si: str, *values: ArrayLike) -> ReadableUnit:
        """Return the unit of values in SI."""
        return unit_in(self.system, si, *values)

    def text(self, value: float, error: float, si: str) -> str:
        """Return a value with its error, both in SI, and its unit."""
        if self.system == AUTOMATIC or math.isinf(error):
            return format_with_error(value, error, si)
        unit = self.unit(si, value)
        return f"{format_with_error_in(unit, value, error)} {unit.symbol}".rstrip()

    def quantity(self, value: float, si: str) -> str:
        """Return a value in SI with its unit, without trailing zeros."""
        unit = self.unit(si, value)
        number = without_trailing_zeros(format_number(value / unit.factor))
        return f"{number} {unit.symbol}".rstrip()

    def colour(self, ink: Ink) -> str:
        """Colour of a curve."""
        if ink.kind == "ordered":
            return shades(INSTANTS, 1, self.early + (self.late - self.early) * ink.place)[0]
        if ink.kind == "run":
            runs = (self.blue, self.warm, *RUNS[2:-1], self.ink)
            return runs[int(ink.place) % len(runs)]
        if ink.kind == "beyond":
            return RED
        if ink.kind == "temperature":
            return self.warm
        return {"fit": self.warm, "faint": self.faint, "pale": self.faint}.get(ink.kind, self.ink)

    def instants(self, count: int) -> list[str]:
        """Colours of instants, from early to late."""
        return shades(INSTANTS, count, self.early, self.late)


LIGHT = Look(
    ink="#262626",
    faint="#5f6670",
    line="#9aa3ab",
    edge="#8a939c",
    grid="#e8ecef",
    card="#ffffff",
    blue="#0072b2",
    band="rgba(0,114,178,0.22)",
    warm="#d55e00",
    early=0.0,
    late=0.85,
)
DARK = Look(
    ink="#e4e7ea",
    faint="#9ba5af",
    line="#6b7680",
    edge="#6b7680",
    grid="#2a3036",
    card="#1a1e22",
    blue="#5ab4e5",
    band="rgba(90,180,229,0.24)",
    warm="#f2a065",
    early=0.3,
    late=1.0,
)
