from .ageing import Ageing
from .creep_table import TabulatedCreep
from .fractional_maxwell import FractionalMaxwell
from .fractional_zener import FractionalZener
from .law import Law
from .maxwell import Elastic, Maxwell
from .parallel_spring import BesideSpring
from .power_law import PowerLaw
from .relaxation_table import TabulatedRelaxation
from .series import CreepSeries, RelaxationSeries, SeriesLaw
from .time_temperature import WLF, Arrhenius, Shift, TabulatedShift
from .zener import Burgers, Zener

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
