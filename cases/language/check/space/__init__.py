"""Checks that a scene in space fits together, where it is not as in the plane."""
