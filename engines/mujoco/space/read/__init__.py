"""What MuJoCo tells of a run in space: states, reactions, and the model's own numbers."""
