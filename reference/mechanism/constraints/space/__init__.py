"""Rows of the constraint Jacobian in space."""
