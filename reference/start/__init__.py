"""Where a scene starts: what the case gives, and what the constraints make of it."""
