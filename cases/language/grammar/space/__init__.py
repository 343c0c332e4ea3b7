"""The words of a scene in space, beside those that it shares with the plane."""
