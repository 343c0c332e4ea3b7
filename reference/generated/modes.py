"""The modes of a scene: which rows and friction laws hold in each, and the forces that follow."""

from collections.abc import Iterator, Mapping

import numpy as np

from ...cases.scene import Scene
from ..system import MOVING, Array
from .constraint import Constraint
from .contact import row
from .element import Element, Smoothed, State, elements
from .mode import Multibody
from .one_side import one_sided
from .pair import paired
from .rope import roped
from .sharing import shares
from .smooth import SmoothMultibody
from .stop import stopped

ROUNDING = 1e-10  # of the accelerations that the forces give alone
LOCATED = 1e-12  # s: how well events are located


class Modes(Mapping[str, Multibody]):
    """The modes by name, built when they are first met."""

    def __init__(self, scene: Scene, start: tuple[Array, Array]) -> None:
        self.scene, self.start = scene, start
        self.base = Multibody(scene, start)  # what holds in all of them
        where = self.base.where
        self.elements: tuple[Element, ...] = (
            *elements(scene, where),
            *paired(scene, where),
            *roped(scene, where),
            *stopped(scene, where),
            *one_sided(scene, where),
        )
        self.M = np.array(self.base.where.masses)
        self._begins = float(np.max(np.abs(start[1]), initial=0.0))
        self.states: dict[str, tuple[State, ...]] = {}  # what each element does in a mode
        self._built: dict[str, Multibody] = {}
        self._known: tuple[str, float, bytes, bytes] | None = None
        self._forces: dict[str, float] = {}

    def name(self, states: tuple[State, ...]) -> str:
        """`touch slides +, rail sticks`."""
        pairs = zip(self.elements, states, strict=True)
        name = ", ".join(f"{e.name} {state}" for e, state in pairs) or MOVING
        self.states[name] = states
        return name

    def __getitem__(self, name: str) -> Multibody:
        if name not in self._built:
            self._built[name] = self._build(self.states[name])
        return self._built[name]

    def _build(self, states: tuple[State, ...]) -> Multibody:
        pairs = list(zip(self.elements, states, strict=True))
        shared = list(shares(self.elements, states))
        again = {name for share in shared for name in share.contacts[1:]}
        held = [
            part for e, s in pairs for part in e.held(s) if part is e.normal or e.name not in again
        ]
        braking = [brake for e, s in pairs for brake in e.braking(s)]
        coulomb = [law for e, s in pairs for law in e.coulomb(s)]
        slack = [e.name for e, s in pairs if s == "slack"]
        smooth = [e for e in self.elements if isinstance(e, Smoothed)]
        if smooth:
            return SmoothMultibody(
                self.scene, self.start, smooth,
                held=held, braking=braking, coulomb=coulomb, shared=shared, slack=slack,
            )  # fmt: skip
        return Multibody(
            self.scene, self.start,
            held=held, braking=braking, coulomb=coulomb, shared=shared, slack=slack,
        )  # fmt: skip

    def __iter__(self) -> Iterator[str]:
        return iter(self._built)

    def __len__(self) -> int:
        return len(self._built)

    def forces(self, mode: str, t: float, q: Array, v: Array) -> dict[str, float]:
        """The reactions of the mode; several guards ask at the same state."""
        key = (mode, t, q.tobytes(), v.tobytes())
        if key != self._known:
            self._forces, self._known = self[mode].reactions(t, q, v), key
        return self._forces

    def change(self, part: Constraint, mode: str, t: float, q: Array, v: Array) -> float:
        """f_a q̈ᵃ − γ: how the rate of a row changes in a mode [m/s²]."""
        f, _, gamma = row(part, t, q, v)
        return float(f @ self[mode].accelerations(t, q, v)) - gamma

    def small(self, t: float, q: Array, v: Array) -> float:
        """What rounding makes of an acceleration here [m/s²]."""
        return ROUNDING * self.base.terms(t, q, v)[0]

    def still(self, t: float, q: Array, v: Array, *, part: float) -> float:
        """A speed that is none [m/s]: that part of the motion's, and what forces give so early.

        Where all comes to rest v is rounding, and no size of anything.
        """
        speed = max(float(np.max(np.abs(v), initial=0.0)), self._begins)
        return part * speed + LOCATED * self.base.terms(t, q, v)[0]


def rate(part: Constraint, t: float, q: Array, v: Array) -> float:
    """f_a q̇ᵃ − g (2.15) of one row [m/s]."""
    f, g, _ = row(part, t, q, v)
    return float(f @ v) - g
