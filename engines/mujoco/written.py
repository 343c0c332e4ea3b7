"""Numbers as MJCF writes them."""


def written(*values: object) -> str:
    """Numbers so that they come back bit for bit; lists separated by blanks."""
    flat = [x for value in values for x in (value if isinstance(value, list | tuple) else [value])]
    return " ".join(repr(float(x)) if isinstance(x, float) else str(x) for x in flat)
