"""Compares two report folders row by row, and writes what changed as text, JSON and Markdown."""
