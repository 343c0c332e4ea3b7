"""What must fit together in a scene in space, where it is not as in the plane."""
