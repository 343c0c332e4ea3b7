"""The doors: the command, the page, pytest's plug-in and Python, and what they print and write."""
