"""The positions at the start in space: Newton's method from a guess, and other ways to assemble."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from ....cases.case import Placement
from ....cases.scene import GROUND
from ....cases.scene.rotation import about, product
from ...system import Array
from ..search import BESIDE, DEAD, FAR, NEAR, SAME, null, search
from . import refusal
from .branches import chains, closes, faithful, locked, past_lock, unreached
from .closure import SpatialClosure
from .guess import laid_out
from .initial_conditions import PLACES
from .ways import alike, distance, none_near, several_ways, unnamed

SEEDS = 40  # starts from which other assemblies are looked for

Seeds = Mapping[str, Mapping[str, float]]


def positions(closure: SpatialClosure) -> Array:
    """q (m,) that satisfies all equations.

    Raises CaseError if there is none, more than one to choose from, or a coordinate is left open.
    """
    for joint, angle in locked(closure):
        raise refusal.locked(closure.case, joint, angle)
    ways, nearest = search(closure, partial(_guesses, closure), partial(faithful, closure))
    if not ways and not np.isfinite(nearest[0]):
        raise refusal.flat(closure.case)
    if not ways:
        raise refusal.cannot_close(closure, nearest[1])
    found, ways = ways, nearest_ways(closure, ways)
    loose = null(closure.equations(ways[0])[1], closure.where.size)
    if len(loose):
        raise refusal.open_ended(closure, ways[0], loose)
    loose = null(closure.equations(ways[0])[1], closure.where.size, DEAD)
    if len(loose):
        raise refusal.dead_centre(closure, ways[0], loose)
    if len(ways) > 1:
        raise several_ways(closure, ways)
    if distance(closure, ways[0]) > FAR:
        raise none_near(closure, found)
    for joint in unreached(closure, ways[0]):
        raise refusal.unreached(closure.case, joint)
    return ways[0]


def nearest_ways(closure: SpatialClosure, ways: list[Array]) -> list[Array]:
    """The one that is nearest to what `near` says, or several that are as near as each other.

    Three turns are within gimbal lock where nothing says their middle one is past it.
    Of ways that differ in turns without a name alone, as of a rod that hangs on a universal joint
    turned over, that in which these turns are least.
    """
    nearest = _least(ways, [distance(closure, q) for q in ways])
    if len(nearest) > 1:
        nearest = _least(nearest, [past_lock(closure, q) for q in nearest])
    if closure.case.near and len(nearest) > 1 and alike(closure, nearest):
        return _least(nearest, [unnamed(closure, q) for q in nearest])
    return nearest


def _least(ways: list[Array], sizes: Sequence[float]) -> list[Array]:
    """The ways of the smallest size."""
    return [q for q, size in zip(ways, sizes, strict=True) if size < min(sizes) + SAME]


def _guesses(closure: SpatialClosure, ways: list[Array]) -> Iterator[Array]:
    """First guesses of q: what is near, some beside it, and any; ways: what was found of them.

    Where one way is so near to what `near` says that only nearer ones would matter, the last are
    left out.
    """
    case, where = closure.case, closure.where
    rng = np.random.default_rng(seed=1)  # any: the same starts in every run
    yield laid_out(where, _together(case.initial, case.near), {})
    if ways and not _several(closure):
        return
    for k in range(BESIDE if case.near else 0):
        beside = _beside(closure, k / BESIDE * NEAR, rng)
        yield laid_out(where, _together(case.initial, beside), _anywhere(closure, rng))
    if case.near and ways and min(distance(closure, q) for q in ways) < NEAR:
        return
    for _ in range(SEEDS):
        yield laid_out(where, case.initial, _anywhere(closure, rng))


def _together(
    initial: Mapping[str, Placement], near: Mapping[str, Placement]
) -> dict[str, Placement]:
    """The placements by name: what is given, and what is near where nothing is given."""
    both = {**near, **initial}
    for name in near.keys() & initial.keys():
        guess, given = near[name], initial[name]
        both[name] = replace(
            given,
            given={**guess.given, **given.given},
            points={**guess.points, **given.points},
            attitude=given.attitude or guess.attitude,
        )
    return both


def _several(closure: SpatialClosure) -> bool:
    """Whether there may be several ways: joints close a loop, or more holds a chain than its root.

    Its root is the ground, or a body that is placed by itself.
    """
    scene, own = closure.scene, {n: p for n, p in closure.case.initial.items() if _places(p)}
    if closes(scene) or scene.contacts or any(p.points for p in own.values()):
        return True
    return any(len(roots & {GROUND, *own}) > 1 for roots in chains(scene))


def _places(placement: Placement) -> bool:
    """Whether it says where a body is, be it by one number."""
    placed = placement.points or placement.attitude is not None
    return bool(placed) or any(axis in placement.given for axis in PLACES)


def _anywhere(closure: SpatialClosure, rng: np.random.Generator) -> Seeds:
    """Turns of joints anywhere."""
    return {
        joint.name: {
            freedom.name or f"#{i}": float(rng.uniform(-np.pi, np.pi))
            for i, freedom in enumerate(joint.freedoms)
            if freedom.kind == "turn"
        }
        for joint in closure.scene.joints.values()
    }


def _beside(closure: SpatialClosure, far: float, rng: np.random.Generator) -> dict[str, Placement]:
    """Placements as `near` says them, but off by up to `far`, in rad or sizes."""

    def off(turns: bool = False) -> float:
        return float(rng.uniform(-far, far)) * (1.0 if turns else closure.size)

    found: dict[str, Placement] = {}
    for name, near in closure.case.near.items():
        joint = closure.scene.joints.get(name)
        turns = {} if joint is None else {f.name: f.kind == "turn" for f in joint.named}
        given = {key: x + off(turns.get(key, False)) for key, x in near.given.items()}
        points = {key: tuple(x + off() for x in place) for key, place in near.points.items()}
        e = near.attitude
        if e is not None:
            x, y, z = rng.normal(size=3).tolist()
            size = math.hypot(x, y, z)
            turn = about((x / size, y / size, z / size), off(turns=True))
            e = tuple(product(np.array(e), np.array(turn)).tolist())
        found[name] = replace(near, given=given, points=points, attitude=e)
    return found
