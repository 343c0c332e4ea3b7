"""Settings of scenes in space."""
