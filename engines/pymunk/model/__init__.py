"""What pymunk has for each body, joint and contact, as objects and as lines of a script."""
