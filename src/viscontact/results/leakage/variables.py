"""The variables of a leakage: units and long names."""

from __future__ import annotations

from viscontact.results.variables import Variable

VARIABLES = {
    "transmissivity": Variable("m3", "transmissivity of the gap: h³/12 between parallel plates"),
    "transmissivity_error": Variable("m3", "error of the transmissivity, by two discretisations"),
    "leak_rate": Variable("m3 s-1", "volume of fluid that leaks in a unit of time"),
    "leak_rate_error": Variable("m3 s-1", "error of the leak rate"),
    "percolates": Variable("1", "1 if a channel leads through, 0 if the contact is closed"),
    "critical_gap": Variable("m", "gap at the narrowest place of the widest channel"),
    "critical_gap_error": Variable("m", "error of the critical gap, by the size of the cells"),
    "critical_x": Variable("m", "position of the critical constriction along x"),
    "critical_y": Variable("m", "position of the critical constriction along y"),
    "effective_gap": Variable("m", "gap of parallel plates of the same transmissivity"),
    "mean_gap": Variable("m", "mean gap"),
    "contact_fraction": Variable("1", "share of cells in contact"),
    "area_fraction": Variable("1", "real over nominal contact area"),
    "transmissivity_effective_medium": Variable("m3", "transmissivity of an effective medium"),
    "flux_imbalance": Variable("1", "largest relative difference of the flow through two sections"),
    "closing_force": Variable("N", "force at which the flow first stops"),
    "closing_force_error": Variable("N", "half of the force between the stored instants"),
    "fluid_pressure": Variable("Pa", "pressure of the fluid over that at the outlet"),
    "flux_x": Variable("m2 s-1", "flow of the fluid along x, for a unit of width"),
    "flux_y": Variable("m2 s-1", "flow of the fluid along y, for a unit of width"),
    "channel": Variable("1", "1 in cells of a channel that leads through"),
}
