"""Choice of the mesh: contact estimates, trial meshes, refinement."""
