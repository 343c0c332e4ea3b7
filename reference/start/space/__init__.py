"""The start of a scene in space: what the case gives, and what the constraints make of it."""
