"""cases/README.md says of space what its grammar and its table of quantities say."""

import re
from inspect import signature
from pathlib import Path

from textmech.cases import find
from textmech.cases.language.grammar import joint
from textmech.cases.language.grammar import scene as words
from textmech.cases.language.grammar.contact import Rolling
from textmech.cases.language.grammar.scene import SpatialScene as Words
from textmech.cases.language.grammar.start import SpatialStart, Turn
from textmech.cases.load import load
from textmech.cases.scene import Anchor, Scene, Signal, Spring, Torsion, frame, solid
from textmech.cases.scene.constraint import Edge
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.joint import Freedom, Joint
from textmech.cases.scene.quantity import table

README = Path(find.__file__).with_name("README.md").read_text(encoding="utf-8")
SPACE = README.partition("## Space\n")[2].partition("## Variants\n")[0]
A, B = Anchor("ground", "O"), Anchor("body", "point")


def test_example_loads(tmp_path: Path) -> None:
    path = tmp_path / "example.yaml"
    path.write_text(re.findall(r"```yaml\n(.*?)```", SPACE, flags=re.DOTALL)[0])
    (case,) = load(path)
    assert case.scene.frame.dimension == 3


def test_every_key_is_explained() -> None:
    code = re.findall(r"```yaml\n(.*?)```|`([^`]+)`", README, flags=re.DOTALL)
    said = set(re.findall(r"[a-zA-Z_]+", " ".join(block + word for block, word in code)))
    models = [Words, Rolling, SpatialStart, Turn, joint.FreeShift, joint.FreeTurn]
    for kinds in (
        words.BODY_KINDS[3],
        joint.KINDS[3],
        words.CONSTRAINT_KINDS[3],
        words.FORCE_KINDS[3],
    ):
        models += kinds.values()
    for model in models:
        assert set(model.model_fields) <= said, model
    for noun in solid.SHAPES.values():
        assert set(signature(noun).parameters) - {"name"} <= said, noun


def test_quantities() -> None:
    tensor = (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    freedoms = (
        Freedom.shift((1.0, 0.0, 0.0), "s"),
        Freedom.turn((0.0, 0.0, 1.0), "theta"),
    )
    body = solid.rigid(name="body", mass=1, inertia=tensor, points={"point": (0.0, 0.0, 0.0)})
    one = Signal("constant", (1.0,))
    scene = Scene(
        frame=frame.SPACE,
        gravity=(0.0, 0.0, 0.0),
        points={},
        bodies={"body": body},
        joints={"joint": Joint("joint", "freedoms", A, B, freedoms, frame=frame.SPACE)},
        contacts={"contact": spatial_contact("contact", Anchor("body", "center"), 1.0, rim=True)},
        forces={
            "line": Spring("line", A, B, 1.0, 1.0),
            "torsion": Torsion("torsion", "joint.theta", 1.0, 0.0),
        },
        constraints={
            "constraint": Edge("constraint", B, (1.0, 0.0, 0.0), kept=True, frame=frame.SPACE)
        },
        drives={"joint.s_dot": one, "joint.theta_dot": one},
    )
    rows = re.findall(r"^\| (`[a-z]+\..*?) \| (.*?) \|", SPACE, flags=re.MULTILINE)
    said = {name: unit for names, unit in rows for name in re.findall(r"`(.*?)`", names)}
    known = {name: q.unit for name, q in table(scene).items() if ".center." not in name}
    assert said == known
