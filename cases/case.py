"""A case: a claim about the motion of a scene, or about its states, with its source.

And with its three kinds of number.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape

import numpy as np

from .fields.event import Event
from .mistake import Mistake, Source
from .origin import Origin
from .scene import Scene, Vector
from .scene.quantity import Quantity, table
from .scene.states import States, claimable
from .trajectory import Array

ROUNDED = 1e-14  # of the duration: a time nearer than this is the same but for its rounding


@dataclass(frozen=True)
class Placement:
    """The start of one body, or in space of one joint, as far as the case file gives it.

    given: coordinates and rates by name, as x, vx, omega_1 of a body, angle and omega of a hinge.
    attitude: a unit quaternion, of a body in space or of a ball's second part against its first.
    polar: as the file has it, a point of the ground, how far [m] and in which direction [rad] the
    centre is from where it starts; x and y are given by it.
    """

    given: Mapping[str, float] = field(default_factory=dict)  # x, y, angle, vx, vy, omega
    points: Mapping[str, Vector] = field(default_factory=dict)
    attitude: tuple[float, float, float, float] | None = None
    on: tuple[str, ...] = ()  # the points with which the body stands on planes
    polar: tuple[str, float, float] | None = None


@dataclass(frozen=True)
class Deviation:
    """A declared difference of the model: the `limit` for h → 0, or an interval at the step."""

    because: str
    limit: float | None = None
    by: tuple[float, float] | None = None


@dataclass(frozen=True)
class Case:
    """One variant of one case file, with every number resolved."""

    name: str
    title: str
    origin: Origin
    system: str | None
    parameters: Mapping[str, float]
    drops_out: tuple[str, ...]
    scene: Scene
    initial: Mapping[str, Placement]
    near: Mapping[str, Placement]
    duration: float
    samples: int
    step: float | Mapping[str, float]  # s, of all engines, or by engine; some may be left out
    allow: Mapping[str, float | None]  # None: `unknown`, to be measured
    reach: Mapping[str, Mapping[str, float]]
    deviates: Mapping[str, Mapping[str, Deviation]]
    rests: bool
    stays: tuple[str, ...]  # quantities whose claim is that they do not move
    events: Mapping[str, Event]
    source: Source  # the file, for messages
    tube: float = 0.0  # s: how long what jumps may take; just after an event is so much later
    states: States | None = None  # of a claim about states; its times are their numbers
    long: bool = False  # whether its reference may take any amount of work
    corners: tuple[float, ...] = ()  # s, of the laws of a scene of which this has a part
    late: float = 0.0  # s: how much later each sample is; an engine starts at the first

    @property
    def times(self) -> Array:
        """The sample times (samples,), the only times at which anything is compared.

        One that is a corner of a law but for rounding is that corner: 0.1 and not 1.2/12, of which
        a double is less than 0.1, and a force that jumps there would act a sample late.
        """
        times = np.arange(self.samples, dtype=np.float64) * self.interval + self.late
        for corner in {*self.corners, *self.scene.corners()}:
            k = min(self.samples - 1, max(0, round(corner / self.interval)))
            if abs(times[k] - corner) <= ROUNDED * self.duration:
                times[k] = corner
        return times

    @property
    def quantities(self) -> dict[str, Quantity]:
        """Every quantity that can be bounded, by name; those of events are not among them."""
        return dict(table(self.scene) if self.states is None else claimable(self.scene))

    @property
    def interval(self) -> float:
        return self.duration / (self.samples - 1)

    def _repr_html_(self) -> str:
        """The HTML that a notebook shows: title, what the scene is made of, what is allowed."""
        about = f"{self.name}, {self.origin}" if str(self.origin) else self.name
        parts = {
            "bodies": self.scene.bodies,
            "joints": self.scene.joints,
            "contacts": {**self.scene.contacts, **self.scene.pairs},
            "constraints": self.scene.constraints,
            "forces": self.scene.forces,
        }
        lasts = f"{self.duration:g} s, {self.samples} samples"
        rows = {
            **{part: ", ".join(names) for part, names in parts.items() if names},
            **({"lasts": lasts} if self.states is None else {"states": str(self.samples)}),
            "allows": ", ".join(map(self._allows, self.allow)),
        }
        cells = "".join(f"<tr><th>{k}</th><td>{escape(text)}</td></tr>" for k, text in rows.items())
        return f"<b>{escape(self.title)}</b><br>{escape(about)}<table>{cells}</table>"

    def _allows(self, name: str) -> str:
        bar, known = self.allow[name], self.quantities
        unit = known[name].unit if name in known else "s" if name.endswith(".time") else ""
        return f"{name} {'unknown' if bar is None else f'{bar:g} {unit}'.rstrip()}"

    def mistake(self, path: tuple[str | int, ...], what: str) -> Mistake:
        """A mistake found after loading, at the place in the file that caused it."""
        return self.source.mistake(path, what)
