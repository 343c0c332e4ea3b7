"""Legs that walk, run and jump."""
