"""Searches an engine's options for what cures a row; the search knows nothing of any advice."""
