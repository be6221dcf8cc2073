from .adhesion_results import adhesion_scalars
from .adhesive_contact import AdhesiveContact, AdhesiveStep
from .contact_events import ContactEvents
from .coupled_contact import CoupledContact
from .event_search import EventSearch
from .frictional_contact import FrictionalContact
from .march import March
from .moving_body import cells_seen
from .moving_contact import MovingContact, StandingContact
from .provenance import contact_event_attributes, describe_problem, run_attributes
from .segments_so_far import EventError, ProgramCourse
from .slip_step import symmetry_of
from .zone_passage import ZonePassage

__all__ = [
    "AdhesiveContact",
    "AdhesiveStep",
    "ContactEvents",
    "CoupledContact",
    "EventError",
    "EventSearch",
    "FrictionalContact",
    "March",
    "MovingContact",
    "ProgramCourse",
    "StandingContact",
    "ZonePassage",
    "adhesion_scalars",
    "cells_seen",
    "contact_event_attributes",
    "describe_problem",
    "run_attributes",
    "symmetry_of",
]
