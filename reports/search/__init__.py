"""Searches an engine's options: for what cures a row, and for the settings that a user needs."""
