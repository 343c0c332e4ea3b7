"""Which words may stand in a case file, and what each must be."""
