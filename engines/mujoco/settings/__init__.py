"""MuJoCo as shipped, as its authors recommend it, tuned, and with a user's own options."""
