"""Rows in words, for whoever reads a failed test."""

from dataclasses import asdict

from ..data.row import Certificate, Comparison


def row_text(row: Comparison) -> str:
    """Returns all that is known of a row, one column a line."""
    kept = {k: v for k, v in asdict(row).items() if v not in (None, "")}
    return "\n".join(
        f"  {name:9} {value:.3g}" if isinstance(value, float) else f"  {name:9} {value}"
        for name, value in kept.items()
    )


def certificate_text(row: Certificate) -> str:
    """Says which check of a case's reference does not hold, and by how much."""
    return (
        f"{row.case}: the reference ({row.system}) is not certified: {row.check}: "
        f"{row.difference:.2e} is above {row.bound:.2e}"
    )
