"""A trial: one engine, in one realisation, against the reference motion of one case."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cases.case import Case
from cases.observe import observe
from cases.quantity import Quantity, table
from cases.trajectory import VX, VY, Array, Trajectory, X, Y
from engines.engine import Engine, Realised, State
from reports.ladder import judged_step


@dataclass(frozen=True)
class Trial:
    """What is compared; the names are those of the engine and of the case."""

    case: Case
    reference: Trajectory
    engine: Engine
    realised: Realised

    def wanted(self, quantity: str) -> Array:
        """The reference's samples (N,)."""
        return observe(self.case.scene, self.reference, quantity)

    def quantity(self, name: str) -> Quantity:
        """The quantity's unit and kind; the audit has none."""
        return table(self.case.scene).get(name) or Quantity(name, "", "", "", "residual")

    def size(self, name: str) -> float:
        """How large the quantity is; a residual, meant to be zero, has the size of its motion."""
        size = float(np.max(np.abs(self.wanted(name))))
        if self.quantity(name).kind == "residual":
            columns = [X, Y] if self.quantity(name).unit == "m" else [VX, VY]
            states = np.concatenate(list(self.reference.states.values()))
            size = max(size, float(np.max(np.abs(states[:, columns]))))
        return size

    @cached_property
    def step(self) -> float:
        """The step at which the trial is judged."""
        return judged_step(self.case, self.engine)

    @cached_property
    def protocol(self) -> str:
        """What was done to start and readout, and a shortened step where there is one."""
        base = self.engine.protocol(self.case.scene, self.start, self.step, self.realised)
        own = self.engine.own_step
        short = own is not None and abs(self.step - own) > 1e-9 * own
        note = f"own step {own:g} s shortened to divide the interval" if short else ""
        return "; ".join(part for part in (base, note) if part)

    @property
    def start(self) -> State:
        """Row 0 of the reference: where every engine starts."""
        return {name: tuple(rows[0].tolist()) for name, rows in self.reference.states.items()}  # type: ignore[misc]
