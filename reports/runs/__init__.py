"""Many comparisons: what is asked for, its tasks, the processes, and what is kept."""
