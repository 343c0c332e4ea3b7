"""Case files typed for hand-written systems that switch: each with its system's parameters."""

from pathlib import Path

from textmech.cases.case import Case

from .. import scenes

DISK = """\
{system}
parameters: {{m: 1.3, R: 0.25, mu: 0.4, beta: {beta}, v0: {v0}, w0: {w0}}}
drops_out: [m]
scene:
  incline: beta
  bodies: {{wheel: {{disk: {{mass: m, radius: R}}}}}}
  contacts: {{touch: {{between: [wheel, ground.floor], friction: mu}}}}
initial: {{wheel: {{x: 0, y: R, angle: 0, vx: -v0, vy: 0, omega: -w0}}}}
events: {{rolls: {{touch.slip: stays zero}}}}
allow: {{wheel.x: 1.0e-3, wheel.omega: 1.0e-2}}
"""
BLOCK = """\
{system}
parameters: {{m: 2, mu_s: {mu_s}, mu_k: {mu_k}, beta: {beta}, v0: {v0}}}
drops_out: [m]
scene:
  incline: beta
  bodies: {{block: {{particle: {{mass: m}}}}}}
  contacts: {{touch: {{between: [block, ground.floor], friction: {{static: mu_s, kinetic: mu_k}}}}}}
initial: {{block: {{x: 0, y: 0, vx: v0, vy: 0}}}}
events: {{stops: {{block.vx: stays zero}}}}
allow: {{block.x: 1.0e-3, block.vx: 1.0e-3}}
"""
BOUNCE = """\
{system}
parameters: {{m: 1.3, R: 0.25, e: {e}, y0: 1.25}}
drops_out: [m]
scene:
  bodies: {{wheel: {{disk: {{mass: m, radius: R}}}}}}
  contacts: {{touch: {{between: [wheel, ground.floor], friction: 0.4, restitution: e}}}}
initial: {{wheel: {{x: 0, y: y0, angle: 0, vx: 0, vy: 0, omega: 0}}}}
events: {{bounces: {{touch.gap: falls to zero}}}}
allow: {{wheel.y: 1.0e-3, wheel.vy: 1.0e-3}}
"""
_GUIDE = "guide: {slide: [ground.O, block.center], along: [1, 0], dry_friction: {STATIC, KINETIC}}"
_DRY = (
    _GUIDE.replace("STATIC", "static: {forward: Fs_plus, backward: Fs_minus}")
    .replace("KINETIC", "kinetic: {forward: F_plus, backward: F_minus}{smooth}")
    .replace("{", "{{")
    .replace("}", "}}")
    .replace("{{smooth}}", "{smooth}")
)
GROWING = f"""\
{{system}}
parameters: {{{{m: 1, b: 1, F_minus: 3, F_plus: 3, Fs_minus: 6, Fs_plus: 6{{more}}}}}}
scene:
  gravity: none
  points: {{{{O: [0, 0]}}}}
  bodies: {{{{block: {{{{particle: {{{{mass: m}}}}}}}}}}}}
  joints:
    {_DRY}
  forces: {{{{push: {{{{push: block.center, ramp: [-b, 0]}}}}}}}}
initial: {{{{block: {{{{x: 0, vx: 0}}}}}}}}
allow: {{{{block.x: 1.0e-3, block.vx: 1.0e-3}}}}
"""
SPRING = f"""\
{{system}}
parameters: {{{{m: 1, c: 2, u: 2, F_minus: 3, F_plus: 3, Fs_minus: 6, Fs_plus: 6{{more}}}}}}
scene:
  gravity: none
  points: {{{{O: [0, 0], hook: {{{{at: [1, 0], velocity: [u, 0]}}}}}}}}
  bodies: {{{{block: {{{{particle: {{{{mass: m}}}}}}}}}}}}
  joints:
    {_DRY}
  forces: {{{{spring: {{{{spring: [ground.hook, block.center], stiffness: c, rest_length: 1}}}}}}}}
initial: {{{{block: {{{{x: 0, vx: 0}}}}}}}}
allow: {{{{block.x: 1.0e-3, block.vx: 1.0e-3}}}}
"""
SHAKEN = f"""\
{{system}}
parameters: {{{{m: 1, A: 4, w: 5, F_minus: 2, F_plus: 1, Fs_minus: 3, Fs_plus: 1.5}}}}
scene:
  gravity: none
  points: {{{{O: [0, 0]}}}}
  bodies: {{{{block: {{{{particle: {{{{mass: m}}}}}}}}}}}}
  joints:
    {_DRY}
  forces:
    push: {{{{push: block.center, sine: {{{{amplitude: [A, 0], angular_frequency: w}}}}}}}}
initial: {{{{block: {{{{x: 0, vx: 0}}}}}}}}
allow: {{{{block.x: 1.0e-3, block.vx: 1.0e-3}}}}
"""
SMOOTH = ", smooth: {band: Delta, sharpness: A}"
BAND = ", Delta: 0.0005, A: 1.0e5"


