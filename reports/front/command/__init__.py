"""The command `textmech run`: where it writes, and what it says if it is ended."""
