"""The same for scenes in space."""
