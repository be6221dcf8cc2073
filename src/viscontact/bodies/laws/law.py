"""Base class of creep laws."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any, Self, overload

import numpy as np
from numpy.typing import ArrayLike

from viscontact.backend.arrays import Complexes, Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.laws.creep_function import CreepFunction
from viscontact.units.display import Displayable
from viscontact.units.numbers import positive, real_array


@dataclass(frozen=True, eq=False, repr=False)
class Law(Displayable, CreepFunction):
    """A linear viscoelastic law in shear: creep compliance and relaxation modulus.

    ``law(t)`` is the creep compliance Phi(t), strain deviator per unit stress deviator, so that
    Phi(0) = 1/(2 G_0); ``law.relaxation(t)`` is the plain shear modulus G(t). The two are
    inverse in the sense 2 s² L[Phi](s) L[G](s) = 1.

    Examples
    --------
    >>> from viscontact.bodies.laws import Maxwell
    >>> law = Maxwell(shear_modulus=1e6, viscosity=2e6)
    >>> law(2.0), round(law.relaxation(2.0))  # 1/(2 G) + t/(2 eta), G exp(-t G/eta)
    (1e-06, 367879)
    """

    @overload
    def complex_modulus(self, angular_frequency: float) -> complex: ...
    @overload
    def complex_modulus(self, angular_frequency: Sequence[float] | Floats) -> Complexes: ...
    def complex_modulus(self, angular_frequency: ArrayLike) -> complex | Complexes:
        """Return the complex shear modulus G* = G' + i G''.

        Parameters
        ----------
        angular_frequency : float or array_like
            ω > 0 [rad/s]; 2π times the frequency in Hz.

        Returns
        -------
        complex or ndarray
            Stress amplitude per amplitude of the shear angle exp(i ω t) [Pa]: the storage
            modulus G' and the loss modulus G'', both >= 0.

        Raises
        ------
        ValueError
            If a frequency is not positive and finite.

        Notes
        -----
        G*(ω) = i ω L[G](i ω) = 1 / (2 i ω L[Phi](i ω)) (Tschoegl 1989,
        The Phenomenological Theory of Linear Viscoelastic Behavior, section 2.2).
        """
        omega = real_array("angular_frequency", angular_frequency, "rad/s")
        wrong = ~(np.isfinite(omega) & (omega > 0))
        if wrong.any():
            raise ValueError(
                "angular_frequency must be positive and finite, got "
                f"{float(omega[wrong][0])!r} rad/s; the modulus at rest is relaxation(t) at late t"
            )
        values = self._complex_modulus(omega)
        return complex(values) if omega.ndim == 0 else values

    @abstractmethod
    def slowed(self, factor: float) -> Law:
        """Return the law with every time multiplied by a factor: Phi(t/factor), G(t/factor).

        Parameters
        ----------
        factor : float
            Time-temperature shift factor a_T > 0 [-]; above 1 the material is slower.

        Returns
        -------
        Law
            The same law, `factor` times slower.

        Raises
        ------
        ValueError
            If the factor is not positive and finite.
        """

    def stiffened(self, factor: float) -> Self:
        """Return the law with every modulus and viscosity multiplied by a factor.

        Parameters
        ----------
        factor : float
            Vertical shift factor b_T > 0 [-]; compliances and fluidities are divided by it.

        Returns
        -------
        Law
            The same law, `factor` times as stiff at all times.

        Raises
        ------
        ValueError
            If the factor is not positive and finite.

        Examples
        --------
        >>> from viscontact.bodies.laws import Maxwell
        >>> Maxwell(shear_modulus=1e6, viscosity=2e6).stiffened(1.5)
        Maxwell(shear_modulus=1500000.0, viscosity=3000000.0)
        """
        factor = positive("stiffened: factor", factor)
        powers = {"Pa": 1, "Pa s": 1, "1/Pa": -1, "1/(Pa s)": -1}
        changed: dict[str, Any] = {}
        for each in fields(self):
            value, power = getattr(self, each.name), powers.get(each.metadata.get("unit", ""))
            if isinstance(value, Law):
                changed[each.name] = value.stiffened(factor)
            elif power is not None:
                scaled = np.multiply(value, factor**power)
                changed[each.name] = scaled.tolist()
        return replace(self, **changed)

    @property
    def creep_error(self) -> float:
        """Estimated relative error of Phi alone, which a contact depends on [-]; 0 if given."""
        return self.inversion_error

    @abstractmethod
    def _complex_modulus(self, omega: Floats) -> Complexes: ...


def slowing(factor: float) -> float:
    """Return the factor of `Law.slowed` as a float; ValueError unless positive and finite."""
    return positive("slowed: factor", factor)
