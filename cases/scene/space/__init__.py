"""The nouns of a scene in space."""
