"""The protocol of every engine: four verbs, and the plan they share. It sees scenes, never cases.

engines/README.md says how to add one.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Literal, Protocol, runtime_checkable

import numpy as np

from ..cases.scene import Scene
from ..cases.scene.motion import Motion
from ..cases.trajectory import Array, Trajectory
from .knobs import Knob, Options

Realised = Literal["native", "law", "driver"]
"""The engine's own force elements; our force law in a callback; our driver around the step."""
Start = Mapping[str, tuple[float, ...]]
"""body → its state as `scene.frame` has it: x, y, angle, vx, vy, omega of its centre of mass; in
space r, unit quaternion, v and ω in body axes."""


class Diverged(RuntimeError):
    """The engine's numbers left the finite range, or it says that they did."""


@dataclass(frozen=True)
class Choice:
    """One number or option of a setting, as the engine spells it, with its reason."""

    name: str  # as the engine spells it
    value: Any  # at the step
    because: str  # its reason, in words for a table


def no_numbers(step: float) -> Sequence[Choice]:
    """No choices at any step [s]: the numbers of an engine that has none to choose."""
    return ()


def as_it_is(step: float) -> str:
    """Nothing is done to start and readout."""
    return ""


@dataclass(frozen=True)
class Plan:
    """The decisions of a setting about one scene and its start before it runs. It is pickled.

    held: exponents of h in the error's expansion while every other number stays the same.
    following: the same while numbers tied to the step follow it; None: no number is tied.
    alike: whether those numbers make no difference to the motion: then one ladder tells it all.
    numbers: the setting's numbers, for the step [s] that tied ones follow.
    protocol: what is done to start and readout at a step [s], in a few words with sizes.
    simplified: what of the scene is left out, in words: it is named where the model differs.
    withheld: quantity → why it cannot be read from the engine: `engine: …` or `adapter: …`.
    """

    realised: Realised  # native: the engine's own elements; law, driver: ours beside them
    held: tuple[int, ...]
    following: tuple[int, ...] | None = None
    numbers: Callable[[float], Sequence[Choice]] = no_numbers
    protocol: Callable[[float], str] = as_it_is
    withheld: Mapping[str, str] = field(default_factory=dict)
    simplified: str = ""
    alike: bool = False
    kept: float | None = None  # s: tied numbers keep what they are at this step

    def choices(self, step: float) -> Sequence[Choice]:
        """The numbers with which a step [s] is taken."""
        return self.numbers(step if self.kept is None else self.kept)

    def held_at(self, step: float) -> "Plan":
        """A copy of the plan in which tied numbers are kept at what they are for the step [s]."""
        return replace(self, kept=step)

    @property
    def exponents(self) -> tuple[int, ...]:
        """The exponents of h in the error's expansion on the ladder climbed with this plan."""
        return self.held if self.following is None or self.kept is not None else self.following


@dataclass(frozen=True)
class Refusal:
    """A way in which the scene is not run: `engine: …` it cannot, `adapter: …` ours does not."""

    realised: Realised  # the way that is refused
    because: str  # why, in words for a table


class Engine(Protocol):
    """An engine with one setting (`mujoco.shipped`, `pymunk.tuned`, …). It is pickled."""

    @property
    def name(self) -> str:
        """`mujoco`, `pymunk`: the name of its entry point."""
        ...

    @property
    def setting(self) -> str:
        """One that the engine offers, or the name of the user's own."""
        ...

    @property
    def version(self) -> str:
        """The engine's version."""
        ...

    @property
    def own_step(self) -> float | None:
        """The step [s] a user gets who changes nothing; None: the case names the step."""
        ...

    def plans(self, scene: Scene, start: Start) -> Sequence[Plan | Refusal]:
        """Each way of running the scene once, or why it is not run."""
        ...

    def measure(self, scene: Scene, start: Start) -> Mapping[str, float]:
        """Physics read back from the engine before any step and before any seed or shift.

        `gravity.x`, `gravity.y`, `<body>.mass`, `<body>.inertia` (turning bodies; in space
        `<body>.inertia_11` … `inertia_23`, and the z of every vector),
        `<contact>.friction`, `<joint>.friction_forward|friction_backward`, `<spring>.stiffness`,
        `<spring>.rest_length`, `<damper>.damping`, `<drag>.coefficient`, `energy.kinetic`,
        `momentum.x`, `momentum.y`,
        as far as the engine knows them.
        """
        ...

    def run(
        self,
        scene: Scene,
        start: Start,
        times: Array,
        step: float,
        plan: Plan,
        *,
        reactions: tuple[str, ...],
        record: bool = False,
    ) -> Trajectory:
        """The motion at `times`, whole multiples of `step` [s] from 0, by a plan for the scene.

        reactions: the wanted `joint.fx|fy|force|torque|friction`, `contact.normal|tangent` and, of
        bodies, `body.ax|ay|alpha`, in
        space `joint.fx|fy|fz|mx|my|mz`, `contact.fx|fy|normal` and what drives exert (`q1.torque`),
        of which those not withheld are given; others are not computed. record: keep the states
        of every step too, from which event times are read. Raises Diverged.
        """
        ...

    def script(
        self,
        scene: Scene,
        start: Start,
        step: float,
        plan: Plan,
        *,
        title: str = "",
        duration: float = 1.0,
    ) -> str:
        """The scene as the engine's own file or script, ready to paste, headed by comments.

        title: what it shows, in words of the user's: they are text there, and never code.
        duration: how long it runs [s], where it runs by itself.
        """
        ...


