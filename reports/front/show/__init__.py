"""Shows results to a person: on the terminal, as a summary, as scripts."""
