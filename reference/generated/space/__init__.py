"""The generated mechanism in space: maximal coordinates, unit quaternions, ω in body axes.

It reads as the planar one does: coordinates, rows of constraints, forces, a mode, a mechanism.
"""
