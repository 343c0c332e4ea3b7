"""The scene as a Space, and its steps."""
