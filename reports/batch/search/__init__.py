"""What cures a row: a search over an engine's options, which knows nothing of any advice."""
