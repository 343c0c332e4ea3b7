"""Rows: errors, convergence, verdicts and their causes."""
