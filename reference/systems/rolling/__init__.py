"""Wheels, disks and blades: constraints on velocities."""
