"""The force elements, one a file, each with what it exerts and what can be observed of it."""
