"""Starts by joints: only the coordinates that a joint has can be given, and their rates."""

from collections.abc import Iterator

from ...joint import SHIFT
from ...mistake import nearest
from ...scene import Scene
from ..parse import Finding, Parsed


def posed(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in starts by sound joints, and the shift of what is no joint."""
    left = scene.coordinates()
    for name, start in parsed.file.initial.items():
        if name not in scene.joints:
            if "shift" in start.model_fields_set:
                yield ("initial", name, "shift"), "only a joint that slides starts with a `shift`"
            continue
        kind = scene.joints[name].kind
        for key in (*start.given, *start.places):
            if key not in left[name]:
                yield ("initial", name, key), _unknown(name, kind, key, list(left[name]))


def _unknown(name: str, kind: str, key: str, known: list[str]) -> str:
    if not known:
        return f"{name!r} is a {kind} and leaves nothing that could be given"
    if key in SHIFT or key in ("angle", "omega"):
        return f"{name!r} is a {kind} and has no {key}; it starts by {' and '.join(known)}"
    return f"{name!r} is a {kind} and starts by {' and '.join(known)}{nearest(key, known)}"
