"""A user's own MuJoCo model: compiled, as plain numbers, and its own continuous equations.

It stands beside the adapter, whose every file the stored rows and causes hang on.
"""
