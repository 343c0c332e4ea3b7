"""The reports' tables: their rows, what they are made of, and which of them belong together."""
