"""Which kinds of quantities there are, and what they are called in a sentence."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Dimension:
    """What kind of quantity is wanted: its name in a sentence, its SI unit and an example."""

    name: str
    unit: str
    example: str


#: What can be asked for, by the word for it.
DIMENSIONS = {
    "length": Dimension("a length", "m", "5 mm"),
    "time": Dimension("a time", "s", "1000 s"),
    "force": Dimension("a force", "N", "10 kN"),
    "angle": Dimension("an angle", "rad", "1 mrad"),
    "pressure": Dimension("a pressure", "Pa", "1800 MPa"),
    "compliance": Dimension("a compliance", "1/Pa", "5.5e-4 / MPa"),
    "viscosity": Dimension("a viscosity", "Pa s", "10 GPa s"),
    "fluidity": Dimension("a fluidity", "1/(Pa s)", "1e-6 / (MPa s)"),
    "frequency": Dimension("a frequency", "Hz", "10 Hz"),
    "angular frequency": Dimension("an angular frequency", "rad/s", "62.8 rad/s"),
    "temperature": Dimension("a temperature", "K", "25 degC"),
    "temperature difference": Dimension("a temperature difference", "K", "51.6 K"),
    "molar energy": Dimension("an energy per mole", "J/mol", "80 kJ/mol"),
}

#: Only to name what was given instead: "(got a mass)".
OTHER_DIMENSIONS = {
    "kg": "a mass",
    "m^2": "an area",
    "m^3": "a volume",
    "m/s": "a speed",
    "1/s": "a frequency or a rate",
    "1/m": "a curvature",
    "K": "a temperature",
    "N m": "an energy or a moment",
    "N/m": "a stiffness",
    "W": "a power",
    "V": "a voltage",
}
