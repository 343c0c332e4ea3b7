"""What a scene in space is made of: its nouns answer as those of the plane do."""
