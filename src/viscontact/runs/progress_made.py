"""Progress of a run over time, in words."""

from __future__ import annotations

from collections.abc import Sequence

from viscontact.units.formatting import format_quantity


def progress_made(
    done: int, reached: float | None, times: Sequence[float], adaptive: object
) -> str:
    """Describe the progress of a run, with times in seconds."""
    if adaptive is None:
        return f"{done} of {len(times)} instants"
    if reached is None:
        return "0 instants"
    return (
        f"{done} instants, up to t = {format_quantity(reached, 's')} of "
        f"{format_quantity(times[-1], 's')}"
    )
