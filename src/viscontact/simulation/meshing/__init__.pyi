from .contact_place import locate_contact
from .mesh_choice import Mesh, choose_mesh
from .path_extent import grid_over_path

__all__ = [
    "Mesh",
    "choose_mesh",
    "grid_over_path",
    "locate_contact",
]
