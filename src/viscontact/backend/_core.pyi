"""Compiled inner loops of the package; sources in ``src/core``."""

from collections.abc import Sequence

from viscontact.backend.arrays import Bools, Floats, Numbers, Singles

#: Counts changes of what functions take, return or mean.
INTERFACE: int
#: Hash of the sources that it was compiled of.
SOURCES: str

Triple = tuple[float, float, float]
Free = tuple[bool, bool, bool]
Matrix = tuple[Triple, Triple, Triple]
Trends = tuple[Floats, Bools, Floats, Bools, Bools]

class Plane:
    """Cells of a patch."""

    def __init__(
        self,
        x: Floats,
        y: Floats,
        cell_size: tuple[float, float],
        mirrored: tuple[bool, bool],
        threads: int,
        /,
    ) -> None: ...

class EdgeLaw:
    """Law of the gaps or pressures beside a straight edge."""

    def __init__(
        self,
        threshold: float,
        growth: tuple[float, float],
        slopes: Sequence[float],
        offsets: Sequence[float],
        /,
    ) -> None: ...

# The search: see `viscontact.mechanics.contact.passes.contract`.
def measure(
    plane: Plane,
    pressure: Floats,
    displacement: Floats,
    open_gap: Floats,
    compliance: float,
    motion: Triple,
    free: Free,
    unit: float,
    contact: Bools,
    gap: Numbers,
    step: tuple[Floats, Singles, Singles, float, float] | None,
    /,
) -> tuple[Triple, Matrix, float, float]: ...
def release(
    plane: Plane, active: Bools, last: Bools, gap: Singles, free: Free, /
) -> tuple[int, int, Matrix]: ...
def follow(stiffness: Singles, active: Bools, last: Bools, near: Singles, /) -> None: ...
def direct(
    plane: Plane,
    found: Singles,
    direction: Singles,
    residual: Singles,
    last_residual: Singles,
    active: Bools,
    stiffness: Singles,
    correction: float,
    shift: float,
    inverse: Sequence[Sequence[float]],
    last_slope: float,
    changed: bool,
    /,
) -> float: ...
def trial(
    plane: Plane,
    pressure: Floats,
    direction: Singles,
    length: float,
    ahead: Floats,
    targets: Triple,
    free: Free,
    cell_area: float,
    arm: float,
    scale: float,
    step: Singles,
    /,
) -> bool: ...
def balance(
    plane: Plane,
    pressure: Floats,
    targets: Triple,
    free: Free,
    cell_area: float,
    arm: float,
    /,
) -> bool: ...
def weigh(
    plane: Plane,
    pressure: Floats,
    targets: Triple,
    free: Free,
    cell_area: float,
    arm: float,
    /,
) -> tuple[float, float]: ...
def difference(
    plane: Plane, ahead: Floats, pressure: Floats, scale: float, step: Singles, /
) -> None: ...
def inner(
    plane: Plane, field: Singles, first: Singles, second: Singles, /
) -> tuple[float, float]: ...
def move(
    plane: Plane,
    pressure: Floats,
    displacement: Floats,
    step: Singles,
    change: Singles,
    length: float,
    /,
) -> float: ...
def sums(plane: Plane, values: Floats, /) -> Triple: ...
def press(
    plane: Plane, gap: Floats, motion: Triple, bearing: Floats, share: float, free: Free, /
) -> tuple[float, Triple, Matrix]: ...

# Between steps: see `viscontact.backend.team` and `viscontact.mechanics.contact.recession`.
def weighted_sum(
    total: Floats, weights: list[float], fields: list[Floats], threads: int, /
) -> None: ...
def mean_change(where: Bools, late: Floats, early: Floats | None, threads: int, /) -> float: ...
def step_change(
    pressure: Floats,
    pressure_before: Floats,
    late: Floats,
    early: Floats,
    duration: float,
    rate_before: Floats | None,
    rate: Floats,
    threads: int,
    /,
) -> Triple: ...
def largest_mean(values: Floats, window: float, /) -> float: ...
def follow_trends(
    gap: Floats,
    pressure: Floats,
    in_contact: Bools,
    error: float,
    turns: float,
    before: Trends,
    after: Trends,
    threads: int,
    /,
) -> None: ...
def unfold(part: Floats, whole: Floats, /) -> None: ...
def unfold_flags(part: Bools, whole: Bools, /) -> None: ...

# The rim: see `viscontact.mechanics.contact.rim` and `rim_crossings`.
def trace_rim(
    contact: Bools,
    gap: Floats,
    gap_x: EdgeLaw,
    gap_y: EdgeLaw,
    pressure_x: EdgeLaw,
    pressure_y: EdgeLaw,
    recession: tuple[Floats, Bools, Bools, Bools] | None,
    ends: tuple[Floats, Floats] | None,
    mirrored: tuple[bool, bool],
    inner: tuple[int, int, int, int],
    segment: float,
    /,
) -> tuple[float, float, float, int, int]: ...
def segment(contact: Bools, gap: Floats, of: Triple, /) -> float: ...
def spans(cells: Bools, /) -> tuple[int, int, int, int]: ...

# Transforms: see `viscontact.backend.transforms`.
def filter(spectrum: Numbers, symbol: Numbers, axis: int, /) -> None: ...
def largest(array: Numbers) -> float: ...

class SingleFilter:
    """Filter of fields by their spectra in single precision."""

    def __init__(
        self,
        shape: tuple[int, int],
        lengths: tuple[int, int],
        even: tuple[bool, bool],
        symbol: Floats,
        threads: int,
        /,
    ) -> None: ...
    @property
    def work(self) -> int: ...
    def read_symbol(self, into: Floats, /) -> None: ...
    def apply(
        self, field: Singles | Floats, size: float, into: Singles | Floats, work: Singles, /
    ) -> None: ...

class DoubleFilter:
    """Filter of fields by their spectra in double precision."""

    def __init__(
        self,
        shape: tuple[int, int],
        lengths: tuple[int, int],
        even: tuple[bool, bool],
        symbol: Floats,
        threads: int,
        /,
    ) -> None: ...
    @property
    def work(self) -> int: ...
    def read_symbol(self, into: Floats, /) -> None: ...
    def apply(self, field: Floats, size: float, into: Floats, work: Floats, /) -> None: ...

class Operators:
    """Operators of a patch, for iterations of its search."""

    def __init__(
        self,
        convolution: SingleFilter,
        preconditioner: SingleFilter,
        stiffness: SingleFilter,
        near: Singles,
        few: int,
        /,
    ) -> None: ...
    @property
    def work(self) -> int: ...

# See `viscontact.mechanics.contact.passes.compiled_passes`.
def advance(
    plane: Plane,
    operators: Operators,
    work: Singles,
    pressures: tuple[Floats, Floats],
    actives: tuple[Bools, Bools],
    residuals: tuple[Singles, Singles],
    directions: tuple[Singles, Singles, Singles, Singles],
    targets: Triple,
    free: Free,
    cell_area: float,
    arm: float,
    inverse: Matrix,
    correction: float,
    last_slope: float,
    length: float,
    unit: float,
    /,
) -> tuple[float, bool, float, float]: ...
