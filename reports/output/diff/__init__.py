"""Compares two report folders row by row, and writes what changed in four forms."""
