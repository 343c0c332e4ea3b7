"""Prescribed rates against the freedoms that joints name."""

from collections.abc import Iterator

from ....mistake import nearest
from ....space.scene import SpatialScene
from ...parse import Finding, Parsed
from ..drive import fits, unknown


def drives(parsed: Parsed, scene: SpatialScene) -> Iterator[Finding]:
    """Every mistake in the sound drives."""
    for quantity, drive in parsed.file.scene.drive.items():
        path = ("scene", "drive", quantity)
        part, _, rate = quantity.rpartition(".")
        if part not in scene.joints:
            yield from unknown(parsed, scene, path, part)
            continue
        rates = scene.joints[part].rates
        if rate not in rates:
            yield path, _no_rate(scene, part, rate)
            continue
        if rates[rate].kind == "turn" and len(scene.joints[part].turns) > 2:
            why = "their middle axis is fixed in neither part; put a body between, on a joint more"
            yield path, f"{part!r} leaves three turns, and of these none can be driven: {why}"
        unit = "m/s" if rates[rate].kind == "shift" else "rad/s"
        yield from fits(path, drive, unit)


def _no_rate(scene: SpatialScene, part: str, rate: str) -> str:
    rates = scene.joints[part].rates
    for name, freedom in rates.items():
        if freedom.name == rate:
            return f"{rate!r} is a coordinate; a drive prescribes its rate, '{part}.{name}'"
    if not rates:
        return f"{part!r} has no freedom with a name, and so no rate to prescribe"
    known = [f"{part}.{name}" for name in rates]
    return f"{part!r} has no rate {rate!r}{nearest(f'{part}.{rate}', known)}"
