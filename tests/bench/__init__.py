"""Measures what the adapters and the reference cost over what a user would write without them."""
