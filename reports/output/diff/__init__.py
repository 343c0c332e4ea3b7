"""What changed between two report folders: read, compared row by row, and told in four forms."""
