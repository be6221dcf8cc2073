"""Physical dimensions that arguments can have, with their SI units and names."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Dimension:
    """Physical dimension: its name in a sentence, SI unit, an example and units that are common."""

    name: str
    unit: str
    example: str
    units: tuple[str, ...]


#: Dimensions of arguments, by name.
DIMENSIONS = {
    "length": Dimension("a length", "m", "5 mm", ("nm", "um", "mm", "m", "in")),
    "time": Dimension("a time", "s", "1000 s", ("ms", "s", "min", "h", "d")),
    "force": Dimension("a force", "N", "10 kN", ("mN", "N", "kN", "MN")),
    "angle": Dimension("an angle", "rad", "1 mrad", ("urad", "mrad", "rad", "deg")),
    "spin": Dimension("a rotation over a way", "rad/m", "0.5 rad/m", ("rad/m", "deg/m")),
    "pressure": Dimension("a pressure", "Pa", "1800 MPa", ("Pa", "kPa", "MPa", "GPa", "psi")),
    "compliance": Dimension(
        "a compliance", "1/Pa", "5.5e-4 / MPa", ("/ Pa", "/ kPa", "/ MPa", "/ GPa")
    ),
    "viscosity": Dimension(
        "a viscosity", "Pa s", "10 GPa s", ("Pa s", "kPa s", "MPa s", "GPa s", "TPa s")
    ),
    "fluidity": Dimension(
        "a fluidity", "1/(Pa s)", "1e-6 / (MPa s)", ("/ (Pa s)", "/ (MPa s)", "/ (GPa s)")
    ),
    "frequency": Dimension("a frequency", "Hz", "10 Hz", ("mHz", "Hz", "kHz")),
    "angular frequency": Dimension("an angular frequency", "rad/s", "62.8 rad/s", ("rad/s",)),
    "speed": Dimension("a speed", "m/s", "0.5 m/s", ("um/s", "mm/s", "m/s", "km/h")),
    "temperature": Dimension("a temperature", "K", "25 degC", ("degC", "K", "degF")),
    "temperature difference": Dimension("a temperature difference", "K", "51.6 K", ("K",)),
    "expansion": Dimension("a coefficient of thermal expansion", "1/K", "1.8e-4 / K", ("/ K",)),
    "area": Dimension("an area", "m^2", "25 mm^2", ("um^2", "mm^2", "cm^2", "m^2")),
    "line load": Dimension("a force per length", "N/m", "40 N/mm", ("N/m", "N/mm", "kN/m")),
    "power per length": Dimension("a power per length", "W/m", "20 W/m", ("mW/m", "W/m", "kW/m")),
    "energy": Dimension("an energy", "J", "5 mJ", ("uJ", "mJ", "J", "kJ")),
    "torque": Dimension("a torque", "N m", "2 N m", ("N mm", "N m", "kN m")),
    "work of adhesion": Dimension("an energy per area", "J/m^2", "50 mJ/m2", ("mJ/m^2", "J/m^2")),
    "power": Dimension("a power", "W", "2 W", ("mW", "W", "kW")),
    "stiffness": Dimension("a stiffness", "N/m", "0.1 N/m", ("N/m", "mN/m", "kN/m")),
    "voltage": Dimension("a voltage", "V", "1 V", ("mV", "V")),
    "sensitivity": Dimension("a length per voltage", "m/V", "50 nm/V", ("nm/V", "um/V")),
    "heat transfer coefficient": Dimension(
        "a heat transfer coefficient", "W/(m^2 K)", "10 W/m2/K", ("W/m^2/K", "kW/m^2/K")
    ),
    "thermal conductivity": Dimension(
        "a thermal conductivity", "W/(m K)", "0.2 W/m/K", ("W/m/K", "mW/m/K")
    ),
    "heat capacity": Dimension("a heat capacity", "J/(kg K)", "1800 J/kg/K", ("J/kg/K", "kJ/kg/K")),
    "density": Dimension("a density", "kg/m^3", "1150 kg/m3", ("kg/m^3", "g/cm^3")),
    "wear rate": Dimension(
        "a volume per force and way", "m^3/(N m)", "1e-7 mm^3/(N m)", ("mm^3/(N m)", "m^3/(N m)")
    ),
    "volume": Dimension("a volume", "m^3", "1 um^3", ("um^3", "mm^3", "cm^3", "m^3")),
    "leak rate": Dimension(
        "a volume per time", "m^3/s", "1 mm^3/h", ("mm^3/h", "mm^3/s", "ml/h", "ml/min", "m^3/s")
    ),
    "molar energy": Dimension("an energy per mole", "J/mol", "80 kJ/mol", ("kJ/mol", "J/mol")),
}

#: Other dimensions, to name what was given instead: "(got a mass)".
OTHER_DIMENSIONS = {
    "kg": "a mass",
    "1/s": "a frequency or a rate",
    "1/m": "a curvature",
    "K": "a temperature",
    "N m": "an energy or a moment",
    "N/m": "a stiffness",
}
