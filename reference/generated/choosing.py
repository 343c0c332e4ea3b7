"""Any planar scene whose contacts open, slide and stick, or whose slides have dry friction.

Each mode is a `Mechanism` with the rows that hold then; modes are built when they are first met,
and a scene in which nothing switches has one.
"""

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ...cases.scene import Scene
from ..system import MOVING, Array, Guard, System
from .constraint import Constraint
from .contact import row
from .element import REST, Element, Smoothed, State, elements, sign, sliding
from .impact import Meeting, NoImpact, Row, impact
from .mechanism import Mechanism, SingularPose
from .smooth import SmoothMechanism

CLOSED = 1e-9  # of the scene's size: a start this close to the floor stands on it
STILL = 1e-12  # of the largest rate: what a projection or an assembly leaves of a zero
ROUNDING = 1e-10  # of the accelerations that the forces give alone
PIECES = 16  # of the shortest period of a force: a guard at rest sees nothing else of time

After = tuple[str, Array, Array]
Choice = tuple[State, ...]


class Undetermined(Exception):
    """A motion that the friction law does not determine, from `time` on."""

    def __init__(self, part: str, what: str, time: float) -> None:
        super().__init__(what)
        self.part, self.time = part, time


class BadStart(Exception):
    """A contact that starts where no contact can."""


