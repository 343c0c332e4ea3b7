"""Contacts: what touches a plane of the ground or another body, and with which of its points."""

from collections.abc import Iterator

from ...mistake import Path, nearest
from ...scene import CENTER, FLOOR, GROUND, Anchor, Body, Scene
from ...scene.pair import FACES, Pair
from ..grammar.contact import Contact
from ..parse import Finding, Parsed


def contacts(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound contacts, and in the names of planes."""
    if scene.frame.dimension == 3:
        yield from _rolls(parsed, scene)
        return
    yield from _planes(parsed)
    yield from _touches(parsed, scene)
    yield from _pairs(parsed, scene)


def _touches(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Yields every mistake in contacts with planes of the ground; pairs are skipped."""
    first: dict[tuple[Anchor, str], str] = {}
    for name, contact in parsed.file.scene.contacts.items():
        path = ("scene", "contacts", name)
        if name in scene.pairs:
            continue
        touching, plane = contact.between
        part, _, point = touching.partition(".")
        body = scene.bodies.get(part)
        at, on = scene.contacts[name].at, plane.removeprefix(f"{GROUND}.")
        if body is None:
            if not parsed.hides(part):
                hint = nearest(part, parsed.names("bodies", scene.bodies))
                yield (*path, "between", 0), f"unknown body {part!r}{hint}"
        elif what := cannot_touch(body, point):
            yield (*path, "between", 0), what
        elif (at, on) in first:
            yield (*path, "between", 0), f"{touching!r} already touches in {first[at, on]!r}"
        elif what := _not_ideal(body, contact.ideal):
            yield (*path, "ideal") if contact.ideal else path, what
        elif contact.ahead_of is not None:
            yield from _other_foot(parsed, scene, name)
        first.setdefault((at, on), name)
        yield from _plane(parsed, (*path, "between", 1), plane)


def _planes(parsed: Parsed) -> Iterator[Finding]:
    """Names of planes that mean something else already."""
    for name in parsed.file.scene.planes:
        path = ("scene", "planes", name)
        if name == FLOOR:
            yield path, f"the name {FLOOR!r} is taken: the floor is y = 0"
        elif name in parsed.file.scene.points:
            yield path, f"{name!r} already names one of the points"


def _plane(parsed: Parsed, path: Path, word: str) -> Iterator[Finding]:
    ground, _, name = word.partition(".")
    known = (FLOOR, *parsed.names("planes", parsed.file.scene.planes))
    if ground == GROUND and (name in known or parsed.hides(name, ("planes",))):
        return
    if ground not in (GROUND, *known) and "." in word:
        hint = nearest(ground, parsed.names("bodies", parsed.file.scene.bodies))
        if not parsed.hides(ground):
            yield path, f"unknown body {ground!r}{hint}"
        return
    if len(known) == 1:
        yield path, f"should be {GROUND}.{FLOOR}, is {word!r}"
        return
    hint = nearest(word, [f"{GROUND}.{plane}" for plane in known])
    yield path, f"should be a plane of the ground, is {word!r}{hint}"


def _other_foot(parsed: Parsed, scene: Scene, name: str) -> Iterator[Finding]:
    """Yields what is wrong with the point that a foot has to be ahead of."""
    path, other = ("scene", "contacts", name, "ahead_of"), scene.contacts[name].ahead_of
    assert other is not None
    body = scene.bodies.get(other.body)
    if body is None:
        if not parsed.hides(other.body):
            hint = nearest(other.body, parsed.names("bodies", scene.bodies))
            yield path, f"unknown body {other.body!r}{hint}"
    elif other.point not in body.points:
        hint = nearest(other.point, body.points)
        yield path, f"body {other.body!r} has no point {other.point!r}{hint}"
    elif scene.contacts[name].on != FLOOR:
        yield path, f"a foot passes {GROUND}.{FLOOR}, and no other plane"
    elif scene.bodies[scene.contacts[name].body].tips:
        yield path, "spokes strike one after the other, and none passes through the floor"
    elif not any(
        contact.at == other and contact.ahead_of == scene.contacts[name].at
        for contact in scene.contacts.values()
    ):
        yield path, f"{str(other)!r} should be the other foot, with a contact ahead of this one"


def _not_ideal(body: Body, ideal: str | None) -> str | None:
    """Why the body cannot roll or pivot as the contact assumes, or None."""
    if ideal == "rolling" and body.radius is None:
        return f"{_shape_words(body)}; only a disk rolls"
    if ideal == "pivot" and (body.radius is not None or not body.turns):
        return f"{_shape_words(body)}; only spokes and a point of a bar pivot"
    if body.tips and ideal is None:
        return f"{body.name!r} has spokes, which only pivot here: write `ideal: pivot`"
    return None


def _shape_words(body: Body) -> str:
    return f"{body.name!r} has spokes" if body.tips else f"{body.name!r} is a {body.shape}"


def cannot_touch(body: Body, point: str) -> str | None:
    """Why this point of the body ("": none is named) cannot touch the floor, or None."""
    if body.radius is not None or body.shape == "particle":
        if point:
            with_it = "as a point" if body.radius is None else "with its rim"
            return f"{body.name!r} is a {body.shape} and touches {with_it}: write {body.name!r}"
        return None
    if body.tips:
        return f"{body.name!r} touches with its tips: write {body.name!r}" if point else None
    if not point or point == CENTER:
        points = ", ".join(f"{body.name}.{p}" for p in body.points if p != CENTER)
        what = f"touches with one point: {points}" if points else "needs `points` to touch with"
        return f"{body.name!r} is a {body.shape} and {what}"
    if point not in body.points:
        return f"body {body.name!r} has no point {point!r}{nearest(point, body.points)}"
    return None


# Contacts of two bodies.


GROUNDS = "is for a plane of the ground: two bodies roll, slip and part as friction says"


def _pairs(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound contacts of two bodies."""
    first: dict[frozenset[str], str] = {}
    for name, pair in scene.pairs.items():
        written: Contact = parsed.file.scene.contacts[name]
        path = ("scene", "contacts", name)
        for key in ("ideal", "ahead_of"):
            if getattr(written, key) is not None:
                yield (*path, key), GROUNDS
        unsound = [*_check_pair(parsed, scene, (*path, "between"), pair, written.between)]
        yield from unsound
        both = frozenset(written.between)
        if both in first and not unsound:
            what = f"{' and '.join(written.between)} already touch in {first[both]!r}"
            yield (*path, "between"), what
        first.setdefault(both, name)


def _check_pair(
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
    elif what := _cannot_touch_body(scene.bodies[pair.body], words[0].partition(".")[2]):
        yield (*path, 0), what
    elif what := _why_not_touched(scene.bodies[pair.touched], pair):
        yield (*path, 1), what


def _cannot_touch_body(body: Body, point: str) -> str | None:
    """Why this point of the body ("": none is named) cannot touch another body, or None."""
    if body.tips:
        return f"{body.name!r} has spokes, which touch planes of the ground only"
    return cannot_touch(body, point)


def _why_not_touched(body: Body, pair: Pair) -> str | None:
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


# Contacts in space: what rolls on the floor, or stands there on a point.


def _rolls(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Yields every mistake in the contacts of a scene in space: rolling and pivots."""
    first: dict[str, str] = {}
    for name, contact in parsed.file.scene.contacts.items():
        path = ("scene", "contacts", name, "between")
        touching, floor = contact.between
        part, _, point = touching.partition(".")
        body = scene.bodies.get(part)
        if body is None:
            if not parsed.hides(part):
                hint = nearest(part, parsed.names("bodies", scene.bodies))
                yield (*path, 0), f"unknown body {part!r}{hint}"
        elif contact.ideal == "pivot":
            if what := _no_pivot(body, point):
                yield (*path, 0), what
        elif body.radius is None:
            round_ = "a disk, a sphere or a rigid body with a `radius`"
            yield (*path, 0), f"{part!r} is a {body.shape}; in space only {round_} rolls"
        elif point:
            with_it = "with its rim" if body.axle else "anywhere"
            yield (*path, 0), f"{part!r} touches {with_it}: write {part!r}"
        elif part in first:
            yield (*path, 0), f"{part!r} already touches in {first[part]!r}"
        first.setdefault(part, name)
        if floor != f"{GROUND}.{FLOOR}":
            yield (*path, 1), f"should be {GROUND}.{FLOOR}, is {floor!r}"


def _no_pivot(body: Body, point: str) -> str | None:
    """Why the body cannot stand on the point."""
    if not body.turns:
        return f"{body.name!r} is a particle: a pivot lets a body turn about its point"
    if not point:
        return f"a pivot is a point: write '{body.name}.point'"
    if point not in body.points:
        return f"body {body.name!r} has no point {point!r}{nearest(point, body.points)}"
    return None
