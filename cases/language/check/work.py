"""The work that a case asks of its reference, counted before anything is computed.

A person may allow any amount of it; what nobody expected ends with a message instead of a night.
The steps of engines are counted where engines are known (reports/compare/trial/work.py).
"""

from collections.abc import Callable, Iterator, Mapping
from math import floor, hypot, inf, isnan, log10, sqrt
from typing import Any

from ...fields.signal import fastest
from ...mistake import Path
from ...scene import Anchor, Body, Scene
from ...scene.forces.element import Force
from ...scene.islands import apart
from ..grammar.file import File
from ..parse import Finding
from . import cost

VARIANTS = 100  # each is solved and run; a sweep of more is several files
PARTS = 300  # bodies and what is between them: a chain of 100 bars has 200
DAMPED = 50.0  # what a damper slows down costs so much less: only stability bounds its steps

GO_ON = "if that is meant, go on with --allow-long (pytest: --textmech-allow-long)"


def too_many_variants(data: Mapping[str, Any]) -> str | None:
    """The mistake of too many variants in a file's data, in words; None if they are few enough."""
    given = data.get("variants")
    count = len(given) if isinstance(given, Mapping) else 0
    return _above(count, VARIANTS, f"{count} variants")


def work(file: File, scene: Scene) -> Iterator[Finding]:
    """Yields what is above its limit: parts, samples, and how much swings in the time."""
    parts = len([*scene.elements()])
    if what := _above(parts, PARTS, f"{parts} bodies, joints, constraints, contacts and forces"):
        yield ("scene",), what
        return
    bodies = "body" if len(scene.bodies) == 1 else "bodies"
    of = f"of {len(scene.bodies)} {bodies}"
    if file.states is not None:
        count = file.states.random
        if what := _long(count * cost.state(scene), f"{count} states {of}"):
            yield ("states", "random"), what
        return
    pieces = apart(scene, file.system, file.events)
    if len(pieces) > 1:
        of += f", at most {max(len(piece.bodies) for piece in pieces)} of which hang together"
    sampled = file.samples * sum(map(cost.sample, pieces))
    what = f"{file.samples} samples {of}, {file.samples * len(scene.bodies)} rows,"
    most = f"{_down(file.samples * cost.LIMIT / sampled):g} samples" if sampled else ""
    if what := _long(sampled, what, most):
        yield ("samples",), what
        return
    swings = [_swings(file, piece) for piece in pieces]
    seconds = sum(swing[0] for swing in swings)
    left = (cost.LIMIT - sampled) / seconds if seconds else 0.0
    most = f"a duration of {_down(file.duration * left):g} s" if 0.0 < left < inf else ""
    if what := _long(sampled + seconds, max(swings)[1], most):
        yield ("duration",), what


def _swings(file: File, scene: Scene) -> tuple[float, str]:
    """Cost of the scene's swings [s], and the fastest of them in words."""
    found = (each for each in (*_rates(file, scene), *_spins(file, scene)) if not isnan(each[0]))
    rate, path = max(found, default=(0.0, ()))  # of a spoiled number its own mistake is said
    swing, count = rate * file.duration, len(scene.bodies)
    what = f"{'.'.join(map(str, path))} swings at {rate:.3g} rad/s, {swing:.3g} rad in all, which"
    beside = f"; with {count} bodies that hang together {file.samples} samples of it"
    return cost.swung(scene, swing), what.removesuffix(", which") + beside if count > 1 else what


def _down(number: float) -> float:
    """Two digits of it, and not more than it is."""
    digit = 10.0 ** (floor(log10(number)) - 1) if 0.0 < number < inf else 1.0
    return floor(number / digit) * digit if number < inf else number


def _above(number: float, limit: float, what: str) -> str | None:
    return f"{what}, and the limit is {limit:g}: {GO_ON}" if number > limit else None


def _long(seconds: float, what: str, most: str = "") -> str | None:
    if not seconds > cost.LIMIT:  # nor where a number of the file is spoiled
        return None
    limit = f"the limit is {cost.LIMIT / 60:g} minutes{most and f', or {most}'}"
    return f"{what} take {cost.about(seconds)}, and {limit}: {GO_ON}"


