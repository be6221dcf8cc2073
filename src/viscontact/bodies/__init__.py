"""Bodies: shapes, creep laws, materials, measured surfaces, loads and grids."""
