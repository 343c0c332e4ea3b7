"""Mechanisms of which states are claimed, and no motion."""
