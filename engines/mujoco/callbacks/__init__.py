"""Laws that MuJoCo has no element for and calls back, and loops around its step."""
