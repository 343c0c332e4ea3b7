"""Readings from pymunk: physics before a step, and every step of a run."""
