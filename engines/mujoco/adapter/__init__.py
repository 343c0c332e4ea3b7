"""The protocol's words for MuJoCo: plans, refusals, runs, claims."""
