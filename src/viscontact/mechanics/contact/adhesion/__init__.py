"""Contact of bodies that attract each other."""
