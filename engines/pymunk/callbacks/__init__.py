"""Functions to call before each step for what pymunk has not: forces, friction, landings."""
