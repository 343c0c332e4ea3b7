"""U, V, D and Q₄ of some forces, each from its own formulas: what the formalisms are made of."""

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from ...coverage import Numbered
from ..kinematics.kinematics import Kinematics, Layout
from ..kinematics.tape import Compiled
from .action import Action

MOMENTS = ("mx", "my", "mz")


class Ingredients(Numbered):
    """Energies [J], powers [W] and generalized forces, summed over the forces."""

    def __init__(self, where: Layout, actions: Sequence[Action]) -> None:
        self._where, self._actions = where, actions

    def U(self, t: Any, q: Any) -> Any:
        """(2.45) U [J] of the forces of class 1."""
        return self._U(t, q)[0]

    def V(self, t: Any, q: Any, v: Any) -> Any:
        """(2.48) V [J] of those of class 3, of the rates v (m,) or (m, K)."""
        return self._V(t, q, v)[0]

    def D(self, t: Any, q: Any, v: Any) -> Any:
        """(2.46) D [W] of those of class 2."""
        return self._D(t, q, v)[0]

    def Q4(self, t: Any, q: Any, v: Any) -> Any:
        """(2.50) Q₄ (n,) of those of class 4."""
        return np.array(self._Q4(t, q, v))

    def rate(self, t: Any, q: Any, v: Any) -> list[Any]:
        """The rates of the inner states, in the order of those that have one."""
        return self._rate(t, q, v)

    def moments(self, t: Any, q: Any, v: Any) -> dict[str, Any]:
        """By quantity the moments about joints on their second parts, in ground axes [N m]."""
        moments: dict[str, Any] = {}
        function, names = self._moments
        for name, value in zip(names, function(t, q, v), strict=True):
            moments[name] = moments.get(name, 0.0) + value
        return moments

    def lengths(self, t: Any, q: Any) -> list[tuple[str, float]]:
        """λ [m] of those that have no direction where their ends meet, by name."""
        lined = [action.name for action in self._actions if action.line]
        return list(zip(lined, self._lengths(t, q), strict=True))

    def _summed(self, ask: Callable[[Action, Kinematics], Any]) -> Compiled:
        k = Kinematics(self._where)
        return k.tape.compiled([sum((ask(action, k) for action in self._actions), 0.0)])

    @cached_property
    def _U(self) -> Compiled:
        return self._summed(lambda action, k: action.U(k))

    @cached_property
    def _V(self) -> Compiled:
        return self._summed(lambda action, k: action.V(k))

    @cached_property
    def _D(self) -> Compiled:
        return self._summed(lambda action, k: action.D(k))

    @cached_property
    def _Q4(self) -> Compiled:
        k = Kinematics(self._where)
        forces: list[Any] = [0.0] * len(self._where.masses)
        for action in self._actions:
            for part, F, M in action.Q4(k):
                for column, x in part.columns(F, M):
                    forces[column] = forces[column] + x
        return k.tape.compiled(forces)

    @cached_property
    def _rate(self) -> Compiled:
        k = Kinematics(self._where)
        return k.tape.compiled([action.rate(k) for action in self._actions if action.inner])

    @cached_property
    def _moments(self) -> tuple[Compiled, list[str]]:
        k = Kinematics(self._where)
        each = [(action.force.about, action.moment(k)) for action in self._actions]
        names = [f"{joint}.{axis}" for joint, M in each if M is not None for axis in MOMENTS]
        return k.tape.compiled([x for _, M in each if M is not None for x in M]), names

    @cached_property
    def _lengths(self) -> Compiled:
        k = Kinematics(self._where)
        return k.tape.compiled([action.length(k) for action in self._actions if action.line])
