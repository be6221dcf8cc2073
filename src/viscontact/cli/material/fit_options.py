"""Arguments of `fit`, and their meaning for a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any, Self

from viscontact import identification
from viscontact.backend.arrays import Floats
from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.indenters import Cone, FlatPunch, Indenter, Pyramid, Sphere
from viscontact.bodies.series_fits.prony import FitOptions
from viscontact.bodies.series_fits.reduced_record import ShiftOptions
from viscontact.bodies.series_fits.shift_rules import RULES
from viscontact.identification import (
    ForceCurve,
    IndentationFit,
    IndentationRecord,
    fit_indentation,
)
from viscontact.identification.candidates import CANDIDATES
from viscontact.identification.fitted_part import PARTS
from viscontact.identification.force_curve import tabulated_curve
from viscontact.identification.vertical_shift import VERTICALS, SuperpositionOptions
from viscontact.tables import Table
from viscontact.units.parsing import parse_quantity

_USUAL_LAW, _SERIES = "zener", "creep-series"


@dataclass(frozen=True)
class FitArguments:
    """Arguments of `fit`, as typed."""

    data: str | None = None
    poisson_ratio: float | None = None
    bulk_modulus: str | None = None
    terms: int | None = None
    fluid: bool = False
    reference: str | None = None
    temperature: str | None = None
    indenter: str | None = None
    adhesion: bool = False
    law: str | None = None
    weight: Sequence[str] = ()
    stress: str | None = None
    columns: str | None = None
    spring_constant: str | None = None
    sensitivity: str | None = None
    vertical: str | None = None
    expansion: float | None = None
    reach: float | None = None
    until: str | None = None
    shift: str | None = None
    thermal_strain: str | None = None  # "yes" or "no"
    reference_time: str | None = None
    thickness: str | None = None

    @classmethod
    def of(cls, typed: Mapping[str, Any]) -> Self:
        """Arguments among the options by name."""
        given = {each.name: typed[each.name] for each in fields(cls)}
        return cls(**{**given, "weight": given["weight"] or ()})

    @property
    def given(self) -> list[str]:
        """Names of the arguments that were typed."""
        return [each.name for each in fields(self) if getattr(self, each.name) != each.default]

    @property
    def weights(self) -> dict[str, float] | None:
        """Weights of storage and loss; None if none are given."""
        return dict(map(read_weight, self.weight)) or None

    @property
    def indented_law(self) -> str:
        """Law of an indentation record."""
        usual = "elastic" if self.adhesion else _USUAL_LAW
        return usual if self.law is None else self.law

    @property
    def expands(self) -> bool | None:
        """Whether the strain of a creep test has thermal expansion; None to find out."""
        return None if self.thermal_strain is None else self.thermal_strain == "yes"

    def options(self, table: Table) -> FitOptions:
        """Return the options for the fit of a series to a table."""
        data = self.data or table.data
        if data is None:
            raise ValueError(
                f"{table.source.name}: the headings do not say what kind of test it is; add "
                "--data shear, --data uniaxial or --data deviatoric"
            )
        options = FitOptions(data=data, fluid=self.fluid, terms=self.terms)
        if data != "uniaxial":
            return options
        if self.poisson_ratio is None and self.bulk_modulus is None:
            raise ValueError(
                f"{table.source.name}: uniaxial data need --poisson-ratio, such as 0.38, or "
                "--bulk-modulus, such as '4 GPa'"
            )
        options["poisson_ratio"], options["bulk_modulus"] = self.volume()
        return options

    def superposition(self) -> SuperpositionOptions:
        """Return the options for the master curve of several temperatures."""
        options = SuperpositionOptions()
        if self.vertical is not None:
            if self.vertical not in VERTICALS:
                raise ValueError(
                    f"--vertical must be one of {', '.join(VERTICALS)}, got {self.vertical!r}"
                )
            options["vertical"] = self.vertical
        if self.expansion is not None:
            if self.vertical != "rubber":
                raise ValueError("--expansion goes with --vertical rubber")
            options["expansion"] = self.expansion
        return options

    def on_clock(self, temperature: Floats) -> ShiftOptions:
        """Return the options for a test under a temperature that varies, that of its rows [K]."""
        if self.shift not in (None, *RULES):
            raise ValueError(f"--shift must be one of {', '.join(RULES)}, got {self.shift!r}")
        options = ShiftOptions(temperature=temperature, shift=self.shift)
        if self.reference is not None:
            options["reference_temperature"] = read_kelvin("--reference", self.reference)
        return options

    def volume(self) -> tuple[float | None, float | None]:
        """Return Poisson's ratio [-] and the bulk modulus [Pa], None where not given."""
        if self.bulk_modulus is None:
            return self.poisson_ratio, None
        return self.poisson_ratio, _read_option("--bulk-modulus", self.bulk_modulus, "pressure")

    def indenter_of(self, name: str) -> Indenter:
        """Return the indenter of an indentation record in a file of this name."""
        if self.indenter is None:
            raise ValueError(
                f"{name}: an indentation record needs --indenter, such as 'sphere 5 um'"
            )
        if self.poisson_ratio is None and self.bulk_modulus is None:
            raise ValueError(
                f"{name}: an indentation record needs --poisson-ratio, such as 0.4, "
                "or --bulk-modulus"
            )
        self._refuse_terms_of_another_law(name)
        return read_indenter(self.indenter)

    def force_curve(self, table: Table) -> ForceCurve:
        """Return the force curve of a table."""
        stiffness = self.stiffness()
        if stiffness is None:
            raise ValueError(
                f"{table.source.name}: a force curve needs --spring-constant, such as '0.1 N/m'"
            )
        if "signal" in table and self.sensitivity is None:
            raise ValueError(
                f"{table.source.name}: a deflection in volts needs --sensitivity, such as '50 nm/V'"
            )
        sensitivity = self.sensitivity and _read_option(
            "--sensitivity", self.sensitivity, "sensitivity"
        )
        return tabulated_curve(table, stiffness, sensitivity or None)

    def stiffness(self) -> float | None:
        """Return the spring constant [N/m], None where it is not given."""
        if self.spring_constant is None:
            return None
        return _read_option("--spring-constant", self.spring_constant, "stiffness")

    def end(self) -> str | float | None:
        """Return the end of the fitted part: its name, an instant [s], or None."""
        if self.until is None or self.until in PARTS:
            return self.until
        try:
            return parse_quantity(self.until, "time")
        except ValueError:
            raise ValueError(
                f"--until: must be loading, hold, end or a time such as '2.5 s', got {self.until!r}"
            ) from None

    def fitted(self, record: IndentationRecord) -> IndentationFit:
        """Fit the law to an indentation record."""
        poisson_ratio, bulk_modulus = self.volume()
        reference = None
        if self.reference_time is not None:
            reference = _read_option("--reference-time", self.reference_time, "time")
        thickness = None
        if self.thickness is not None:
            thickness = _read_option("--thickness", self.thickness, "length")
        return fit_indentation(
            record,
            self.indented_law,
            terms=1 if self.terms is None else self.terms,
            poisson_ratio=poisson_ratio,
            bulk_modulus=bulk_modulus,
            until=self.end(),
            reference_time=reference,
            thickness=thickness,
        )

    def adhering(self, curve: ForceCurve, indenter: Indenter) -> identification.AdhesionFit:
        """Fit adhesion to a force curve."""
        if self.poisson_ratio is None:
            raise ValueError("--adhesion needs --poisson-ratio, such as 0.5, not --bulk-modulus")
        return identification.fit_adhesion(curve, indenter, poisson_ratio=self.poisson_ratio)

    def _refuse_terms_of_another_law(self, name: str) -> None:
        """Refuse a number of terms for an indentation whose law has none."""
        law = self.indented_law
        if self.terms is not None and law in CANDIDATES and law != _SERIES:
            raise ValueError(
                f"{name}: --terms goes with --law {_SERIES}; the law of this indentation is {law}; "
                f"leave --terms out, or choose --law {_SERIES}"
            )


