"""MJCF models: random ones of all that the equations read, and public ones."""

from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from random import Random

JOINTS = (
    (), ("hinge",), ("slide",), ("ball",), ("hinge", "hinge"), ("slide", "hinge", "slide"),
    ("hinge", "ball"), ("hinge", "slide"),
)  # fmt: skip
ACTUATORS = (
    '<motor {at} gear="-2.5" ctrlrange="-1 .5"/>',
    '<position {at} kp="30" kv="2" forcerange="-4 3"/>',
    '<velocity {at} kv="3"/>',
    '<general {at} gaintype="affine" gainprm="1 .5 .2" biastype="affine" biasprm=".1 -2 -.3" '
    'group="3"/>',
)
FLAGS = ("", 'gravity="disable"', 'spring="disable"', 'damper="disable"', 'clampctrl="disable"')
TENDON = """\
<fixed name="t" stiffness="4" damping=".5" armature=".03" springlength="-.1 .2">
  <joint joint="{0}" coef=".7"/><joint joint="{1}" coef="-.4"/></fixed>"""


def public_models() -> list[Path]:
    """Returns the models that gymnasium ships; it is not imported."""
    spec = find_spec("gymnasium")
    folders = (spec.submodule_search_locations or []) if spec else []
    return sorted(file for f in folders for file in Path(f).glob("envs/mujoco/assets/*.xml"))


def random_model(seed: int) -> str:
    """Returns a model's text: three trees, of which the first is free; the same for a seed."""
    made = _Made(Random(seed))
    trees = "".join(made.body(0, free=k == 0) for k in range(3))
    actuators = [made.random.choice(ACTUATORS).format(at=f'joint="{n}"') for n in made.joints[:4]]
    tendon = next((TENDON.format(*pair) for pair in made.pairs()), "")
    actuators += ['<position tendon="t" kp="5" gear="2"/>'] if tendon else []
    off = made.random.choice(("", 'actuatorgroupdisable="3"'))
    return f"""\
<mujoco><compiler angle="radian"/>
<option gravity="{made.vector(10)}" {off}><flag {made.random.choice(FLAGS)}/></option>
<worldbody><body name="held" mocap="true" pos="1 1 1"/>{trees}</worldbody>
<tendon>{tendon}</tendon><actuator>{"".join(actuators)}</actuator></mujoco>"""


class _Made:
    """What is made of one sequence of random numbers."""

    def __init__(self, random: Random) -> None:
        self.random, self.count = random, 0
        self.joints: list[str] = []  # hinges and slides

    def pairs(self) -> Iterator[tuple[str, str]]:
        """Yields two joints of one body: a tendon's armature couples no branches then."""
        for a in self.joints:
            yield from ((a, b) for b in self.joints if a[:-1] == b[:-1] and a < b)

    def vector(self, size: float) -> str:
        return " ".join(f"{self.random.uniform(-size, size):.4f}" for _ in range(3))

    def body(self, depth: int, *, free: bool = False) -> str:
        name, self.count = f"b{self.count}", self.count + 1
        a, b = sorted(self.random.uniform(0.01, 0.05) for _ in range(2))
        c = self.random.uniform(b, a + b)
        inertia = (
            f'<inertial pos="{self.vector(0.1)}" euler="{self.vector(1)}" '
            f'mass="{self.random.uniform(0.1, 2):.4f}" diaginertia="{a:.5f} {b:.5f} {c:.5f}"/>'
        )
        kinds = ("free",) if free else self.random.choice(JOINTS)
        joints = "".join(self.joint(f"{name}_{k}", kind) for k, kind in enumerate(kinds))
        below = self.random.choice((0, 1, 2)) if depth < 3 else 0
        children = "".join(self.body(depth + 1) for _ in range(below))
        return (
            f'<body name="{name}" pos="{self.vector(0.3)}" euler="{self.vector(1)}" '
            f'gravcomp="{self.random.choice((0, 0, 1, 0.4))}">{inertia}{joints}{children}</body>'
        )

    def joint(self, name: str, kind: str) -> str:
        some = self.random.choice
        words = (
            f'name="{name}" type="{kind}" stiffness="{some((0, 2, 5))}" damping="{some((0, 0.3))}"'
        )
        words += f' armature="{some((0, 0.02))}"'
        if kind in ("hinge", "slide"):
            self.joints.append(name)
            words += f' pos="{self.vector(0.1)}" axis="{self.vector(1)}" ref="{some((0, 0.4))}"'
            words += f' springref="{some((0, -0.3))}" actuatorgravcomp="{some(("true", "false"))}"'
            words += some(("", ' actuatorfrcrange="-.6 .5"'))
        elif kind == "ball":
            words += f' pos="{self.vector(0.1)}"'
        return f"<joint {words}/>"
