"""Bodies that touch: sliding, tipping, bouncing, striking each other."""
