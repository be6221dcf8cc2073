"""Physical ageing of a glassy polymer below its glass transition."""

from __future__ import annotations

from dataclasses import field

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.units.display import Displayable
from viscontact.units.numbers import check_fields, real_array


@dataclass(frozen=True)
class Ageing(Displayable):
    """Physical ageing (Struik): all times of the law grow with the age since the quench.

    Parameters
    ----------
    age : float
        Age t_e > 0 at time 0 of a run, since the quench from above the glass transition; that at
        which the law was measured [s].
    exponent : float
        Shift rate mu > 0, about 0.7 to 1 for most glassy polymers well below the transition [-].

    Raises
    ------
    ValueError
        If one is not a positive finite number, or the exponent exceeds 1.5.

    Notes
    -----
    The factor of all times at time t is a_e = (1 + t/t_e)^mu, so that creep over a long time t at
    mu < 1 is that of a body that does not age over the effective time
    t_e/(1 - mu) ((1 + t/t_e)^(1 - mu) - 1) [1]_. Ageing stops, and is erased, above the transition.

    References
    ----------
    .. [1] L. C. E. Struik, Physical Aging in Amorphous Polymers and Other Materials, Elsevier,
       1978.

    Examples
    --------
    After a day at an age of an hour at first:

    >>> print(f"{Ageing(3600.0, 0.8).factor(86400.0):.2f}")
    13.13
    """

    age: float = field(metadata={"unit": "s"})
    exponent: float = field(metadata={"unit": "1"})

    def __post_init__(self) -> None:
        check_fields(self, "age", "exponent")
        if self.exponent > LARGEST_EXPONENT:
            raise ValueError(
                f"Ageing: exponent must be at most {LARGEST_EXPONENT}, got {self.exponent:g}; the "
                "shift rates of glassy polymers are 0.7 to 1"
            )

    def factor(self, times: ArrayLike) -> Floats:
        """Return the factor a_e of all times of the law at times of a run.

        Parameters
        ----------
        times : array_like
            Times since the start of the run [s].

        Returns
        -------
        ndarray
            Factors, 1 at time 0, of the shape of `times` [-].
        """
        passed = real_array("times", times, "s")
        return np.asarray((1 + passed / self.age) ** self.exponent)


#: Largest exponent that is taken: measured ones do not exceed 1.2.
LARGEST_EXPONENT = 1.5
