"""What must fit together between the sound parts of a file."""
