"""Linear viscoelastic creep laws: compliance Phi(t) and shear modulus G(t)."""

from viscontact.laws.creep_table import TabulatedCreep
from viscontact.laws.fractional_maxwell import FractionalMaxwell
from viscontact.laws.fractional_zener import FractionalZener
from viscontact.laws.law import Law
from viscontact.laws.maxwell import Elastic, Maxwell
from viscontact.laws.parallel_spring import BesideSpring
from viscontact.laws.power_law import PowerLaw
from viscontact.laws.relaxation_table import TabulatedRelaxation
from viscontact.laws.series import CreepSeries, RelaxationSeries, SeriesLaw
from viscontact.laws.time_temperature import WLF, Arrhenius, Shift, TabulatedShift
from viscontact.laws.zener import Burgers, Zener

__all__ = [
    "WLF",
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
