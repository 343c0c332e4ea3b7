"""The versions that made the committed reports, from reports/environment.txt."""

from pathlib import Path

ENVIRONMENT = Path(__file__).parents[1] / "environment.txt"


def version(package: str) -> str | None:
    """The pinned version of a package, or None."""
    if not ENVIRONMENT.exists():
        return None
    for line in ENVIRONMENT.read_text().splitlines():
        name, _, pinned = line.partition("==")
        if name.strip().lower() == package:
            return pinned.strip()
    return None
