"""The mechanism in space, which has one mode."""
