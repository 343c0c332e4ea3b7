"""What MuJoCo has no element for: laws that it calls back, and loops around its step."""
