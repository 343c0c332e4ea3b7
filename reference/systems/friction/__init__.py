"""Dry friction with stick and slip, and viscous friction beside it."""
