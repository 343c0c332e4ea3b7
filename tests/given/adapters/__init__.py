"""Engines as tests need them: scenes for them, their plans, and adapters that make mistakes."""
