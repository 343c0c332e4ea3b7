"""Prescribed rates in the plane against the freedoms that joints leave."""

from collections.abc import Iterator

from ...fields.kind import Fields
from ...fields.number import NumberMistake, fitting, per_second
from ...fields.signal import Signal
from ...mistake import Path, nearest
from ...scene import Joint, Scene
from ..grammar.drive import Drive
from ..parse import Finding, Parsed

TYPED = 1e-9  # of a number: it is typed with up to ten digits, and a sine's phase too


def drives(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound drives, and in starts that are others than theirs."""
    left = scene.coordinates()
    for quantity, drive in parsed.file.scene.drive.items():
        path = ("scene", "drive", quantity)
        part, _, rate = quantity.rpartition(".")
        if part not in scene.joints:
            yield from unknown(parsed, scene, path, part)
            continue
        freedom = scene.joints[part].rates.get(rate)
        if freedom is None or rate not in left[part]:
            yield path, _no_rate(scene.joints[part], rate, left[part])
        elif freedom.kind == "shift" and scene.joints[part].dry_friction is not None:
            what = "a part of what its drive would exert: leave one of them out"
            yield path, f"{part!r} has `dry_friction`, {what}"
        else:
            yield from fits(path, drive, f"{freedom.unit}/s")
    for name, start in parsed.file.initial.items():
        for key, given in start.given.items():
            yield from agrees(("initial", name, key), given, scene.drives.get(f"{name}.{key}"))


def unknown(parsed: Parsed, scene: Scene, path: Path, part: str) -> Iterator[Finding]:
    """A drive of what is no joint."""
    if not parsed.hides(part, ("joints",)):
        yield path, f"unknown joint {part!r}{nearest(part, parsed.names('joints', scene.joints))}"


def fits(path: Path, drive: Drive, unit: str) -> Iterator[Finding]:
    """Whether each number of the law can be measured in the unit of the rate, per s, per s² …"""
    for at, amount, times in drive.amounts:
        try:
            fitting(amount, per_second(unit, times))
        except NumberMistake as mistake:
            yield (*path, *at), str(mistake)


def agrees(path: Path, given: float, drive: Signal | None) -> Iterator[Finding]:
    """A rate that is prescribed need not be given; what is given has to agree."""
    if drive is not None and abs(given - drive.at_start()[0]) > TYPED * abs(given):
        yield path, f"is {given:g}, but its drive begins with {drive.at_start()[0]:g}"


def _no_rate(joint: Joint, rate: str, left: Fields) -> str:
    rates = {f.name: f"{joint.name}.{f.rate}" for f in joint.rates.values() if f.rate in left}
    if rate in rates:
        return f"{rate!r} is a coordinate; a drive prescribes its rate, {rates[rate]!r}"
    if not rates:
        return f"{joint.name!r} leaves nothing that could be driven"
    hint = nearest(f"{joint.name}.{rate}", rates.values())
    return f"{joint.name!r} has no rate {rate!r}{hint}"
