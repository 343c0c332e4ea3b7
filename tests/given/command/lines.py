"""Rows of reports, typed: one of tolerance.csv, one of convergence.csv."""

from dataclasses import replace
from typing import Any

from textmech.reports.tables.row import AGREES, BEYOND, Comparison, Rungs

ROW = Comparison(
    case="swing",
    theme="pins",
    source="",
    engine="mujoco",
    version="4.0.0",
    setting="shipped",
    realised="native",
    protocol="",
    quantity="rod.angle",
    unit="rad",
    step=2e-3,
    error=1e-3,
    when=None,
    rms=None,
    final=None,
    allowed=1e-2,
    ratio=0.1,
    verdict=AGREES,
    because="",
)

LADDER = Rungs(
    case="swing",
    engine="mujoco",
    version="4.0.0",
    setting="shipped",
    realised="native",
    ladder="held",
    quantity="rod.angle",
    unit="rad",
    order=None,
    order_low=None,
    order_high=None,
    limit=None,
    uncertainty=None,
    usable_step=None,
    verdict="",
)


def row(setting: str = "shipped", ratio: float | None = 0.1, **other: Any) -> Comparison:
    """One that agrees, or is beyond its tolerance, at 2 ms."""
    verdict = AGREES if ratio is not None and ratio <= 1 else BEYOND
    return replace(ROW, **({"setting": setting, "ratio": ratio, "verdict": verdict} | other))


def said(row: Comparison) -> str:
    """Its verdict and its reason, as a person reads them."""
    return f"{row.verdict}: {row.because}"


def refused(setting: str = "shipped", **other: Any) -> Comparison:
    """One that the engine does not answer."""
    given: dict[str, Any] = {
        "verdict": "refused",
        "because": "engine: no",
        "error": None,
        "allowed": None,
        "step": None,
    }
    return row(setting, None, **(given | other))


def ladder(
    usable: float | None, setting: str = "shipped", realised: str = "native", **other: Any
) -> Rungs:
    """A ladder of the row's quantity."""
    told = {"setting": setting, "realised": realised, "usable_step": usable}
    return replace(LADDER, **(told | other))
