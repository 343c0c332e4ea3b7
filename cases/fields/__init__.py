"""What stands behind a key of a case file: numbers with units, texts, names, laws in time."""