def read_weight(text: str) -> tuple[str, float]:
    """Return the column and the weight given behind ``--weight``."""
    name, _, value = text.partition("=")
    try:
        return name.strip(), float(value)
    except ValueError:
        raise ValueError(f"--weight: {text!r} is not a weight; write e.g. storage=2") from None


def read_stress(text: str | None) -> float | None:
    """Return the stress given behind ``--stress`` [Pa], None where it is not."""
    return None if text is None else _read_option("--stress", text, "pressure")


def read_kelvin(option: str, text: str) -> float:
    """Return the temperature given behind an option [K]."""
    return _read_option(option, text, "temperature")


def _read_option(option: str, text: str, dimension: str) -> float:
    try:
        return parse_quantity(text, dimension)
    except ValueError as error:
        raise ValueError(f"{option}: {error}") from None


#: Pyramids whose angle is given by their name.
_PYRAMIDS = {
    "berkovich": Pyramid.berkovich,
    "vickers": Pyramid.vickers,
    "cube-corner": Pyramid.cube_corner,
}


def read_indenter(text: str) -> Indenter:
    """Return the indenter given behind ``--indenter``."""
    shape, _, size = text.strip().partition(" ")
    try:
        if shape in ("sphere", "paraboloid"):  # the fit's sphere is the paraboloid of its radius
            return Sphere(parse_quantity(size, "length"))
        if shape == "cone":
            return Cone(parse_quantity(size, "angle"))
        if shape == "punch":
            return FlatPunch(parse_quantity(size, "length"))
        if shape == "pyramid":
            return Pyramid(parse_quantity(size, "angle"), faces=4)
        if shape in _PYRAMIDS and not size.strip():
            return _PYRAMIDS[shape]()
    except ValueError as error:
        raise ValueError(f"--indenter: {error}") from None
    raise ValueError(
        f"--indenter: {text!r} is not an indenter; write e.g. 'sphere 5 um', 'paraboloid 40 nm', "
        "'cone 70 deg', 'pyramid 35 deg', 'berkovich', 'vickers', 'cube-corner' or 'punch 2 um'"
    )
