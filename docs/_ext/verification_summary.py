"""Short table of the verification page, from its long one."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from statistics import median

from viscontact.verify import (
    coupled_friction,
    creeping_friction,
    edges,
    elastic,
    fixed_contact,
    friction,
    growing,
    layers,
    line_contact,
    moving_contact,
    periodic,
    steady_motion,
    temperature,
    unloading,
)

#: Rows of the short table.
_GROUPS = {
    "elastic contact of smooth bodies and punches": elastic,
    "profiled rollers and singular edges": edges,
    "contacts that grow on creeping bodies": growing,
    "contacts that shrink, are lost and made again": unloading,
    "contacts of constant or known area": fixed_contact,
    "friction between elastic bodies": friction,
    "friction on creeping bodies": creeping_friction,
    "friction of dissimilar bodies": coupled_friction,
    "temperatures that vary, and ageing": temperature,
    "layers on a rigid base": layers,
    "periodic wavy surfaces": periodic,
    "line contacts": line_contact,
    "moving contacts in time": moving_contact,
    "steady motion": steady_motion,
}


def verification_summary(page: Path) -> str:
    """Return a table of the errors of each group of cases, from the table of all of them."""
    errors: dict[str, list[tuple[float, str]]] = {}
    for case, quantity, error in _rows(page):
        errors.setdefault(case, []).append((error, quantity))
    lines = ["| problems | comparisons | median error | largest error |", "|---|---|---|---|"]
    for title, module in _GROUPS.items():
        found = [
            (error, f"{quantity}: {case.name}")
            for case in module.CASES
            for error, quantity in errors[case.name]
        ]
        middle, (largest, where) = median(error for error, _ in found), max(found)
        lines.append(f"| {title} | {len(found)} | {middle:.0e} | {largest:.0e} ({where}) |")
    return "\n".join(lines)


def _rows(page: Path) -> Iterator[tuple[str, str, float]]:
    """Case, quantity and error of each row of the long table."""
    case = ""
    for line in page.read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 9 and cells[0] not in ("case", "---"):
            case = cells[0] or case
            yield case, cells[2], float(cells[5])
