"""Prescribed rates against the freedoms that joints leave, and against the rates of the start."""

from collections.abc import Iterator

from ...fields.kind import Fields
from ...fields.number import NumberMistake, check_unit, per_second
from ...fields.signal import Signal
from ...mistake import Path, nearest
from ...scene import Joint, Scene
from ..grammar.drive import Drive
from ..parse import Finding, Parsed

TYPED = 1e-9  # of a number: it is typed with up to ten digits, and a sine's phase too


def drives(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound drives, and in starts that are others than theirs."""
    coordinates = scene.coordinates()
    for quantity, drive in parsed.file.scene.drive.items():
        path = ("scene", "drive", quantity)
        part, _, rate = quantity.rpartition(".")
        if part not in scene.joints:
            yield from _no_joint(parsed, scene, path, part)
            continue
        joint = scene.joints[part]
        freedom = joint.rates.get(rate)
        if freedom is None or rate not in coordinates[part]:
            yield path, _no_rate(joint, rate, coordinates[part])
            continue
        if freedom.kind == "shift" and joint.dry_friction is not None:
            what = "a part of what its drive would exert: leave one of them out"
            yield path, f"{part!r} has `dry_friction`, {what}"
            continue
        if freedom.kind == "turn" and len(joint.turns) > 2:
            why = "their middle axis is fixed in neither part; put a body between, on a joint more"
            yield path, f"{part!r} leaves three turns, and of these none can be driven: {why}"
        yield from _check_units(path, drive, f"{freedom.unit}/s")
    for name, start in parsed.file.initial.items():
        for key, given in start.given.items():
            yield from _check_rate(("initial", name, key), given, scene.drives.get(f"{name}.{key}"))


def _no_joint(parsed: Parsed, scene: Scene, path: Path, part: str) -> Iterator[Finding]:
    """The mistake of a drive whose part is not a joint."""
    if not parsed.hides(part, ("joints",)):
        yield path, f"unknown joint {part!r}{nearest(part, parsed.names('joints', scene.joints))}"


def _check_units(path: Path, drive: Drive, unit: str) -> Iterator[Finding]:
    """Whether each number of the law can be measured in the unit of the rate, per s, per s² …"""
    for at, amount, times in drive.amounts:
        try:
            check_unit(amount, per_second(unit, times))
        except NumberMistake as mistake:
            yield (*path, *at), str(mistake)


def _check_rate(path: Path, given: float, drive: Signal | None) -> Iterator[Finding]:
    """The mistake of a given rate that differs from its drive's at the start."""
    if drive is not None and abs(given - drive.at_start()[0]) > TYPED * abs(given):
        yield path, f"is {given:g}, but its drive begins with {drive.at_start()[0]:g}"


def _no_rate(joint: Joint, rate: str, fields: Fields) -> str:
    rates = {f.name: f"{joint.name}.{f.rate}" for f in joint.rates.values() if f.rate in fields}
    if rate in rates:
        return f"{rate!r} is a coordinate; a drive prescribes its rate, {rates[rate]!r}"
    if not rates:
        return f"{joint.name!r} leaves no rate that could be driven"
    hint = nearest(f"{joint.name}.{rate}", rates.values())
    return f"{joint.name!r} has no rate {rate!r}{hint}"
