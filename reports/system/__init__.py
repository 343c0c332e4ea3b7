"""Processes, their ends and limits, locks, and files that are replaced together."""