# name → text, parameters of the text, duration, samples. What the smooth law does later than just
# after its first slip is in the certificates of the shipped cases.
WRITTEN: dict[str, tuple[str, str, dict[str, object], float, int]] = {
    "launched": (DISK, "sliding_disk", {"beta": 0, "v0": -3, "w0": 0}, 1.0, 26),
    "backspin": (DISK, "sliding_disk", {"beta": "0 deg", "v0": -3, "w0": -40}, 2.0, 26),
    "uphill": (DISK, "sliding_disk", {"beta": "10 deg", "v0": 3, "w0": 20}, 2.0, 51),
    "too steep": (DISK, "sliding_disk", {"beta": "60 deg", "v0": 0, "w0": 0}, 1.0, 26),
    "braking": (BLOCK, "sliding_block", {"mu_s": 0.4, "mu_k": 0.3, "beta": 0, "v0": 3}, 2.0, 26),
    "comes back": (
        BLOCK, "sliding_block", {"mu_s": 0.4, "mu_k": 0.3, "beta": "30 deg", "v0": -3}, 2.0, 26,
    ),
    "stays up": (
        BLOCK, "sliding_block", {"mu_s": 0.6, "mu_k": 0.5, "beta": "30 deg", "v0": -3}, 2.0, 26,
    ),
    "elastic": (BOUNCE, "bouncing_disk", {"e": 1}, 2.0, 26),
    "plastic": (BOUNCE, "bouncing_disk", {"e": 0}, 1.0, 26),
    "example 2.3": (GROWING, "growing_force", {"smooth": "", "more": ""}, 8.0, 41),
    "example 2.4": (SPRING, "dynamometer", {"smooth": "", "more": ""}, 10.0, 51),
    "example 2.3 smooth": (
        GROWING, "smooth_growing_force", {"smooth": SMOOTH, "more": BAND}, 6.4, 33,
    ),
    "example 2.4 smooth": (
        SPRING, "smooth_dynamometer", {"smooth": SMOOTH, "more": BAND}, 2.0, 11,
    ),
    "drift": (SHAKEN, "anisotropic_drift", {"smooth": ""}, 2.5, 26),
}  # fmt: skip


def text(name: str) -> tuple[str, str]:
    """Scene and tail of the file."""
    scene, system, parameters, duration, samples = WRITTEN[name]
    filled = scene.format(system=f"system: {system}", **parameters)
    return filled, scenes.tail(duration, samples)


def case(tmp_path: Path, name: str) -> Case:
    """The case, answered by its hand-written system."""
    scene, end = text(name)
    return scenes.typed(tmp_path, scene, tail=end)


def generated(tmp_path: Path, name: str) -> Case:
    """The same scene, to be answered by the generated mechanism alone."""
    scene, end = text(name)
    scene = scene.split("\n", 1)[1].replace("drops_out: [m]\n", "")
    return scenes.typed(tmp_path, scene, tail=end)
