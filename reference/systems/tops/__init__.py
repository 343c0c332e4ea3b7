"""Bodies that turn in space."""
