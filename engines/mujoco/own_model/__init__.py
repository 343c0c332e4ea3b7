"""A user's own model: compiled, as plain numbers, and its own continuous equations."""
