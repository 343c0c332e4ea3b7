"""Particles and bodies alone, in the plane and in space: springs, drag, fields, tops."""
