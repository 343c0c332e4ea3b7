"""textmech: physics engines measured against textbook mechanics; for Python, `textmech.reports`."""

from typing import Any


def __getattr__(name: str) -> Any:
    """`__version__`: what is installed, asked for only by who wants it."""
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import version

    return version("textmech")
