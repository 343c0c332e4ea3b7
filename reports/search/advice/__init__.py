"""Finds what a user needs: for each case and engine the settings that keep what is asked."""
