"""When events happen, read from records."""
