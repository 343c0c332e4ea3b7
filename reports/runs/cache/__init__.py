"""Results that need not be computed again: what they depend on, their form, and where they lie."""
