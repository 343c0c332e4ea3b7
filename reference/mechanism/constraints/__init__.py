"""Rows of the constraint Jacobian, and the solution of the equations of motion with them."""
