"""Design of a free roller profile: the drop curve of the least peak pressure."""
