"""Coordinates of bodies, and how points move with them."""
