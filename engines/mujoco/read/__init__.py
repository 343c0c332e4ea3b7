"""What MuJoCo tells: physics before a step, and states and forces after each."""
