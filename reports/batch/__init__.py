"""Many comparisons: which of them, what is stored, the searches for causes and for advice."""
