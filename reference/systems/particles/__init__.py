"""One particle: springs, drag, fields."""
