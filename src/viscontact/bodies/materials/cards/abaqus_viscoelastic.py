"""The option *VISCOELASTIC of Abaqus and its test data, as relaxation of a record."""

from __future__ import annotations

from collections.abc import Sequence

from viscontact.bodies.materials.cards.abaqus_syntax import Block, DataLine
from viscontact.bodies.materials.cards.card import CardUnits
from viscontact.bodies.materials.cards.oscillation_data import FrequencyFormula, Oscillation
from viscontact.bodies.materials.cards.prony_terms import checked_terms
from viscontact.bodies.materials.cards.record import PronySeries, Relaxation
from viscontact.bodies.materials.cards.test_data import NormalisedTest

_IN_TIME = ("PRONY", "CREEP TEST DATA", "RELAXATION TEST DATA", "FREQUENCY DATA")
_IN_FREQUENCY = ("PRONY", "CREEP TEST DATA", "RELAXATION TEST DATA", "TABULAR", "FORMULA")
_TESTS = ("CREEP TEST DATA", "RELAXATION TEST DATA")


def over_frequency(block: Block) -> bool:
    """Return whether a *VISCOELASTIC is in the frequency domain."""
    return block.given("FREQUENCY") is not None


def relaxation_of(
    block: Block, tests: Sequence[Block], units: CardUnits, notes: list[str]
) -> Relaxation:
    """Return the relaxation of a *VISCOELASTIC; what is not used of it is added to `notes`."""
    kind = _kind(block)
    if kind == "PRONY":
        return _prony(block, units)
    if kind == "FORMULA":
        return _formula(block, units)
    if kind in _TESTS:
        _note_fit(block, notes)
        return _test_data(block, tests, kind == "CREEP TEST DATA", units, notes)
    _note_fit(block, notes)
    return _oscillation(block, units)


def _kind(block: Block) -> str:
    if block.given("NONLINEAR") is not None:
        raise ValueError(
            f"{block.where}: *VISCOELASTIC, NONLINEAR is not read: it is a nonlinear network, and "
            "the contact is linear viscoelastic; give TIME=PRONY or test data"
        )
    block.choice("TYPE", ("ISOTROPIC",), "ISOTROPIC")
    if block.given("PRELOAD") is not None:
        raise ValueError(
            f"{block.where}: *VISCOELASTIC, PRELOAD is not read: its moduli depend on a "
            "prestrain; give those of one state without PRELOAD"
        )
    if over_frequency(block):
        return block.choice("FREQUENCY", _IN_FREQUENCY, "")
    if block.given("TIME") is None:
        raise ValueError(f"{block.where}: *VISCOELASTIC must say TIME=PRONY or another kind")
    return block.choice("TIME", _IN_TIME, "")


def _note_fit(block: Block, notes: list[str]) -> None:
    for word in ("ERRTOL", "NMAX"):
        if block.given(word) is not None:
            notes.append(f"{block.where}: {word} is not used: test data are taken as measured")


def _rows(block: Block, count: int, least: int | None = None) -> list[list[float]]:
    if not block.data:
        raise ValueError(f"{block.where}: *{block.keyword} has no data lines")
    return [line.numbers(count if least is None else least, count) for line in block.data]


def _prony(block: Block, units: CardUnits) -> PronySeries:
    rows = _rows(block, 3)
    times = [tau * units.time for _, _, tau in rows]
    return PronySeries(
        checked_terms(f"{block.where}: shear terms g", [g for g, _, _ in rows], times),
        checked_terms(f"{block.where}: bulk terms k", [k for _, k, _ in rows], times),
    )


def _formula(block: Block, units: CardUnits) -> FrequencyFormula:
    if len(block.data) != 1:
        raise ValueError(f"{block.where}: FREQUENCY=FORMULA must have one line of g_1, a, k_1, b")
    real, imaginary, a, bulk_real, bulk_imaginary, b = block.data[0].numbers(3, 6)
    bulk = complex(bulk_real, bulk_imaginary)
    return FrequencyFormula(
        block.data[0].where,
        complex(real, imaginary) * units.time ** (1 - a) if 0 <= a < 1 else 0j,
        a,
        bulk_relaxes=bulk != 0,
        bulk_alike=(bulk, b) == (complex(real, imaginary), a),
    )


def _oscillation(block: Block, units: CardUnits) -> Oscillation:
    rows = _rows(block, 5)
    return Oscillation(
        block.where,
        tuple(f / units.time for *_, f in rows),
        tuple(complex(1 - stored, lost) for lost, stored, *_ in rows),
        tuple(complex(1 - stored, lost) for _, _, lost, stored, _ in rows),
    )


def _test_data(
    block: Block, tests: Sequence[Block], creep: bool, units: CardUnits, notes: list[str]
) -> NormalisedTest:
    by_name = {test.keyword: test for test in tests}
    source = by_name.get("COMBINED TEST DATA", by_name.get("SHEAR TEST DATA"))
    if source is None:
        raise ValueError(f"{block.where}: *SHEAR TEST DATA is missing below *VISCOELASTIC")
    combined = source.keyword == "COMBINED TEST DATA"
    rows = [line.numbers(*((3, 3) if combined else (2, 2))) for line in source.data]
    bulk = [(k, t) for _, k, t in rows] if combined else _volumetric(by_name)
    found = NormalisedTest(
        source.where,
        tuple(line.where for line in source.data),
        creep,
        tuple(row[-1] * units.time for row in rows),
        tuple(row[0] for row in rows),
        tuple((value, time * units.time) for value, time in bulk),
        _infinite(source),
    )
    if found.infinite is not None and not found.ends:
        notes.append(f"{source.where}: SHRINF is not used beyond the last of the test data")
    return found


def _volumetric(by_name: dict[str, Block]) -> list[tuple[float, float]]:
    block = by_name.get("VOLUMETRIC TEST DATA")
    rows = [] if block is None else [line.numbers(2, 2) for line in block.data]
    return [(value, time) for value, time in rows]


def _infinite(block: Block) -> float | None:
    given = block.given("SHRINF")
    if given is None:
        return None
    [value] = DataLine(f"{block.where}: SHRINF", (given,)).numbers(1, 1)
    if not value > 0:
        raise ValueError(f"{block.where}: SHRINF must be positive, got {value!r}")
    return value
