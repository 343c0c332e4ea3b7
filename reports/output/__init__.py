"""What a run leaves: its tables, trajectories and poses, and what changed between two of them."""
