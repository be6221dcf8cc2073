"""Load program: segments of mixed control, each up to a duration or a condition."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field

from viscontact.backend.lazy_dataclass import dataclass
from viscontact.bodies.loads.history import Control
from viscontact.bodies.loads.program_sentences import (
    OF_FRICTION,
    SCALARS,
    SLIDING,
    parsed_condition,
    parsed_sentences,
)
from viscontact.units.dimensions import DIMENSIONS
from viscontact.units.formatting import format_quantity
from viscontact.units.numbers import check_fields, finite, positive, store

#: Units of what a segment prescribes.
CONTROL_UNITS: dict[Control, str] = {"force": "N", "approach": "m"}


@dataclass(frozen=True)
class Condition:
    """A scalar of the contact comes to a value, from either side, or contact is lost.

    Parameters
    ----------
    scalar : str
        "force", "approach", "contact_area", "contact_length", "contact_width", "peak_pressure",
        "mean_pressure", "tilt_x" or "tilt_y"; under friction "slip_fraction", "stick_area",
        "friction_heat", "torque", "rotation", or "tangential_force_x", "tangential_displacement_x"
        and those along y; or "contact", which is lost, or "full slip".
    value : float
        Value to be reached [SI unit of the scalar]; none for "contact" and "full slip".

    Raises
    ------
    ValueError
        If there is no such scalar, or the value is not a finite number.

    Examples
    --------
    >>> str(Condition("force", 1e-8)), str(Condition("contact"))
    ('force reaches 10 nN', 'contact is lost')
    """

    scalar: str
    value: float = field(default=0.0, metadata={"unit": "1"})

    def __post_init__(self) -> None:
        if self.scalar not in (*SCALARS, "contact", SLIDING):
            raise ValueError(
                f"condition: no scalar is called {self.scalar!r}; known are {', '.join(SCALARS)}, "
                f"contact and {SLIDING}"
            )
        store(self, value=finite("condition: value", self.value, self.unit))

    def __str__(self) -> str:
        if self.scalar == "contact":
            return "contact is lost"
        if self.scalar == SLIDING:
            return "the whole contact slips"
        return f"{self.scalar} reaches {format_quantity(self.value, self.unit, 6)}"

    @property
    def unit(self) -> str:
        """SI unit of the scalar; "1" for a number, contact and slip."""
        dimension = SCALARS.get(self.scalar)
        return "1" if dimension is None else DIMENSIONS[dimension].unit

    @property
    def needs_friction(self) -> bool:
        """True if it is on a scalar that only a contact under friction has."""
        return self.scalar in (*OF_FRICTION, SLIDING)


@dataclass(frozen=True)
class Segment:
    """Part of a load program: approach or force changes at a rate, from where it is.

    Parameters
    ----------
    rate : float
        Rate of the approach [m/s] or of the force [N/s]; 0 holds it.
    control : {"approach", "force"}
        What is prescribed.
    duration : float, optional
        Duration, positive [s].
    until : Condition or str, optional
        What ends the segment, in place of a duration: "force reaches 10 nN", "contact is lost".

    Raises
    ------
    ValueError
        If not exactly one of duration and until is given, or a number or text cannot be used.

    Examples
    --------
    >>> Segment(rate=1e-6, until="force reaches 10 nN").until
    Condition(scalar='force', value=1e-08)
    """

    rate: float = field(default=0.0, metadata={"unit": {"force": "N/s", "approach": "m/s"}})
    control: Control = "approach"
    duration: float | None = field(default=None, metadata={"unit": "s"})
    until: Condition | str | None = None

    def __post_init__(self) -> None:
        if self.control not in ("approach", "force"):
            raise ValueError(f'segment: control is "approach" or "force", got {self.control!r}')
        store(self, rate=finite("segment: rate", self.rate))
        if (self.duration is None) == (self.until is None):
            raise ValueError("segment: give either duration= in s or until=, one of them")
        if self.duration is not None:
            store(self, duration=positive("segment: duration", self.duration, "s"))
        elif isinstance(self.until, str):
            store(self, until=Condition(*parsed_condition(self.until)))
        elif not isinstance(self.until, Condition):
            raise ValueError(f"segment: until must be a Condition or a text, got {self.until!r}")

    def __str__(self) -> str:
        """Sentence that describes the segment."""
        length = "" if self.duration is None else f" for {format_quantity(self.duration, 's', 6)}"
        end = length or f" until {self.until}"
        if self.rate == 0:
            return f"hold {'height' if self.control == 'approach' else 'force'}{end}"
        verbs = {"approach": ("move", "retract"), "force": ("load", "unload")}
        verb, unit = verbs[self.control][self.rate < 0], CONTROL_UNITS[self.control]
        return f"{verb} at {format_quantity(abs(self.rate), unit, 6)}/s{end}"


@dataclass(frozen=True)
class LoadProgram:
    """Load as an instrument applies it: in segments of mixed control that end on conditions.

    It begins with the undeformed bodies just touching, without force. Each segment goes on from the
    force or approach that the one before has left. The run finds the instants at which conditions
    are met, adds them to its times, and ends with the last segment, or where a stop condition is
    met. The attribute ``events`` of the result lists them. A condition is met where its scalar
    crosses the value between two of the run's steps; what comes and goes between them is not seen.

    Parameters
    ----------
    segments : str or sequence
        What happens in turn: sentences such as "move at 1 um/s until force reaches 10 nN", "hold
        height for 5 s", "hold force for 10 s", "load at 2 N/s for 3 s", "retract at 2 um/s until
        contact is lost", "stop when contact_area exceeds 2 mm2", or `Segment` objects.
    stop : sequence of Condition or str
        Conditions that end the run in any segment.
    eccentricity_x, eccentricity_y : float
        Position of the force, in programs that prescribe the force throughout, whose tilt
        along that axis is free [m].
    tilt_x, tilt_y : float or None
        Slopes along x and y throughout; None lets that tilt go free [rad].
    stage_stiffness : float, optional
        Move, retract and height are those of a stage on which the body hangs by a spring, as in
        `ApproachHistory` [N/m].

    Raises
    ------
    ValueError
        If a sentence or a number cannot be used, there is no segment, or an eccentricity does not
        fit.

    Examples
    --------
    >>> program = LoadProgram("move at 1 um/s until force reaches 10 nN; hold height for 5 s")
    >>> len(program.segments), program.segments[1].duration
    (2, 5.0)
    """

    segments: str | Sequence[Segment | str]
    stop: Sequence[Condition | str] = ()
    eccentricity_x: float = field(default=0.0, metadata={"unit": "m"})
    eccentricity_y: float = field(default=0.0, metadata={"unit": "m"})
    tilt_x: float | None = field(default=0.0, metadata={"unit": "rad"})
    tilt_y: float | None = field(default=0.0, metadata={"unit": "rad"})
    stage_stiffness: float | None = field(
        default=None, metadata={"unit": "N/m", "recorded": "if given"}
    )

    def __post_init__(self) -> None:
        given = [self.segments] if isinstance(self.segments, str) else self.segments
        stops = [self.stop] if isinstance(self.stop, str | Condition) else self.stop
        segments: list[Segment] = []
        conditions = [
            each if isinstance(each, Condition) else Condition(*parsed_condition(each))
            for each in stops
        ]
        for each in given:
            if isinstance(each, Segment):
                segments.append(each)
                continue
            for sentence in parsed_sentences(each):
                if sentence.stops is not None:
                    conditions.append(Condition(*sentence.stops))
                    continue
                until = None if sentence.until is None else Condition(*sentence.until)
                segments.append(Segment(sentence.rate, sentence.control, sentence.duration, until))
        if not segments:
            raise ValueError(
                "load program: there is no segment; write e.g. 'move at 1 um/s until force reaches "
                "10 nN'"
            )
        tilts = {
            name: None if tilt is None else finite(name, tilt, "rad")
            for name, tilt in (("tilt_x", self.tilt_x), ("tilt_y", self.tilt_y))
        }
        places = {
            name: finite(name, getattr(self, name), "m")
            for name in ("eccentricity_x", "eccentricity_y")
        }
        check_fields(self, "stage_stiffness")
        store(self, segments=tuple(segments), stop=tuple(conditions), **tilts, **places)
        self._refuse_eccentric_approach()

    @property
    def parts(self) -> tuple[Segment, ...]:
        """The segments, as they were read."""
        return tuple(each for each in self.segments if isinstance(each, Segment))

    def _refuse_eccentric_approach(self) -> None:
        for axis in "xy":
            name = f"eccentricity_{axis}"
            if getattr(self, name) == 0:
                continue
            if getattr(self, f"tilt_{axis}") is not None:
                raise ValueError(f"{name} goes with a free tilt; leave it out, or tilt_{axis}=None")
            if any(each.control == "approach" for each in self.parts):
                raise ValueError(
                    f"{name} goes with segments that prescribe the force, and this program also "
                    "prescribes the approach; leave it out, or prescribe the force throughout"
                )