def _rates(file: File, scene: Scene) -> Iterator[tuple[float, Path]]:
    """How fast [rad/s] what is in the scene swings by itself or is driven, and by what."""
    jointed = {at.body for joint in scene.joints.values() for at in joint.refers()}
    heaviest = max((body.mass for body in scene.bodies.values()), default=1.0)

    def mobility(at: Anchor) -> float:
        body = scene.bodies.get(at.body)
        if body is None or at.point not in body.points:
            return 0.0
        # What is jointed moves others: to call it free would see a fast swing that is none.
        return 1 / heaviest if at.body in jointed else body.mobility(at.point)

    for name, force in scene.forces.items():
        swings, decays = force.pace(mobility)
        if decays > 0.0:  # a spoiled number is nan
            decays *= _quickened(file, scene, force, mobility)
        yield max(swings, decays / DAMPED), ("scene", "forces", name)
    for name, point in scene.points.items():
        if point.moves is not None:
            yield point.moves.angular_frequency, ("scene", "points", name)
    g = hypot(*scene.gravity)
    for at in _pins(scene):
        yield _pendulum(scene.bodies[at.body], at.point, g), ("scene", "bodies", at.body)


def _quickened(
    file: File, scene: Scene, force: Force, mobility: Callable[[Anchor], float]
) -> float:
    """How many times as much it slows down as at 1 m/s, of what only falls.

    Elsewhere, where others may strike or drive it, it is told as at 1 m/s.
    """
    others = (scene.drives, scene.joints, scene.pairs, scene.constraints)
    if len(scene.forces) > 1 or any(others):
        return 1.0
    at = max(force.refers(), key=mobility)
    start = file.initial.get(at.body)
    begins = hypot(*(start.given.get(rate, 0.0) for rate in ("vx", "vy", "vz"))) if start else 0.0
    return force.quickens(begins, hypot(*scene.gravity) / mobility(at))


def _spins(file: File, scene: Scene) -> Iterator[tuple[float, Path]]:
    """How fast what turns about a pin or on a blade is set off, or by what acts beside its centre.

    What is free only turns, which costs nothing.
    """
    if scene.frame.dimension == 3:
        yield from spins(file, scene)
        return
    yield from _driven(file, scene)
    for name in scene.joints:
        start = file.initial.get(name)
        if start is not None and start.omega is not None:
            yield abs(start.omega), ("initial", name)
    for edge in scene.constraints.values():
        if edge.speed is not None:
            yield edge.speed.angular_frequency, ("scene", "constraints", edge.name)
    for body in {*_turned(scene)}:
        start = file.initial.get(body)
        if start is not None and start.omega is not None:
            yield abs(start.omega), ("initial", body)


def _turned(scene: Scene) -> Iterator[str]:
    """The bodies whose motion depends on how they are turned."""
    yield from (edge.at.body for edge in scene.constraints.values())
    acting = [at for force in scene.forces.values() for at in force.refers()]
    yield from (at.body for at in (*_pins(scene), *acting) if any(_arm(scene, at)))


def _pins(scene: Scene) -> Iterator[Anchor]:
    """Where bodies turn about others or about the ground."""
    for joint in scene.joints.values():
        yield from (at for at in joint.refers() if joint.turns and at.body in scene.bodies)


def _arm(scene: Scene, at: Anchor) -> tuple[float, ...]:
    body = scene.bodies.get(at.body)
    return (0.0, 0.0) if body is None else body.points.get(at.point, (0.0, 0.0))


def _pendulum(body: Body, point: str, g: float) -> float:
    """√(m g d/(J + m d²)) [rad/s], the body hung up at the point."""
    d = hypot(*body.points.get(point, (0.0, 0.0)))
    return sqrt(body.mass * g * d / body.about(point)) if d else 0.0


# How fast a scene in space is set off and driven: turning costs steps, free or not.


def spins(file: File, scene: Any) -> Iterator[tuple[float, Path]]:
    """How fast [rad/s] bodies and joints start to turn, and how fast they are driven."""
    driven: Scene = scene
    mine = [name for name in file.initial if name in {**driven.bodies, **driven.joints}]
    for name, start in ((name, file.initial[name]) for name in mine):
        turning = [*(f"omega_{i}" for i in (1, 2, 3))]
        if name in driven.joints:
            rates = driven.joints[name].rates
            turning += [rate for rate, freedom in rates.items() if freedom.kind == "turn"]
        for key in turning:
            yield abs(start.given.get(key, 0.0)), ("initial", name)
    yield from _driven(file, driven)


def _driven(file: File, scene: Scene) -> Iterator[tuple[float, Path]]:
    """How fast [rad/s] joints are driven: what only slides turns nothing, however fast."""
    for rate, signal in scene.drives.items():
        part, _, name = rate.rpartition(".")
        path = ("scene", "drive", rate)
        yield signal.angular_frequency, path
        freedom = scene.joints[part].rates.get(name) if part in scene.joints else None
        if freedom is not None and freedom.kind == "turn":
            yield fastest(signal, file.duration), path
