"""The `shift:` of a material section, with a rule or factors."""

from __future__ import annotations

import numpy as np

from viscontact.backend.arrays import Floats
from viscontact.bodies.laws import WLF, Arrhenius, Shift, TabulatedShift
from viscontact.units.temperatures import in_celsius

_DIGITS = 6


def shift_lines(shift: Shift, reference: float) -> list[str]:
    """Lines of a shift relative to a reference temperature [K]."""
    at_reference = f"temperature: {_degrees(reference)}"
    if isinstance(shift, WLF):
        # Another reference changes both constants: Ferry (1980), section 11.A.
        c2 = shift.c2 + reference - shift.reference_temperature
        keys = {"c1": _number(shift.c1 * shift.c2 / c2), "c2": f"{_number(c2)} K"}
        return [at_reference, *_block("wlf", reference, keys)]
    if isinstance(shift, Arrhenius):
        keys = {"activation_energy": f"{_number(shift.activation_energy / 1e3)} kJ/mol"}
        return [at_reference, *_block("arrhenius", reference, keys)]
    assert isinstance(shift, TabulatedShift)
    # With a row at the reference its factor is exactly 1.
    temperatures = np.unique([*shift.temperatures, reference])
    keys = {"temperatures": f"[{', '.join(map(_degrees, temperatures))}]"}
    keys["factors"] = _relative(shift.factor(temperatures), shift.factor(reference))
    if shift.vertical is not None and np.ptp(shift.vertical) > 0:
        raised = shift.vertical_factor(temperatures)
        keys["vertical"] = _relative(raised, shift.vertical_factor(reference))
    return _block("factors", reference, keys)


def _block(kind: str, reference: float, keys: dict[str, str]) -> list[str]:
    head = {"kind": kind, "reference_temperature": _degrees(reference)}
    return ["shift:", *(f"  {key}: {value}" for key, value in (head | keys).items())]


def _relative(factors: Floats, reference: float) -> str:
    return f"[{', '.join(_number(float(factor)) for factor in factors / reference)}]"


def _degrees(kelvin: float) -> str:
    # Rounded: 0 °C is not 5.7e-14 °C.
    return f"{round(in_celsius(kelvin), 6):.{_DIGITS + 2}g} degC"


def _number(value: float) -> str:
    return f"{value:.{_DIGITS}g}"
