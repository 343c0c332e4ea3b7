"""What pymunk tells: physics before a step, and every step of a run."""
