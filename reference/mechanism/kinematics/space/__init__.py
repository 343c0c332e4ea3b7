"""Coordinates in space: attitudes, and chains of joints."""
