"""Exact solutions for verification, in SI units, independent of the solver.

The elastic ones take the contact modulus E* [Pa], the viscoelastic ones a creep compliance
J(t) [1/Pa] and its convolution inverse M(t) [Pa] as callables, or just one of the two.
"""

from viscontact.reference.adhesion import (
    AdhesiveSphere,
    AdhesiveState,
    jkr_sphere,
    maugis_dugdale,
    tabor_number,
)
from viscontact.reference.axisymmetric_contact import AxisymmetricContact
from viscontact.reference.friction import PartialSlip, cattaneo_mindlin
from viscontact.reference.hertz import (
    EllipticalContact,
    SphereContact,
    hertz_elliptical,
    hertz_sphere,
)
from viscontact.reference.indentation import (
    ResolutionError,
    clustered_times,
    press_axisymmetric,
    resolution_error,
)
from viscontact.reference.layer import LayerContact, layer_cone, layer_punch, layer_sphere
from viscontact.reference.layer_torsion import layer_torsion
from viscontact.reference.lee_radok import lee_radok_ramp, lee_radok_step
from viscontact.reference.lee_radok_contact import LeeRadokContact
from viscontact.reference.line import LineContact, hertz_line
from viscontact.reference.line_adhesion import (
    AdhesiveLine,
    AdhesiveLineState,
    adhesive_line,
    adhesive_punch,
    adhesive_wave_pressure,
    edge_energy,
)
from viscontact.reference.profiles import ConeProfile, PunchProfile, SphereProfile
from viscontact.reference.punch import ConeContact, FlatPunchContact, cone, flat_punch
from viscontact.reference.punch_history import (
    PunchOscillation,
    punch_harmonic,
    punch_harmonic_start,
    punch_staircase,
    series_complex_compliance,
)
from viscontact.reference.round_loads import circle_displacement, hertz_displacement
from viscontact.reference.steady_motion import (
    MovingCylinder,
    fast_sphere_friction_coefficient,
    moving_cylinder,
    moving_wave_resistance,
    slow_friction_coefficient,
)
from viscontact.reference.surface_loads import (
    point_load,
    rectangle_displacement,
    rectangle_stress,
    strip_on_layer,
    strip_stresses,
)
from viscontact.reference.ting import TingHump, ting_hump
from viscontact.reference.ting_cycles import TingCycles, ting_cycles
from viscontact.reference.ting_force_triangle import TingForceTriangle, ting_force_triangle
from viscontact.reference.ting_triangle import TingTriangle, ting_triangle
from viscontact.reference.wavy import WavyContact, full_contact_pressure, westergaard

__all__ = [
    "AdhesiveLine",
    "AdhesiveLineState",
    "AdhesiveSphere",
    "AdhesiveState",
    "AxisymmetricContact",
    "ConeContact",
    "ConeProfile",
    "EllipticalContact",
    "FlatPunchContact",
    "LayerContact",
    "LeeRadokContact",
    "LineContact",
    "MovingCylinder",
    "PartialSlip",
    "PunchOscillation",
    "PunchProfile",
    "ResolutionError",
    "SphereContact",
    "SphereProfile",
    "TingCycles",
    "TingForceTriangle",
    "TingHump",
    "TingTriangle",
    "WavyContact",
    "adhesive_line",
    "adhesive_punch",
    "adhesive_wave_pressure",
    "cattaneo_mindlin",
    "circle_displacement",
    "clustered_times",
    "cone",
    "edge_energy",
    "fast_sphere_friction_coefficient",
    "flat_punch",
    "full_contact_pressure",
    "hertz_displacement",
    "hertz_elliptical",
    "hertz_line",
    "hertz_sphere",
    "jkr_sphere",
    "layer_cone",
    "layer_punch",
    "layer_sphere",
    "layer_torsion",
    "lee_radok_ramp",
    "lee_radok_step",
    "maugis_dugdale",
    "moving_cylinder",
    "moving_wave_resistance",
    "point_load",
    "press_axisymmetric",
    "punch_harmonic",
    "punch_harmonic_start",
    "punch_staircase",
    "rectangle_displacement",
    "rectangle_stress",
    "resolution_error",
    "series_complex_compliance",
    "slow_friction_coefficient",
    "strip_on_layer",
    "strip_stresses",
    "tabor_number",
    "ting_cycles",
    "ting_force_triangle",
    "ting_hump",
    "ting_triangle",
    "westergaard",
]
