"""Describe a run as plain data: the attributes that its result carries."""

from __future__ import annotations

import json
from typing import Any

from viscontact import __version__
from viscontact.results.provenance import describe
from viscontact.simulation.setup import RunSetup


def run_attributes(run: RunSetup) -> dict[str, Any]:
    """Attributes that every result of a run carries.

    Parameters
    ----------
    run : RunSetup
        The run.

    Returns
    -------
    dict
        Conventions, version, the case as JSON, tolerance, whose Fourier transforms, memory.
    """
    return {
        "Conventions": "CF-1.11",
        "source": f"viscontact {__version__}",
        "version": __version__,
        "case": json.dumps(describe_run(run)),
        "tolerance": run.tolerance,
        "transforms": run.transforms,
        "memory": run.memory.method,
        "memory_error": run.memory.error,
        "inversion_error": run.compliance.inversion_error,
    }


def describe_run(run: RunSetup) -> dict[str, Any]:
    """Describe a whole run.

    Parameters
    ----------
    run : RunSetup
        The run.

    Returns
    -------
    dict
        Indenter, materials, load, grid (and what was asked of it if it is automatic), times [s]
        and tolerance.
    """
    return {
        "indenter": describe(run.indenter),
        "material": describe(run.material),
        "indenter_material": describe(run.indenter_material),
        "load": describe(run.load),
        "grid": describe(run.grid),
        "automatic": describe(run.automatic),
        "times": describe(run.times),
        "adaptive": describe(run.adaptive),
        "tolerance": run.tolerance,
    }
