"""Bodies, joints and contacts as pymunk has them: objects, and lines of a script."""
