"""Linear viscoelastic creep laws: compliance Phi(t) and shear modulus G(t)."""

from viscontact.bodies.laws.ageing import Ageing
from viscontact.bodies.laws.creep_table import TabulatedCreep
from viscontact.bodies.laws.fractional_maxwell import FractionalMaxwell
from viscontact.bodies.laws.fractional_zener import FractionalZener
from viscontact.bodies.laws.law import Law
from viscontact.bodies.laws.maxwell import Elastic, Maxwell
from viscontact.bodies.laws.parallel_spring import BesideSpring
from viscontact.bodies.laws.power_law import PowerLaw
from viscontact.bodies.laws.relaxation_table import TabulatedRelaxation
from viscontact.bodies.laws.series import CreepSeries, RelaxationSeries, SeriesLaw
from viscontact.bodies.laws.time_temperature import WLF, Arrhenius, Shift, TabulatedShift
from viscontact.bodies.laws.zener import Burgers, Zener

__all__ = [
    "WLF",
    "Ageing",
    "Arrhenius",
    "BesideSpring",
    "Burgers",
    "CreepSeries",
    "Elastic",
    "FractionalMaxwell",
    "FractionalZener",
    "Law",
    "Maxwell",
    "PowerLaw",
    "RelaxationSeries",
    "SeriesLaw",
    "Shift",
    "TabulatedCreep",
    "TabulatedRelaxation",
    "TabulatedShift",
    "Zener",
]
