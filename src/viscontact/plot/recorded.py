"""What a result tells of the case it came from."""

from __future__ import annotations

import json
from typing import Any

import xarray as xr

from viscontact import description


def recorded_noun(results: xr.Dataset, part: str, figure: str) -> Any:
    """Rebuild a part of the case that is kept with a result.

    Parameters
    ----------
    results : xarray.Dataset
        What `viscontact.simulate` or `viscontact.open_results` returned.
    part : str
        ``"indenter"``, ``"material"``, ``"indenter_material"`` or ``"load"``.
    figure : str
        Name of the figure, for the message.

    Returns
    -------
    object
        The indenter, material or load history; None where the case has no such part.

    Raises
    ------
    ValueError
        If the result carries no case, or a part that is too large to be kept.
    """
    if "case" not in results.attrs:
        raise ValueError(
            f"{figure}: needs to know the {part} of the case, but the result has no attribute "
            "'case'; give a result as simulate or open_results returned it"
        )
    described = json.loads(results.attrs["case"]).get(part)
    try:
        return None if described is None else description.rebuild(described)
    except ValueError as error:
        raise ValueError(f"{figure}: cannot rebuild the {part}: {error}") from error
