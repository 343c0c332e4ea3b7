"""Callbacks of scenes in space."""
