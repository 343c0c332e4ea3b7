"""pymunk as shipped, tuned, and with a user's own options."""
