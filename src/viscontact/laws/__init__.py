"""Linear viscoelastic laws: creep compliance Phi(t) and relaxation modulus G(t) in shear."""

from viscontact.laws.kelvin import Burgers, Zener
from viscontact.laws.law import Law, SeriesLaw
from viscontact.laws.maxwell import Elastic, Maxwell
from viscontact.laws.series import CreepSeries, RelaxationSeries
from viscontact.laws.temperature import WLF, Arrhenius, Shift, TabulatedShift

__all__ = [
    "WLF",
    "Arrhenius",
    "Burgers",
    "CreepSeries",
    "Elastic",
    "Law",
    "Maxwell",
    "RelaxationSeries",
    "SeriesLaw",
    "Shift",
    "TabulatedShift",
    "Zener",
]
