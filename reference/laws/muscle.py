"""Laws of a muscle's contractile element (figure 2.17): how fast it shortens under a force."""

from typing import Any


def hill(F_0: float, a: float, b: float, F: Any) -> Any:
    """v = b (F₀ − F)/(F + a) [m/s] of (F + a)(v + b) = (F₀ + a) b, F > −a: v < 0 above F₀."""
    return b * (F_0 - F) / (F + a)


def linear(F_0: float, b: float, F: Any) -> Any:
    """v = (F₀ − F)/b [m/s] of F = F₀ − b v."""
    return (F_0 - F) / b
