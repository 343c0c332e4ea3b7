"""Measures scenes of many bodies or samples: CPU seconds, or a refusal that names its bound."""

import json
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.reference.solve import solve

SOLVED = 60.0  # CPU s: of a machine half as fast as that on which the slowest takes 20
REFUSED = 2.0  # CPU s: a refusal computes nothing
BAR = {"bar": {"mass": 1.0, "length": 0.1}}
LINK = {  # in space, where a slender bar would turn about itself
    "rigid": {"mass": 1.0, "inertia": [1e-3, 1e-3, 1e-4, 0, 0, 0]},
    "points": {"start": [-0.05, 0, 0], "end": [0.05, 0, 0]},
}
BOX = {"rigid": {"mass": 1.0, "inertia": [0.1, 0.2, 0.25, 0, 0, 0]}}
PARTICLE = {"particle": {"mass": 1.0}}
BESIDE: dict[str, dict[str, Any]] = {  # of a start, beside its place and velocity
    "bar": {"angle": 0.1, "omega": 1.0},
    "rigid": {"attitude": {"axis": [0, 0, 1], "angle": 0}, "omega": [0.3, 2.0, 0.1]},
}
File = dict[str, Any]


@dataclass(frozen=True)
class Grown:
    """CPU seconds of one scene, read and certified, or of its refusal; and their bound."""

    scene: str
    seconds: float
    bound: float
    refusal: str = ""


def scenes() -> dict[str, File]:
    """A case file for each, by what is in it."""
    bars, links = (10, 20, 40, 80, 100), (5, 10, 20)
    return {
        **{f"chain of {n} bars": chain(n) for n in bars},
        **{f"chain of {n} links in space": chain(n, space=True) for n in links},
        "100 pendulums": hung(100),
        "200 particles": free(200, PARTICLE),
        "200 bars, 50 springs": free(200, BAR, 50),
        "200 particles in space": free(200, PARTICLE, space=True),
        "100 boxes, 25 springs in space": free(100, BOX, 25, space=True),
        "pendulum, 250001 samples": chain(1) | {"samples": 250_001},
    }


def chain(count: int, *, space: bool = False) -> File:
    """Bars in a row that hangs on the ground."""
    ends = ["ground.P0", *(f"b{i}.end" for i in range(count))]
    pairs = [[ends[i], f"b{i}.start"] for i in range(count)]
    if not space:
        start = {f"b{i}": {"angle": 0.1} for i in range(count)}
        return _file([BAR] * count, {"joints": _pins(pairs)}, start, "b0.angle")
    joints = {f"j{i}": {"hinge": pair, "axis": [0, 1, 0]} for i, pair in enumerate(pairs)}
    turned = {name: {"angle": 0.1, "omega": 0} for name in joints}
    return _file([LINK] * count, {"space": 3, "joints": joints}, turned, "j0.angle")


def hung(count: int) -> File:
    """Pendulums, each a little longer than the one before, on points of the ground."""
    bodies = [{"bar": {"mass": 1.0, "length": 0.5 + 0.005 * i}} for i in range(count)]
    pins = _pins([[f"ground.P{i}", f"b{i}.start"] for i in range(count)])
    return _file(bodies, {"joints": pins}, {f"b{i}": {"angle": 0.1} for i in range(count)}, "b0.y")


def free(count: int, body: Mapping[str, Any], springs: int = 0, *, space: bool = False) -> File:
    """Bodies that touch nothing, the first of them in pairs on springs."""
    shape, still = next(iter(body)), {"z": 0, "vz": 0} if space else {}
    pairs = ((f"b{2 * i}.center", f"b{2 * i + 1}.center") for i in range(springs))
    forces = {
        f"s{i}": {"spring": pair, "stiffness": 30.0 + i, "rest_length": 0.9}
        for i, pair in enumerate(pairs)
    }
    start = {
        f"b{i}": {
            "x": i,
            "y": 0,
            "vx": 0.1 * (i % 7 + 1),
            "vy": 0,
            **still,
            **BESIDE.get(shape, {}),
        }
        for i in range(count)
    }
    frame = {"space": 3} if space else {}
    return _file([body] * count, {**frame, "forces": forces}, start, "b0.x")


def _pins(pairs: list[list[str]]) -> File:
    return {f"j{i}": {"pin": pair} for i, pair in enumerate(pairs)}


def _file(bodies: list[Any], scene: File, start: File, asked: str) -> File:
    places = [[i, 0, 0] if "space" in scene else [i, 0] for i in range(len(bodies))]
    ground = {"points": {f"P{i}": place for i, place in enumerate(places)}}
    named = {f"b{i}": body for i, body in enumerate(bodies)}
    return {
        "title": "How work grows",
        "scene": {**scene, **ground, "bodies": named},
        "initial": start,
        "duration": 1.0,
        "samples": 26,
        "allow": {asked: 1e-2},
    }


def grown() -> Iterator[Grown]:
    """Each scene once: a second more or less is not what is asked."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "grown.yaml"
        for scene, case in scenes().items():
            file.write_text(json.dumps(case, indent=1), encoding="utf-8")
            yield _measured(scene, file)


def _measured(scene: str, file: Path) -> Grown:
    refusal, before = "", time.process_time()
    try:
        for case in load(file):
            solve(case)
    except CaseError as error:
        refusal = error.mistakes[0].what
    seconds = time.process_time() - before
    return Grown(scene, seconds, REFUSED if refusal else SOLVED, refusal)
