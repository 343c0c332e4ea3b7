"""Dry friction of a slide (2.89), and the book's smooth law in its place (2.95)."""

from dataclasses import dataclass
from typing import Annotated

from .language.grammar.field import In

Newtons = Annotated[float, In("N", least=0)]


@dataclass(frozen=True)
class Bounds:
    """A friction force [N] against motion forward (along the slide) and backward."""

    forward: Newtons
    backward: Newtons


@dataclass(frozen=True)
class Smooth:
    """The book's smooth law (2.95): the band Δ [m/s] and the sharpness A [s/m]."""

    band: Annotated[float, In("m/s", above=0)]
    sharpness: Annotated[float, In("s/m", above=0)]


@dataclass(frozen=True)
class DryFriction:
    """(2.89) on a slide, along its line; `smooth` replaces the exact law by (2.95)."""

    static: Bounds
    kinetic: Bounds
    smooth: Smooth | None = None

    def numbers(self) -> dict[str, float]:
        """The forces [N] in motion: what the audit reads back from an engine."""
        kinetic = self.kinetic
        return {"friction_forward": kinetic.forward, "friction_backward": kinetic.backward}
