"""Muscles against a wall and against a load."""
