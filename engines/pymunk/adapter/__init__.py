"""The protocol's words for pymunk: plans, refusals, scripts, claims."""
