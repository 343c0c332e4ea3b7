"""How far the events of a system are from those that are known."""

import math

import numpy as np

from textmech.reference.motion.follow import follow
from textmech.reference.system import System

LOCATED = 1e-12  # s


def event_errors(known: System, system: System, until: float) -> list[float]:
    """Distances [s] of the events of one system from the closed ones of another; inf if others."""
    closed = known.closed_events(until)
    assert closed is not None
    found = follow(system, np.linspace(0.0, until, 31)).events
    if [event.name for event in found] != [name for name, _ in closed]:
        return [math.inf]
    return [abs(event.time - t) for event, (_, t) in zip(found, closed, strict=True)]
