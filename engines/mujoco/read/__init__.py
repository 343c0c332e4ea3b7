"""Readings from MuJoCo: physics before a step, and states and forces after each."""
