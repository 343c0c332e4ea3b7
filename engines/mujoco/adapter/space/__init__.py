"""MuJoCo's adapter for scenes in space: plans, compilation, runs and refusals."""
