"""Units: quantities in words become SI numbers, SI numbers become readable words.

Case files and the command line take ``"5 mm"``; everything behind them is SI. Tables and
figures turn SI numbers back into units a person reads.
"""

from viscontact.readable import ReadableUnit, in_digits, in_words, readable_unit
from viscontact.units.dimensions import DIMENSIONS, Dimension
from viscontact.units.error_bars import (
    at_most,
    in_error_digits,
    in_percent,
    in_supported_digits,
)
from viscontact.units.quantities import Scale, parse_quantity, parse_scale, parse_unit
from viscontact.units.rounding import is_rounding_tilt
from viscontact.units.temperatures import in_celsius

__all__ = [
    "DIMENSIONS",
    "Dimension",
    "ReadableUnit",
    "Scale",
    "at_most",
    "in_celsius",
    "in_digits",
    "in_error_digits",
    "in_percent",
    "in_supported_digits",
    "in_words",
    "is_rounding_tilt",
    "parse_quantity",
    "parse_scale",
    "parse_unit",
    "readable_unit",
]
