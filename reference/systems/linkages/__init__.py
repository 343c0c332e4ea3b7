"""Closed chains of bars."""
