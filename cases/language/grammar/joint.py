"""Joints as a case file writes them: the kind's word, and what the freedoms it leaves need."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

from pydantic import model_validator

from ...fields.friction_grammar import OF_PIN, OF_SLIDE
from ...fields.part import OneOf
from ...fields.words import wrong
from ...scene.joint import FREEDOMS, planar_joint
from .element import Element, element


class _Joint(Element):
    elsewhere: ClassVar[Mapping[str, str]] = {
        "damping": "among the `forces` there is a `torsion_damper` of a turn, and a `damper`",
        "stiffness": "among the `forces` there is a `torsion` spring of a turn, and a `spring`",
        **dict.fromkeys(
            ("stops", "limits", "range"),
            "where a turn ends stands among the `forces`: {stops: JOINT, low: -90 deg}",
        ),
    }

    @property
    def kind(self) -> str:
        """The word is the kind."""
        return self.word


class _NeverBrakes(_Joint):
    @model_validator(mode="before")
    @classmethod
    def _no_friction(cls, value: Any) -> Any:
        if isinstance(value, dict) and "dry_friction" in value:
            raise wrong("only a slide or a pin has `dry_friction`")
        return value


def _joint(kind: str) -> type[Element]:
    turns, shifts, swings = (
        any(freedom.kind == which for freedom in FREEDOMS[kind])
        for which in ("turn", "shift", "swing")
    )
    brakes = shifts != turns and not swings
    asked = {"kind": False, "along": shifts, "angle": not turns, "dry_friction": brakes}
    asked["length"] = swings
    return element(
        kind,
        planar_joint,
        base=_Joint if brakes else _NeverBrakes,
        without=[key for key, plays in asked.items() if not plays],
        needs=["along"] if shifts else [],
        typed={"dry_friction": (OF_SLIDE if shifts else OF_PIN) | None},
    )


KINDS = {kind: _joint(kind) for kind in FREEDOMS}
IN_SPACE = {
    "hinge": "in the plane it is `pin`",
    "revolute": "did you mean 'pin'?",
    "prismatic": "did you mean 'slide'?",
    "fixed": "did you mean 'weld'?",
    "rod": "did you mean 'distance'?",
    **dict.fromkeys(("ball", "universal", "freedoms"), "it joins parts in space (`space: 3`)"),
}
Joint = Annotated[Element, OneOf("joint", KINDS, IN_SPACE)]
