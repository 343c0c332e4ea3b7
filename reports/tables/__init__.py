"""The tables: their rows and files, the committed ones, and how two runs of them differ."""
