"""Processes, their ends and signals, and folders that go with them."""
