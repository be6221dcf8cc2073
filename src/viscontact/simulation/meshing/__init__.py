"""Choice of the mesh: estimates of the contact, mesh trials, refinement."""
