"""What pymunk has to be told before each step: forces, friction, landings."""
