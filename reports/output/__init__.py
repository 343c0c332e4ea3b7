"""Writes the tables, trajectories and poses of a run, and finds what changed between two runs."""
