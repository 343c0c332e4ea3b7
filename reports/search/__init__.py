"""Searches over an engine's options: what cures a row, and what a user needs."""
