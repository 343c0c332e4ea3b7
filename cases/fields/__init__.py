"""Types of the values in a case file: numbers with units, texts, names, laws in time."""
