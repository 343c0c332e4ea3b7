"""Generalized forces in space."""
