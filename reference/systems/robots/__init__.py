"""Serial arms in space, and what they carry."""
