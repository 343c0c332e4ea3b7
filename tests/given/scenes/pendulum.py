"""A pendulum's case file, of which each line can be another."""

from typing import Any

_TEXT = """\
title: A bar swings
scene:
  points: {{O: [0, 0]}}
  bodies: {{rod: {{bar: {{mass: 1.0, length: {length}}}}}}}
  joints: {{hinge: {{pin: [ground.O, rod.start]}}}}
  forces: {forces}
initial: {{rod: {{angle: {angle}}}}}
duration: {duration}
samples: {samples}
step: {step}
allow: {allow}
{more}
"""


def pendulum(
    *,
    length: Any = 0.5,
    forces: str = "{}",
    angle: Any = 0.3,
    duration: Any = 1.0,
    samples: Any = 26,
    step: Any = 1.0e-3,
    allow: str = "{rod.angle: 1.0e-2}",
    more: str = "",
) -> str:
    """The text of a case file that is sound as it stands."""
    return _TEXT.format(
        length=length,
        forces=forces,
        angle=angle,
        duration=duration,
        samples=samples,
        step=step,
        allow=allow,
        more=more,
    )
