"""Dry friction of a slide or a pin (2.89), (2.90), and the book's smooth law in its place (2.95).

Of a slide it is a force [N] along its line, of a pin a moment [N m] about it, and what is a speed
[m/s] here is a rate [rad/s] there.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Bounds:
    """Friction against motion forward and backward: along the slide, or counter-clockwise."""

    forward: float  # while the second part moves along the line, or counter-clockwise
    backward: float  # while it moves the other way


@dataclass(frozen=True)
class Smooth:
    """The book's smooth law (2.95): the band Δ [m/s] and the sharpness A [s/m]."""

    band: float  # Δ, m/s
    sharpness: float  # A, s/m


@dataclass(frozen=True)
class Stribeck:
    """(2.90) From static to kinetic friction over this speed: fig 2.25, after Tustin (1947)."""

    speed: float  # v_s, m/s


@dataclass(frozen=True)
class DryFriction:
    """(2.89); with `stribeck` (2.90); `smooth` replaces the exact law by (2.95)."""

    static: Bounds  # what holds at rest, N or N m
    kinetic: Bounds  # what brakes in motion
    smooth: Smooth | None = None  # the smooth law in its place
    stribeck: Stribeck | None = None  # how it falls from one to the other

    def numbers(self) -> dict[str, float]:
        """The forces or moments in motion: what the audit reads back from an engine."""
        kinetic = self.kinetic
        return {"friction_forward": kinetic.forward, "friction_backward": kinetic.backward}
