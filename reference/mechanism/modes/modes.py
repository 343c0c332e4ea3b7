"""The modes of a scene: which rows and friction laws hold in each, and the forces that follow."""

import math
from collections.abc import Iterator, Mapping
from functools import cached_property

import numpy as np

from ....cases.scene import Scene
from ...coverage import Numbered
from ...system import MOVING, TOGETHER, Array
from ..constraints.constraint import Constraint, row
from ..constraints.leeway import Leeway
from ..forces.action import NoDirection
from .element import Element, Smoothed, State, elements
from .loose import Loose, independent
from .mode import Multibody
from .shared_friction import shares
from .smooth import SmoothMultibody
from .stopping import stopping
from .unilateral import unilateral

ROUNDING = 1e-10  # of the accelerations that the forces give alone


class Modes(Numbered, Mapping[str, Multibody]):
    """The modes by name, built when they are first met."""

    def __init__(self, scene: Scene, start: tuple[Array, Array], located: float = TOGETHER) -> None:
        self.scene, self.start, self._located = scene, start, located
        self.base = Multibody(scene, start)  # what holds in all of them
        where = self.base.where
        self._begins = float(np.max(np.abs(start[1]), initial=0.0))
        self.corners = scene.corners()
        self.elements: tuple[Element, ...] = (
            *elements(scene, where),
            *stopping(scene, where, self._begins),
            *unilateral(scene, where),
        )
        self.base.widen([part for e in self.elements for part in e.parts])
        self.M = np.array(self.base.where.masses)
        self.states: dict[str, tuple[State, ...]] = {}  # what each element does in a mode
        self._ranks: dict[str, int] = {}  # of the rows of a mode that depend on each other
        self._smooth = [e for e in self.elements if isinstance(e, Smoothed)]
        self._built: dict[str, Multibody] = {}
        self._whole: dict[tuple[State, ...], Multibody] = {}
        self._known: tuple[str, float, bytes, bytes] | None = None
        self._forces: dict[str, float] = {}

    def name(self, states: tuple[State, ...], rank: int | None = None) -> str:
        """`touch slides +, rail sticks`; rank: of its rows, where they depend on each other."""
        pairs = zip(self.elements, states, strict=True)
        name = ", ".join(f"{e.name} {state}" for e, state in pairs) or MOVING
        if rank is not None:
            name = f"{name}; {rank} rows hold all"
            self._ranks[name] = rank
        self.states[name] = states
        return name

    def named(self, states: tuple[State, ...], t: float, q: Array, v: Array) -> str:
        """The mode of these states here: whether its rows depend on each other, their rank says."""
        mode = self[self.name(states)]
        rank = independent(mode, t, q, v)
        loose = rank < len(mode.f_a(t, q)) and not self._smooth
        return self.name(states, self._unshared(states, t, q, v)[1] if loose else None)

    def loose(self, mode: str) -> bool:
        """Whether the rows of a mode depend on each other."""
        return mode in self._ranks

    def contradicts(self, name: str, t: float, q: Array, v: Array) -> bool:
        """Whether rows that depend on each other ask for different accelerations.

        At a dead centre a rocker turns back: the others turn it, so that it cannot stick there. Of
        what rests they ask the same.
        """
        mode = self[name]
        return isinstance(mode, Loose) and mode.contradicts(t, q, v)

    def leeway(self, mode: str, t: float, q: Array, v: Array) -> Leeway | None:
        """The forces that the laws allow in a mode here; None where there is one of each."""
        rows, rank = self._unshared(self.states[mode], t, q, v)
        if rank == rows:
            return None
        loose = self[self.name(self.states[mode], rank)]
        assert isinstance(loose, Loose)
        return loose.leeway(t, q, v)

    def _unshared(self, states: tuple[State, ...], t: float, q: Array, v: Array) -> tuple[int, int]:
        """How many rows a mode has, with a row for each point that sticks, and their rank."""
        if states not in self._whole:
            held = [part for e, s in self._pairs(states) for part in e.constraints(s)]
            self._whole[states] = Multibody(self.scene, self.start, held=held, base=self.base)
        whole = self._whole[states]
        return len(whole.f_a(t, q)), independent(whole, t, q, v)

    def __getitem__(self, name: str) -> Multibody:
        if name not in self._built:
            self._built[name] = self._build(self.states[name], self._ranks.get(name))
        return self._built[name]

    def _pairs(self, states: tuple[State, ...]) -> list[tuple[Element, State]]:
        return list(zip(self.elements, states, strict=True))

    def margins(self, states: tuple[State, ...], forces: Mapping[str, float]) -> list[float]:
        """(2.87), (2.89) What forces leave [N, N m] until a contact opens or what sticks slips."""
        margins: list[float] = []
        for e, state in self._pairs(states):
            if e.normal is not None and state != "open":
                margins.append(forces[e.push])
            if state == "sticks":
                margins += [margin for margin in e.margins(forces) if math.isfinite(margin)]
        return margins

    def _build(self, states: tuple[State, ...], rank: int | None) -> Multibody:
        pairs = self._pairs(states)
        shared = [] if rank is not None else list(shares(self.elements, states))
        again = {name for share in shared for name in share.contacts[1:]}
        held = [
            part
            for e, s in pairs
            for part in e.constraints(s)
            if part is e.normal or e.name not in again
        ]
        braking = [brake for e, s in pairs for brake in e.braking(s)]
        coulomb = [law for e, s in pairs for law in e.coulomb(s)]
        slack = [e.name for e, s in pairs if s == "slack"]
        slack += [name for e, s in pairs for name in e.idle(s)]
        if rank is not None:
            beside = self[self.name(states)] if self._smooth else None
            if isinstance(beside, SmoothMultibody):
                braking += beside.rubbing
            return Loose(
                self.scene, self.start, rank, lambda forces: self.margins(states, forces),
                held=held, braking=braking, coulomb=coulomb, slack=slack, base=self.base,
            )  # fmt: skip
        if self._smooth:
            return SmoothMultibody(
                self.scene, self.start, self._smooth,
                held=held, braking=braking, coulomb=coulomb, shared=shared, slack=slack,
                base=self.base,
            )  # fmt: skip
        return Multibody(
            self.scene, self.start,
            held=held, braking=braking, coulomb=coulomb, shared=shared, slack=slack,
                base=self.base,
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
        """An acceleration [m/s²] that may be nothing but rounding here.

        Where all forces have ended what is left of them is rounding, and no size of anything.
        """
        return ROUNDING * self.usual(t, q, v)

    def usual(self, t: float, q: Array, v: Array) -> float:
        """The size of accelerations [m/s²]: of what one force gives alone, here or at the start."""
        return max(self.base.terms(t, q, v)[0], self._usual)

    @cached_property
    def _usual(self) -> float:
        """The largest acceleration [m/s²] of a force at the start, as at any corner of its law.

        And of the motion there: a bar that turns without any force is held on its circle.
        """
        before = [math.nextafter(corner, -math.inf) for corner in self.corners]
        times = [0.0, *self.corners, *before]
        return max(self._turning(), *(self.base.terms(t, *self.start)[0] for t in times))

    def _turning(self) -> float:
        """The largest acceleration at the start with all springs acting; 0 where one cannot."""
        try:
            return float(np.max(np.abs(self.base.accelerations(0.0, *self.start)), initial=0.0))
        except NoDirection:
            return 0.0

    def still(self, t: float, q: Array, v: Array, *, part: float) -> float:
        """A speed that is none [m/s]: that part of the motion's, and what forces give so early.

        Where all comes to rest v is rounding, and no size of anything.
        """
        speed = max(float(np.max(np.abs(v), initial=0.0)), self._begins)
        return part * speed + self._located * self.base.terms(t, q, v)[0]


def rate(part: Constraint, t: float, q: Array, v: Array) -> float:
    """f_a q̇ᵃ − g (2.15) of one row [m/s]."""
    f, g, _ = row(part, t, q, v)
    return float(f @ v) - g
