"""Modes of a scene: what holds in one, what ends it, which follows, and impacts between them."""
