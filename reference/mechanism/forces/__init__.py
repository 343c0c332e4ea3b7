"""Generalized forces of each kind of force element."""
