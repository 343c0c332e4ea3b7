"""A trial: one engine, in one realisation, against the reference motion of one case."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ....cases.case import Case
from ....cases.scene import Scene
from ....cases.scene.difference import from_reference
from ....cases.scene.observe import observe
from ....cases.scene.quantity import Quantity, at_event, at_events, event_quantities
from ....cases.trajectory import Array, Trajectory
from ....engines.engine import Engine, Plan, Realised, Refusal, Start
from ..events.states import reference_states
from ..events.timing import Timing, timing
from .answers import plans
from .ladder import judged_step
from .start import first
from .table_text import why

NOTHING_OF_ITS_OWN = "engine: it has nothing of its own for this; see the rows of laws and drivers"
SAME_COUNT = 0.5  # what counts may differ by where the case does not say: they are whole numbers


def ways(engine: Engine, scene: Scene, start: Start) -> tuple[Plan | Refusal, ...]:
    """Returns the ways in which a scene is tried, or refused, a native one always among them."""
    answered = plans(engine, scene, start)
    native = any(way.realised == "native" for way in answered)
    return answered if native else (Refusal("native", NOTHING_OF_ITS_OWN), *answered)


def with_room(
    planned: tuple[Plan | Refusal, ...], case: Case, engine: Engine
) -> tuple[Plan | Refusal, ...]:
    """The ways, refused where three samples are more than the engine's own step leaves room for."""
    own = engine.own_step
    if own is None or 2 * own <= case.duration:
        return planned
    why = f"adapter: {case.duration:g} s are less than two of its steps of {own:g} s"
    return tuple(Refusal(way.realised, why) for way in planned)


def planned(engine: Engine, scene: Scene, start: Start) -> tuple[Plan | Refusal, ...]:
    """Returns `ways`; what an engine raises is one native way, which fails when it is tried."""
    try:
        return ways(engine, scene, start)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # of an engine's own kind too
        return (Refusal("native", why(error)),)


def judged_names(case: Case) -> tuple[str, ...]:
    """The names that are judged: those in the case's `allow`, and the count of every event."""
    counts = (f"{event}.count" for event in case.events)
    return (*case.allow, *(name for name in counts if name not in case.allow))


