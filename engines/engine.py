"""What every engine adapter answers, with the same verbs. An adapter sees scenes, never cases."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, Protocol

from ..cases.scene import Scene
from ..cases.trajectory import Array, Trajectory

Realised = Literal["native", "law", "driver"]
"""The engine's own force elements; our force law in a callback; our driver around the step."""
State = Mapping[str, tuple[float, float, float, float, float, float]]
"""body → x, y, angle, vx, vy, omega of its centre of mass."""


class Diverged(RuntimeError):
    """The engine's numbers left the finite range, or it says that they did."""


@dataclass(frozen=True)
class Choice:
    """One number or option of a setting, as the engine spells it, with its reason."""

    name: str
    value: Any
    because: str


class Engine(Protocol):
    """An engine with one setting (`mujoco.shipped`, `pymunk.tuned`, …)."""

    @property
    def name(self) -> str:
        """`mujoco`, `pymunk`."""
        ...

    @property
    def setting(self) -> str:
        """`shipped`, `tuned`, or `own`."""
        ...

    @property
    def version(self) -> str:
        """The engine's version."""
        ...

    @property
    def comment(self) -> tuple[str, str]:
        """What opens and closes a line of comment in the engine's own files."""
        ...

    @property
    def own_step(self) -> float | None:
        """The step [s] a user gets who changes nothing; None: the case names the step."""
        ...

    def realisations(self, scene: Scene) -> tuple[Realised, ...]:
        """In which ways the scene can be built; `native` always stands first."""
        ...

    def refuses(self, scene: Scene) -> str | None:
        """Why the scene cannot be built: `engine: …` or `adapter: …`, or None."""
        ...

    def withholds(self, scene: Scene, quantity: str) -> str | None:
        """Why the quantity cannot be read from the engine: `engine: …`, `adapter: …`, or None."""
        ...

    def tied(self, scene: Scene) -> bool:
        """Whether a number of the recipe follows the step (then there are two ladders)."""
        ...

    def exponents(self, scene: Scene, realised: Realised, *, held: bool) -> tuple[int, ...]:
        """Exponents of h in the error's expansion, as the setting declares them."""
        ...

    def protocol(self, scene: Scene, start: State, step: float, realised: Realised) -> str:
        """What is done to start and readout, in a few words with sizes; empty if nothing."""
        ...

    def choices(self, scene: Scene, step: float) -> list[Choice]:
        """The numbers of the setting for this scene and step."""
        ...

    def script(self, scene: Scene, start: State, step: float) -> str:
        """The scene as the engine's own file or script, ready to paste."""
        ...

    def measure(self, scene: Scene, start: State) -> dict[str, float]:
        """Physics read back from the engine before any step and before any seed or shift.

        `gravity.x`, `gravity.y`, `<body>.mass`, `<body>.inertia` (turning bodies),
        `<contact>.friction`, `<spring>.stiffness`, `<spring>.rest_length`, `<damper>.damping`,
        `energy.kinetic`, `momentum.x`, `momentum.y`, as far as the engine knows them.
        """
        ...

    def run(
        self,
        scene: Scene,
        start: State,
        times: Array,
        step: float,
        *,
        tied_to: float,
        realised: Realised,
        reactions: tuple[str, ...],
        record: bool = False,
    ) -> Trajectory:
        """The motion at `times`, whole multiples of `step` from 0.

        tied_to: the step [s] which the recipe's tied numbers follow (the step itself, or the
        ladder's largest). reactions: the wanted `joint.fx|fy|force|torque` and
        `contact.normal|tangent`; others are not computed. record: keep the states of every step
        too, from which event times are read. Raises Diverged.
        """
        ...

    def prepare(
        self, scene: Scene, start: State, step: float, *, realised: Realised
    ) -> Callable[[int], None]:
        """A function that takes n bare steps of the engine's own loop, for the benchmark."""
        ...
