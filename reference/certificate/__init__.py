"""What the reference says of its own error: every answer that shares no algebra, compared."""