@dataclass(frozen=True)
class Trial:
    """A case's reference, and an engine that runs the scene in one way, or refuses to."""

    case: Case
    reference: Trajectory
    engine: Engine
    way: Plan | Refusal
    sampled: bool = False  # the case's samples are not its own: the engine's step misses those
    timed: Timing | None = None  # of the same reference
    starts: int = 1  # parts of a step at which it begins, of which the worst is judged

    @property
    def realised(self) -> Realised:
        """`native`, `law` or `driver`."""
        return self.way.realised

    @property
    def plan(self) -> Plan:
        """The plan of a trial that is run."""
        assert isinstance(self.way, Plan)
        return self.way

    def wanted(self, quantity: str) -> Array:
        """The reference's samples (N,), at events (K,); of an attitude no turn, (N, 3)."""
        if self._dated(quantity):
            return self._at_events[quantity]
        if quantity not in self._wanted:
            samples = observe(self.case.scene, self.reference, quantity)
            self._wanted[quantity] = from_reference(samples, samples)
        return self._wanted[quantity]

    @cached_property
    def _wanted(self) -> dict[str, Array]:
        """The reference's samples asked for so far: every rung of every ladder asks again."""
        return {}

    def read(self, quantity: str, samples: Array) -> Array:
        """Returns a run's samples to compare with `wanted`; of an attitude the turn from it."""
        if samples.ndim == 1 or quantity in self.case.scene.bodies:
            return samples  # numbers, times of events, and a body's poses
        return from_reference(samples, observe(self.case.scene, self.reference, quantity))

    @cached_property
    def withheld(self) -> dict[str, str]:
        """For each judged name that the engine withholds, or whose event it withholds: why."""
        whys = self.plan.withheld
        return {
            name: whys[told_by]
            for name in judged_names(self.case)
            for told_by in self._sources(name)
            if told_by in whys
        }

    def _sources(self, name: str) -> tuple[str, ...]:
        """Returns the quantity with those it follows from, or an event's with that of its state."""
        if not self._dated(name):
            return (name, *self.case.scene.told_by(name))
        event = self.case.events[self.quantity(name).part].quantity
        at = at_event(name, self.case.events)
        return (event, at.quantity) if at else (event,)

    def _dated(self, name: str) -> bool:
        return self.quantity(name).part in self.case.events

    @property
    def motion(self) -> tuple[str, ...]:
        """The judged quantities that the engine tells at every sample."""
        return tuple(name for name in self._given_names if not self._dated(name))

    @property
    def instants(self) -> tuple[str, ...]:
        """The judged names of events, for times, counts and states, that the engine gives."""
        return tuple(name for name in self._given_names if self._dated(name))

    @property
    def _given_names(self) -> list[str]:
        return [name for name in judged_names(self.case) if name not in self.withheld]

    @cached_property
    def timing(self) -> Timing:
        """The reference's events; one that other trials of the case use too, where it was given."""
        return self.timed or timing(self.case, self.reference)

    @cached_property
    def _at_events(self) -> dict[str, Array]:
        """The reference's times (K,) and states (K,) of what is judged of events."""
        events = self.timing.events
        samples = {f"{event}.time": times for event, times in events.items()}
        for name in self.case.allow:
            at, record = at_event(name, self.case.events), self.reference.record
            if at is not None and record is not None:
                samples[name] = reference_states(self.case, record, at, events[at.event])
        return samples

    def away(self, distance: float) -> NDArray[np.bool_]:
        """Which samples (N,) are at least `distance` [s] from where the reference switches."""
        return self._from_switches >= distance

    @cached_property
    def behind(self) -> NDArray[np.bool_]:
        """Which samples (N,) come after the first switch of the reference behind its start."""
        switches = self.reference.switches
        first = float(np.min(switches[switches > self.case.times[0]], initial=np.inf))
        return self.case.times > first

    @cached_property
    def _from_switches(self) -> Array:
        """How far [s] each sample (N,) is from where the reference switches; every rung asks."""
        gaps = np.abs(self.case.times[:, None] - self.reference.switches[None, :])
        nearest: Array = np.min(gaps, axis=1, initial=np.inf)
        return nearest

    def allowed(self, name: str) -> float | None:
        """The largest error that still counts as textbook mechanics; None: not known yet."""
        return self.case.allow.get(name, SAME_COUNT)

    def quantity(self, name: str) -> Quantity:
        """The quantity's unit and kind; the audit has none."""
        return self._quantities.get(name) or Quantity(name, "", "", "", "residual")

    @cached_property
    def _quantities(self) -> dict[str, Quantity]:
        seen, events = self.case.quantities, self.case.events
        return seen | event_quantities(events) | at_events(events, seen)

    def size(self, name: str) -> float:
        """Returns the quantity's size; a residual, meant to be zero, has the size of its motion."""
        wanted = self.wanted(name)
        size = float(np.max(np.abs(wanted))) if wanted.ndim == 1 else 1.0  # rad
        if self.quantity(name).kind == "residual":
            columns = self.case.scene.frame.alike(self.quantity(name).unit)
            states = np.concatenate(list(self.reference.states.values()))
            size = max(size, float(np.max(np.abs(states[:, columns]))))
        return size

    @cached_property
    def step(self) -> float:
        """The step at which the trial is judged."""
        return judged_step(self.case, self.engine)

    @cached_property
    def protocol(self) -> str:
        """Says what is done to start and readout, and the samples where they are not the case's."""
        base, n = self.plan.protocol(self.step), self.case.samples
        own = f"{n} samples at whole steps of its own" if self.sampled else ""
        phases = f"the worst of {self.starts} starts within a step" if self.starts > 1 else ""
        return "; ".join(part for part in (base, own, phases) if part)

    @property
    def start(self) -> Start:
        """Row 0 of the reference: where every engine starts."""
        return first(self.reference)
