"""Checks that the sound parts of a file fit together."""