@runtime_checkable
class Claims(Protocol):
    """An optional extension of the protocol: answers about states that no step leads to."""

    def answer(
        self, scene: Scene, start: Start, states: Mapping[str, Array], wanted: Sequence[str]
    ) -> Mapping[str, Array | str]:
        """For each wanted quantity its samples (N,), or why it has none: `engine: …`, `adapter: …`.

        An attitude has (N, 4), `mass_matrix` all entries of all states (N n²,). states: by
        coordinate (N, 3) places, rates and accelerations, in the order of the mass matrix; start:
        the first of them. Masses and inertias are those that the engine finds by itself from the
        shapes of bodies, as far as they have any.
        """
        ...


Cost = Callable[[Options, float], float]
"""A number above 0 for own options and a step [s]: twice as large, a run takes twice as long."""


@runtime_checkable
class Tunable(Protocol):
    """An optional extension of the protocol: which options of the engine to tune, and at what cost.

    Whatever the setting; options are the user's own, under which the engine is then made.
    """

    steps: ClassVar[tuple[float, ...]]
    """Steps [s] worth trying, the largest first; a user's who changes nothing is one of them."""

    def knobs(self, scene: Scene, start: Start) -> Sequence[Knob]:
        """The closed list of what matters for the scene, if the engine runs it natively."""
        ...

    def recipe(self, scene: Scene, start: Start) -> Options:
        """The tuned setting's native way, as own options: with them the same numbers are run."""
        ...

    def cost(self, scene: Scene, start: Start) -> Cost:
        """The cost of a simulated second by options and step [s], to compare them: no seconds."""
        ...

    def snippet(self, scene: Scene, start: Start, options: Options, step: float) -> str:
        """The options at the step [s] in the engine's own language, ready to paste."""
        ...


@dataclass(frozen=True)
class Shape:
    """A user's own model of a scene, in words, and the own options that build it."""

    words: str  # what each body is there, as `ball is a sphere geom`
    options: Options  # under which the engine builds it
    held: bool = True  # whether recipes have to hold on it, too; else they are measured on it


@runtime_checkable
class Plain(Protocol):
    """An optional extension of `Tunable`: scenes with the shapes that a user has, not ours.

    A recipe for contacts that holds for the points and planes of an adapter may not hold for a box:
    advice is searched on these shapes, started as a user starts them.
    """

    def shapes(self, scene: Scene, start: Start) -> Sequence[Shape]:
        """The shapes of a user's, on the first of which recipes are searched.

        None where nothing touches, or where the adapter builds its own model only.
        """
        ...

    def own_contacts(self, scene: Scene) -> str:
        """How contacts are built without, where that is not as users do; empty: nothing touches."""
        ...


@runtime_checkable
class Paced(Protocol):
    """An optional extension of the protocol: how long a step takes, for the limits of work."""

    def pace(self, scene: Scene) -> float:
        """About how long one step of the scene takes [s], in its dearest way, on one core."""
        ...


class Maker(Protocol):
    """The callable that an entry point names and that makes an engine, usually its class."""

    offers: tuple[str, ...]
    """Its settings: of `shipped`, `recommended` and `tuned` those it has."""

    def __call__(self, setting: str, options: Mapping[str, Any]) -> Engine:
        """The engine with a setting it offers, or with the user's options under another name.

        options: all that the user's file has under the engine's name, `step` [s] too if the engine
        takes one: it is then its `own_step`. Empty for a setting that the engine offers.

        Raises ValueError for mistaken options: a line `<engine>.<option>: what is wrong` for each.
        """
        ...


def lacking(engine: object, protocol: type) -> tuple[str, ...]:
    """The members of a protocol that an engine does not have, in their order."""
    members = [*getattr(protocol, "__annotations__", {}), *vars(protocol)]
    public = (name for name in dict.fromkeys(members) if not name.startswith("_"))
    return tuple(name for name in public if not hasattr(engine, name))


# A start as elements look at it: a motion of one row.


def begun(scene: Scene, start: Start) -> Motion:
    """The start."""
    states = {name: np.array([start[name]]) for name in scene.bodies}
    return Motion(scene.bodies, scene.points, Trajectory(np.zeros(1), states, {}), scene.joints)
