"""Conversions of usual units to SI, as pint computes them: pint takes most of a second to start."""

from __future__ import annotations

#: SI value of each unit, by base units.
_FACTORS: dict[str, dict[str, float]] = {
    "meter": {
        "nm": 1e-09,
        "um": 1e-06,
        "µm": 1e-06,
        "μm": 1e-06,
        "mm": 0.001,
        "cm": 0.01,
        "m": 1.0,
        "km": 1000.0,
        "in": 0.0254,
    },
    "second": {
        "us": 1e-06,
        "µs": 1e-06,
        "ms": 0.001,
        "s": 1.0,
        "min": 60.0,
        "h": 3600.0,
        "d": 86400.0,
    },
    "kilogram * meter / second ** 2": {
        "pN": 1e-12,
        "nN": 1e-09,
        "uN": 1e-06,
        "µN": 1e-06,
        "mN": 0.001,
        "N": 1.0,
        "kN": 1000.0,
        "MN": 1000000.0,
        "lbf": 4.4482216152605005,
    },
    "kilogram / meter / second ** 2": {
        "Pa": 1.0,
        "kPa": 1000.0,
        "MPa": 1000000.0,
        "GPa": 1000000000.0,
        "TPa": 1000000000000.0,
        "psi": 6894.7572931683635,
        "bar": 100000.0,
    },
    "radian": {
        "urad": 1e-06,
        "µrad": 1e-06,
        "mrad": 0.001,
        "rad": 1.0,
        "deg": 0.017453292519943295,
    },
    "1 / second": {
        "mHz": 0.001,
        "Hz": 1.0,
        "kHz": 1000.0,
        "1/s": 1.0,
    },
    "kelvin": {
        "K": 1.0,
    },
    "kilogram": {
        "kg": 1.0,
    },
    "kilogram * meter ** 2 / second ** 3": {
        "mW": 0.001,
        "W": 1.0,
        "kW": 1000.0,
    },
    "kilogram * meter ** 2 / ampere / second ** 3": {
        "V": 1.0,
        "mV": 0.001,
    },
    "ampere * second ** 3 / kilogram / meter": {
        "nm/V": 1e-09,
        "um/V": 1e-06,
        "m/V": 1.0,
    },
    "kilogram * meter ** 2 / second ** 2": {
        "N m": 1.0,
        "uJ": 1e-06,
        "mJ": 0.001,
        "J": 1.0,
        "kJ": 1000.0,
    },
    "kilogram / second ** 2": {
        "J/m^2": 1.0,
        "J/m²": 1.0,
        "mJ/m^2": 0.001,
        "mJ/m²": 0.001,
        "N/m": 1.0,
        "N/mm": 1000.0,
        "mN/m": 0.001,
        "pN/nm": 0.0009999999999999998,
        "kN/m": 1000.0,
    },
    "kilogram * meter / second ** 3": {
        "W/m": 1.0,
        "mW/m": 0.001,
        "kW/m": 1000.0,
    },
    "meter ** 2": {
        "m^2": 1.0,
        "um^2": 1e-12,
        "mm^2": 1e-06,
        "cm^2": 0.0001,
    },
    "meter ** 3": {
        "cm^3": 1.0000000000000002e-06,
        "mm^3": 1e-09,
        "um^3": 9.999999999999999e-19,
        "m^3": 1.0,
    },
    "meter / second": {
        "m/s": 1.0,
        "mm/s": 0.001,
        "um/s": 1e-06,
        "m/min": 0.016666666666666666,
    },
    "1 / meter": {
        "1/m": 1.0,
    },
    "radian / meter": {
        "rad/m": 1.0,
        "deg/m": 0.017453292519943295,
    },
    "radian / second": {
        "rad/s": 1.0,
    },
    "kilogram * meter ** 2 / mole / second ** 2": {
        "J/mol": 1.0,
        "kJ/mol": 1000.0,
    },
    "meter * second ** 2 / kilogram": {
        "/ Pa": 1.0,
        "/Pa": 1.0,
        "1/Pa": 1.0,
        "/ kPa": 0.001,
        "/kPa": 0.001,
        "1/kPa": 0.001,
        "/ MPa": 1e-06,
        "/MPa": 1e-06,
        "1/MPa": 1e-06,
        "/ GPa": 1e-09,
        "/GPa": 1e-09,
        "1/GPa": 1e-09,
        "m^3/(N m)": 1.0,
        "mm^3/(N m)": 1e-09,
    },
    "kilogram / meter / second": {
        "Pa s": 1.0,
        "kPa s": 1000.0,
        "MPa s": 1000000.0,
        "GPa s": 1000000000.0,
        "TPa s": 1000000000000.0,
    },
    "meter * second / kilogram": {
        "/ (Pa s)": 1.0,
        "1/(Pa s)": 1.0,
        "/ (MPa s)": 1e-06,
        "1/(MPa s)": 1e-06,
        "/ (GPa s)": 1e-09,
        "1/(GPa s)": 1e-09,
    },
    "kilogram / kelvin / second ** 3": {
        "W/m^2/K": 1.0,
        "W/(m^2 K)": 1.0,
    },
    "kilogram * meter / kelvin / second ** 3": {
        "W/m/K": 1.0,
        "W/(m K)": 1.0,
    },
    "1 / kelvin": {
        "/ K": 1.0,
        "/K": 1.0,
        "1/K": 1.0,
    },
    "meter ** 2 / kelvin / second ** 2": {
        "J/kg/K": 1.0,
        "J/(kg K)": 1.0,
    },
    "meter ** 3 / second": {
        "mm^3/h": 2.777777777777778e-13,
        "mm^3/s": 1e-09,
        "ml/h": 2.777777777777778e-10,
        "ml/min": 1.666666666666667e-08,
        "m^3/s": 1.0,
    },
    "kilogram / meter ** 3": {
        "kg/m^3": 1.0,
    },
}

#: Factor of a unit to SI base units, and these, by the unit as it is written.
COMMON_UNITS = {
    unit: (factor, base) for base, units in _FACTORS.items() for unit, factor in units.items()
}
