"""Releases of an engine compared: each in a folder of its own, on the same references."""
