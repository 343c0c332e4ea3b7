"""Numbers as MJCF writes them."""

from collections.abc import Mapping


def written(*values: object) -> str:
    """Numbers so that they come back bit for bit; lists separated by blanks."""
    flat = [x for value in values for x in (value if isinstance(value, list | tuple) else [value])]
    return " ".join(repr(float(x)) if isinstance(x, float) else str(x) for x in flat)


def attributes(numbers: Mapping[str, object], group: str) -> dict[str, str]:
    """Those of one element: of `connect.solref` the `solref`, where the group is `connect`."""
    return {
        name.partition(".")[2]: value if isinstance(value, str) else written(value)
        for name, value in numbers.items()
        if name.startswith(f"{group}.")
    }
