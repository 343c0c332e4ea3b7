"""Readings of scenes in space."""
