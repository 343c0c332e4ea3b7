"""Contacts of two bodies: what touches what, and where."""

from collections.abc import Iterator

from ...mistake import Path, nearest
from ...scene import GROUND, Body, Scene
from ...scene.pair import FACES, Pair
from ..grammar.contact import Contact
from ..parse import Finding, Parsed
from .touch import cannot_touch

GROUNDS = "is for a plane of the ground: two bodies roll, slip and part as friction says"


def pairs(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound contacts of two bodies."""
    first: dict[frozenset[str], str] = {}
    for name, pair in scene.pairs.items():
        written: Contact = parsed.file.scene.contacts[name]
        path = ("scene", "contacts", name)
        for key in ("ideal", "ahead_of"):
            if getattr(written, key) is not None:
                yield (*path, key), GROUNDS
        unsound = [*_between(parsed, scene, (*path, "between"), pair, written.between)]
        yield from unsound
        both = frozenset(written.between)
        if both in first and not unsound:
            what = f"{' and '.join(written.between)} already touch in {first[both]!r}"
            yield (*path, "between"), what
        first.setdefault(both, name)


def _between(
    parsed: Parsed, scene: Scene, path: Path, pair: Pair, words: tuple[str, str]
) -> Iterator[Finding]:
    """Yields what is wrong with the two bodies of a pair that touch."""
    if pair.body == GROUND:
        yield path, f"the ground stands second: [{words[1]}, {words[0]}]"
    elif pair.body not in scene.bodies:
        if not parsed.hides(pair.body):
            hint = nearest(pair.body, parsed.names("bodies", scene.bodies))
            yield (*path, 0), f"unknown body {pair.body!r}{hint}"
    elif pair.body == pair.touched:
        yield path, f"{pair.body!r} touches itself"
    elif what := _unable(scene.bodies[pair.body], words[0].partition(".")[2]):
        yield (*path, 0), what
    elif what := _untouchable(scene.bodies[pair.touched], pair):
        yield (*path, 1), what


def _unable(body: Body, point: str) -> str | None:
    """Why this point of the body ("": none is named) cannot touch another body, or None."""
    if body.tips:
        return f"{body.name!r} has spokes, which touch planes of the ground only"
    return cannot_touch(body, point)


def _untouchable(body: Body, pair: Pair) -> str | None:
    """Why nothing can touch the body there, or None."""
    if body.radius is not None:
        where = f"{body.name}.{pair.face}"
        return pair.face and f"should be {body.name!r}, touched on its rim, is {where!r}"
    if body.size is None:
        what = f"{body.name!r} is a {body.shape} and has no rim and no side"
        return f"{what}: touched are disks, blocks, and planes of the ground"
    if pair.face not in FACES:
        sides = ", ".join(f"{body.name}.{face}" for face in FACES)
        return f"{body.name!r} is a block and is touched on a side: {sides}"
    return None
