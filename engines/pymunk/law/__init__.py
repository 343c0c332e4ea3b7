"""What pymunk is told before each step: force laws and signals."""
