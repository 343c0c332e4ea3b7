"""A bar that stands on its end or falls on it."""

from pathlib import Path

from textmech.cases.case import Case

from . import scenes

ROD = """\
scene:
  bodies: {{rod: {{bar: {{mass: 1, length: 1}}}}}}
  contacts: {{tip: {{between: [rod.start, ground.floor], friction: {mu}, restitution: {e}}}}}
initial: {{rod: {{start: [0, {y}], angle: 60 deg, vx: {vx}, vy: {vy}, omega: 0}}}}
allow: {{rod.y: 1.0e-3, rod.angle: 1.0e-3}}
"""
FALLS = "events: {lands: {tip.gap: falls to zero}}\n"


def rod(tmp_path: Path, *, unsaid: bool = False, **changed: float) -> Case:
    """The case, with some of mu, e, y, vx, vy not 0; `unsaid`: its landing is not announced."""
    text = ROD.format(**{"mu": 0, "e": 0, "y": 0, "vx": 0, "vy": 0, **changed})
    text += FALLS if changed.get("y", 0) > 0 and not unsaid else ""
    return scenes.typed(tmp_path, text, tail=scenes.tail(0.15, 16))
