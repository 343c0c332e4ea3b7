"""What the adapters and the reference cost, each over what a user would write without them."""