class SwitchingMechanism(System):
    """The scene as modes and guards; `size` [m] is what its gaps are small against."""

    def __init__(self, scene: Scene, start: tuple[Array, Array], size: float) -> None:
        self.scene, self.size = scene, size
        self.base = Mechanism(scene, start)
        self.elements: tuple[Element, ...] = tuple(elements(scene, self.base.where))
        self.built = _Modes(self, start)
        self.modes = self.built
        self._M = np.array(self.base.where.masses)
        self._known: tuple[str, float, bytes, bytes] | None = None
        self._forces: dict[str, float] = {}
        sines = [f.signal for f in scene.signals() if f.signal.law == "sine"]
        fastest = max((abs(s.angular_frequency) for s in sines), default=0.0)
        self.longest = math.tau / fastest / PIECES if fastest else None

    def start(self) -> After:
        """The assembled start, and what contacts and slides do there.

        Raises BadStart for a contact inside the floor or on its way into it.
        """
        q, v = self.base.start()
        if all(e.only for e in self.elements):  # nothing to choose, and nothing to bring to rest
            return self.built.name(tuple(e.only for e in self.elements if e.only)), q, v
        choices = [self._at_start(e, q, v) for e in self.elements]
        return self._settled(choices, 0.0, q, v)

    def _at_start(self, element: Element, q: Array, v: Array) -> Choice:
        if element.only:
            return (element.only,)
        still = STILL * (float(np.max(np.abs(v))) or 1.0)
        if element.normal is not None:
            gap = element.normal.f(0.0, q.tolist())[0]
            if gap > CLOSED * self.size:
                return ("open",)
            if gap < -CLOSED * self.size:
                raise BadStart(f"{element.name} starts {-gap * 1e3:.3g} mm in the floor")
            rate = _rate(element.normal, 0.0, q, v)
            if rate < -still:
                raise BadStart(f"{element.name} starts into the floor, with {-rate:.3g} m/s")
            if rate > still:
                return ("open",)
        slip = _rate(element.tangent, 0.0, q, v)
        return self._closed(element, slip if abs(slip) > still else 0.0)

    def _closed(self, element: Element, slip: float) -> Choice:
        """What a contact on the floor or a slide may do at this slip."""
        if element.only:
            return (element.only,)
        if element.frictionless:
            return ("slides +", *_opening(element))
        return (*((sliding(slip),) if slip else REST), *_opening(element))

    def states(self, mode: str) -> tuple[State, ...]:
        """What each element does in a mode."""
        return self.built.states[mode]

    # What ends a mode.

    def guards(self, mode: str) -> Sequence[Guard]:
        """Opening, landing, stopping and slipping of every element, in this order."""
        states = self.states(mode)
        found = [g for i, s in enumerate(states) for g in self._guards(mode, i, s)]
        order = {"opens": 0, "lands": 1, "stops": 2, "slips": 3}
        return sorted(found, key=lambda guard: order[str(guard.event).split()[-1]])

    def _guards(self, mode: str, i: int, state: State) -> Iterator[Guard]:
        e = self.elements[i]
        if e.only:
            return
        if (normal := e.normal) is not None:
            if state == "open":
                gap = lambda t, q, v: normal.f(t, q.tolist())[0]  # noqa: E731
                yield Guard(f"{e.name} lands", gap, self._lands(mode, i))
                return
            push = lambda t, q, v: self.forces(mode, t, q, v)[f"{e.name}.normal"]  # noqa: E731
            yield Guard(f"{e.name} opens", push, self._opens(mode, i))
        if e.frictionless:
            return
        if s := sign(state):
            slip = lambda t, q, v: s * _rate(e.tangent, t, q, v)  # noqa: E731
            yield Guard(f"{e.name} stops", slip, self._to(mode, i, REST))
            return
        for k, way in enumerate(("slides +", "slides -")):
            yield Guard(f"{e.name} slips", self._margin(mode, e, k), self._to(mode, i, (way,)))

    def _margin(self, mode: str, e: Element, k: int) -> Callable[[float, Array, Array], float]:
        return lambda t, q, v: e.margins(self.forces(mode, t, q, v))[k]

    def forces(self, mode: str, t: float, q: Array, v: Array) -> dict[str, float]:
        """The reactions of the mode; several guards ask at the same state."""
        key = (mode, t, q.tobytes(), v.tobytes())
        if key != self._known:
            self._forces, self._known = self.modes[mode].reactions(t, q, v), key
        return self._forces

    # What follows.

    def _to(self, mode: str, i: int, choice: Choice) -> Callable[[float, Array, Array], After]:
        """The next mode if element i has this choice; at rest it first comes to rest exactly."""

        def then(t: float, q: Array, v: Array) -> After:
            choices = self._staying(mode)
            choices[i] = (*choice, *_opening(self.elements[i])) if choice == REST else choice
            return self._settled(choices, t, q, v)

        return then

    def _opens(self, mode: str, i: int) -> Callable[[float, Array, Array], After]:
        """The contact opens, if it then rises: a force that jumps instead has no next mode."""

        def then(t: float, q: Array, v: Array) -> After:
            choices, e = self._staying(mode), self.elements[i]
            choices[i] = ("open",)
            after = self._settled(choices, t, q, v)
            assert e.normal is not None
            rises = self._change(e.normal, after[0], t, q, v)
            if rises < -self._small(t, q, v):
                raise self._painleve(e.name, "neither staying nor leaving the floor", t)
            return after

        return then

    def _lands(self, mode: str, i: int) -> Callable[[float, Array, Array], After]:
        """The impact law, and what each contact and slide may do after it."""

        def then(t: float, q: Array, v: Array) -> After:
            touching, met = self._meetings(mode, i, t, q, v)
            held = [Row(f, g) for f, g in zip(self.base.f_a(t, q), self.base.g(t, q), strict=True)]
            try:
                v, states = impact(self._M, held, met, v)
            except NoImpact as error:
                raise Undetermined(self.elements[i].name, str(error), t) from error
            choices = [self._closed(e, self._slip(e, t, q, v)) for e in self.elements]
            for k, e in enumerate(self.elements):
                if e.normal is not None and k not in touching:
                    choices[k] = ("open",)
            for k, m, state in zip(touching, met, states, strict=True):
                leaves = state == "open" or m.after > 0.0
                choices[k] = ("open",) if leaves else self._landed(m.element, state)
            return self._settled(choices, t, q, v)

        return then

    def _landed(self, element: Element, state: State) -> Choice:
        if element.frictionless or state == "sticks":
            return self._closed(element, 0.0)
        return (state, "open")

    def _meetings(
        self, mode: str, i: int, t: float, q: Array, v: Array
    ) -> tuple[list[int], list[Meeting]]:
        """The contacts that are closed or strike, and their rows."""
        touching, met = [], []
        for k, (e, state) in enumerate(zip(self.elements, self.states(mode), strict=True)):
            if e.normal is not None and (k == i or state != "open"):
                normal, tangent = (Row(*row(part, t, q, v)[:2]) for part in (e.normal, e.tangent))
                after = -e.restitution * float(normal.f @ v) if k == i else 0.0
                touching.append(k)
                met.append(Meeting(e, normal, tangent, after, k == i))
        return touching, met

    def _slip(self, e: Element, t: float, q: Array, v: Array) -> float:
        slip = _rate(e.tangent, t, q, v)
        return slip if abs(slip) > STILL * float(np.max(np.abs(v))) else 0.0

    def _staying(self, mode: str) -> list[Choice]:
        """What the elements may do that nothing happens to."""
        found: list[Choice] = []
        for e, state in zip(self.elements, self.states(mode), strict=True):
            opens = _opening(e) if state != "open" else ()
            rests = state == "sticks" and not e.only
            found.append((*(REST if rests else (state,)), *opens))
        return found

    def _settled(self, choices: Sequence[Choice], t: float, q: Array, v: Array) -> After:
        """The mode among the choices in which all forces and motions agree, and its state.

        Raises Undetermined where there is none, or where a contact could as well open as stay.
        """
        found: list[tuple[State, ...]] = []
        for states in itertools.product(*choices):
            after = self._projected(states, t, q, v)
            if self._agrees(states, choices, t, *after):
                found.append(states)
        if not found:
            raise self._painleve(self._rubbing(choices), "no motion", t)
        for other in found[1:]:
            for e, one, two in zip(self.elements, found[0], other, strict=True):
                if (one == "open") != (two == "open") and not self._grazes(e, found[0], t, q, v):
                    raise self._painleve(e.name, "both staying on and leaving the floor", t)
        return self.built.name(found[0]), *self._projected(found[0], t, q, v)

    def _agrees(
        self, states: tuple[State, ...], choices: Sequence[Choice], t: float, q: Array, v: Array
    ) -> bool:
        """Whether the forces are within the laws, and what may move moves the way it should."""
        mode, small = self.built.name(states), self._small(t, q, v)
        try:
            forces = self.forces(mode, t, q, v)
        except SingularPose as error:
            raise Undetermined(self._rubbing(choices), str(error), t) from error
        for e, state, choice in zip(self.elements, states, choices, strict=True):
            if e.normal is not None:
                if state == "open":
                    if len(choice) > 1 and self._change(e.normal, mode, t, q, v) < -small:
                        return False
                    continue
                if forces[f"{e.name}.normal"] < -small * float(np.max(self._M)):
                    return False
            if state == "sticks" and min(e.margins(forces)) < 0.0:
                return False
            s = sign(state) if "sticks" in choice else 0
            if s and s * self._change(e.tangent, mode, t, q, v) < -small:
                return False
        return True

    def _grazes(self, e: Element, states: tuple[State, ...], t: float, q: Array, v: Array) -> bool:
        """Whether the floor neither pushes nor is left: both answers are the same motion."""
        forces = self.forces(self.built.name(states), t, q, v)
        return abs(forces[f"{e.name}.normal"]) <= self._small(t, q, v) * float(np.max(self._M))

    def _change(self, part: Constraint, mode: str, t: float, q: Array, v: Array) -> float:
        """f_a q̈ᵃ − γ: how the rate of a row changes in a mode [m/s²]."""
        f, _, gamma = row(part, t, q, v)
        return float(f @ self.modes[mode].accelerations(t, q, v)) - gamma

    def _small(self, t: float, q: Array, v: Array) -> float:
        return ROUNDING * self.base.terms(t, q, v)[0]

    def _projected(
        self, states: tuple[State, ...], t: float, q: Array, v: Array
    ) -> tuple[Array, Array]:
        """The nearest q (in M) on the floor and v that meets the rows: what sticks is at rest."""
        mode = self.modes[self.built.name(states)]
        pairs = zip(self.elements, states, strict=True)
        closed = [e.normal for e, s in pairs if e.normal is not None and s != "open"]
        if closed:
            gaps = np.concatenate([self.base.f(t, q), [p.f(t, q.tolist())[0] for p in closed]])
            f = np.vstack([self.base.f_a(t, q), *(row(p, t, q, v)[0] for p in closed)])
            if len(gaps) == len(f):  # rolling is known as a rate only
                q = q - self._nearest(f, gaps)
        f, g = mode.f_a(t, q), mode.g(t, q)
        return q, v - self._nearest(f, f @ v - g) if len(f) else v

    def _nearest(self, f: Array, residual: Array) -> Array:
        by_mass = f / self._M
        return by_mass.T @ np.linalg.lstsq(f @ by_mass.T, residual, rcond=None)[0]

    def _rubbing(self, choices: Sequence[Choice]) -> str:
        """The element to blame: the first that is not simply open."""
        pairs = zip(self.elements, choices, strict=True)
        return next((e.name for e, c in pairs if c != ("open",)), self.elements[0].name)

    def _painleve(self, part: str, which: str, t: float) -> Undetermined:
        what = (
            f"with this friction the motion is not determined: at t = {t:.4g} s {which} "
            "satisfies the law (Painlevé's paradox)"
        )
        return Undetermined(part, what, t)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.87), (2.89) F_N ≥ 0, |F_fr| ≤ μ_s F_N where it sticks, v as it slides, gap ≥ 0."""
        forces = self.forces(mode, t, q, v)
        # At an event a force or rate is at its bound, as well as events are located.
        force = 1e-9 * (max(map(abs, forces.values())) or 1.0)
        rate = 1e-9 * (float(np.max(np.abs(v))) or 1.0)
        for e, state in zip(self.elements, self.states(mode), strict=True):
            if e.normal is not None:
                if state == "open":
                    if e.normal.f(t, q.tolist())[0] < -CLOSED * self.size:
                        return f"{e.name} is in the floor"
                    continue
                if forces[f"{e.name}.normal"] < -force:
                    return f"the floor would have to pull at {e.name}"
            if state == "sticks" and min(e.margins(forces)) < -force:
                return f"{e.name} would have to slip"
            if (s := sign(state)) and not e.frictionless and s * _rate(e.tangent, t, q, v) < -rate:
                return f"{e.name} slides the other way"
        return None


class _Modes(Mapping[str, Mechanism]):
    """The modes by name, built when asked for."""

    def __init__(self, owner: SwitchingMechanism, start: tuple[Array, Array]) -> None:
        self.owner, self.start = owner, start
        self.built: dict[str, Mechanism] = {}
        self.states: dict[str, tuple[State, ...]] = {}

    def name(self, states: tuple[State, ...]) -> str:
        """`touch slides +, rail sticks`."""
        pairs = zip(self.owner.elements, states, strict=True)
        name = ", ".join(f"{e.name} {state}" for e, state in pairs) or MOVING
        self.states[name] = states
        return name

    def __getitem__(self, name: str) -> Mechanism:
        if name not in self.built:
            pairs = list(zip(self.owner.elements, self.states[name], strict=True))
            smooth = [e for e, _ in pairs if isinstance(e, Smoothed)]
            parts: dict[str, Any] = {
                "held": [part for e, s in pairs for part in e.held(s)],
                "drags": [drag for e, s in pairs for drag in e.drags(s)],
                "rubs": [rub for e, s in pairs for rub in e.rubs(s)],
            }
            if smooth:
                built = SmoothMechanism(self.owner.scene, self.start, smooth, **parts)
            else:
                built = Mechanism(self.owner.scene, self.start, **parts)
            self.built[name] = built
        return self.built[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.built)

    def __len__(self) -> int:
        return len(self.built)


def _opening(element: Element) -> Choice:
    """What a contact on the floor may also do: leave it."""
    return () if element.normal is None else ("open",)


def _rate(part: Constraint, t: float, q: Array, v: Array) -> float:
    """f_a q̇ᵃ − g (2.15) of one row [m/s]."""
    f, g, _ = row(part, t, q, v)
    return float(f @ v) - g
