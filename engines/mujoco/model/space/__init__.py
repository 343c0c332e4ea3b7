"""What is written otherwise of scenes in space."""
