"""A scene as a case file writes it: in the plane, or in space where it says so."""

from collections.abc import Callable, Mapping
from typing import Annotated, Any, ClassVar

from pydantic import Field, Tag, create_model

from ...fields import vector
from ...fields.field import In, Space
from ...fields.gravity import Gravity
from ...fields.part import Angle, Direction, Made, Name, OneOf, Part, Point, Position, plain_or_map
from ...fields.signal import Signal
from ...fields.signal_grammar import Moving, law_fields
from ...fields.text import Word
from ...fields.words import wrong
from ...scene import plane, point, shape, solid
from ...scene.constraint import CONSTRAINTS, Edge
from ...scene.forces.force import FORCES
from ...scene.frame import SPACE
from ...scene.point import anchor
from .contact import Contact, Rolling
from .drive import Driven, Rate
from .element import Element, element, numbers
from .element import keys as keys_of
from .joint import Joint, SpatialJoint

# Bodies as a case file writes them: a shape, and named points beside it.


class Shaped(Part):
    """A shape's word with its measures."""

    word: ClassVar[str]
    makes: ClassVar[Callable[..., Any]]

    def named(self, name: str) -> Any:
        """The body."""
        return type(self).makes(name=name, **dict(getattr(self, self.word)))

    @property
    def own_points(self) -> tuple[str, ...]:
        """The points that the shape has by itself."""
        points: dict[str, Any] = {"points": {}} if "points" in keys_of(type(self).makes) else {}
        body = type(self).makes(name="", **points, **dict(getattr(self, self.word)))
        return tuple(body.points)


_POINTS = "points of the body, in its axes from its centre of mass"


class WithPoints(Shaped):
    """A body on which points can be named."""

    points: dict[Name, Position] = Field({}, description=_POINTS)

    def named(self, name: str) -> Any:
        measures = dict(getattr(self, self.word))
        return type(self).makes(name=name, points=self.points, **measures)


class WithSpatialPoints(WithPoints):
    """A body in space on which points can be named; the axle that it may have is that of a rim."""

    points: dict[Name, vector.Position] = Field(  # pyright: ignore[reportIncompatibleVariableOverride]
        {}, description=_POINTS
    )

    def model_post_init(self, context: object) -> None:
        measures = getattr(self, self.word)
        if getattr(measures, "axle", None) is not None and measures.radius is None:
            raise wrong("has an `axle` and no `radius`: the axle is that of a rim")


def body(
    word: str,
    makes: Callable[..., Any],
    *,
    with_points: type[Shaped] = WithPoints,
    prefix: str = "",
) -> type[Shaped]:
    """The model of a body, written as its shape's word with its measures."""
    base = with_points if "points" in keys_of(makes) else Shaped
    inner = numbers(makes, without=("name", "points"), prefix=prefix)
    measures: dict[str, Any] = {word: (inner, ...)}
    model = create_model(f"{prefix}{word.capitalize()}Body", __base__=base, **measures)
    model.word, model.makes = word, makes
    return model


BODY_KINDS: dict[int, dict[str, type[Shaped]]] = {
    2: {word: body(word, makes) for word, makes in shape.SHAPES.items()},
    3: {
        word: body(word, makes, with_points=WithSpatialPoints, prefix="Spatial")
        for word, makes in solid.SHAPES.items()
    },
}
"""By the dimension of the frame, the model of each shape's word."""
ALIKE = {
    **dict.fromkeys(("rod", "link", "beam"), "did you mean 'bar'?"),
    **dict.fromkeys(("box", "rectangle"), "did you mean 'block'?"),
    **dict.fromkeys(("point", "mass", "point_mass"), "did you mean 'particle'?"),
}
"""For each word that others use for a shape: the question whether ours is meant."""
ROUND = {
    2: dict.fromkeys(("ball", "circle", "wheel"), "did you mean 'disk'?"),
    3: {"ball": "did you mean 'sphere'?", "wheel": "did you mean 'disk'?"},
}
Body = Annotated[Shaped, OneOf("shape", BODY_KINDS[2], ALIKE | ROUND[2])]
SpatialBody = Annotated[Shaped, OneOf("shape", BODY_KINDS[3], ALIKE | ROUND[3])]


# Constraints that cannot be integrated, as a case file writes them.


_ALONG = Annotated[Direction, Field(description="in the axes of the body")]


class Blade(Part):
    """A blade at a point of a body: the point does not move across its heading."""

    edge: Point
    along: vector.Direction = Field(
        description="in the axes of the body; its shadow is the heading"
    )
    height: Annotated[str, Word("height", ("kept",))] | None = Field(
        None, description="`kept`: the point stays as high as it starts"
    )

    def named(self, name: str) -> Edge:
        """The blade."""
        return Edge(name, anchor(self.edge), self.along, kept=self.height is not None, frame=SPACE)


CONSTRAINT_KINDS: dict[int, dict[str, type[Part]]] = {
    2: {
        word: element(word, noun, without=("kept", "frame"), typed={"along": _ALONG})
        for word, noun in CONSTRAINTS.items()
    },
    3: {"edge": Blade},
}
"""By the dimension of the frame."""
Constraint = Annotated[Element, OneOf("constraint", CONSTRAINT_KINDS[2])]
SpatialConstraint = Annotated[Blade, OneOf("constraint", CONSTRAINT_KINDS[3])]


# The ground as a case file writes it: points, be it that they move, and planes to stand on.


Velocity = tuple[Annotated[float, In("m/s")], Annotated[float, In("m/s")]]
_laws: dict[str, Any] = law_fields("Moving", "m", 2, Moving.laws)
_moves = create_model("Moves", __base__=Moving, __doc__=Moving.__doc__, **_laws)
Moves = Annotated[Signal, Made(_moves, lambda written: written.signal)]


class DrivenPoint(Part):
    """A point of the ground that moves, evenly or by a law in time."""

    at: Position
    velocity: Velocity | None = None
    moves: Moves | None = Field(None, description="away from `at`, by a law in time")

    def model_post_init(self, context: object) -> None:
        if (self.velocity is None) == (self.moves is None):
            raise wrong("needs exactly one of velocity, moves")


def _point(written: DrivenPoint) -> point.GroundPoint:
    return point.GroundPoint(written.at, written.velocity or (0.0, 0.0), written.moves)


GroundPoint = Annotated[
    Annotated[point.GroundPoint, Made(Position, point.GroundPoint), Tag("<plain>")]
    | Annotated[point.GroundPoint, Made(DrivenPoint, _point), Tag("<map>")],
    plain_or_map(),
]


class SpatialDrivenPoint(Part):
    """Where it starts and how it moves."""

    at: vector.Position
    velocity: vector.Velocity


def _spatial(at: vector.Position, velocity: vector.Velocity = (0.0, 0.0, 0.0)) -> point.GroundPoint:
    return point.GroundPoint(at, velocity)  # type: ignore[arg-type]  # as many as the frame's axes


SpatialGroundPoint = Annotated[
    Annotated[point.GroundPoint, Made(vector.Position, _spatial), Tag("<plain>")]
    | Annotated[
        point.GroundPoint,
        Made(SpatialDrivenPoint, lambda written: _spatial(**dict(written))),
        Tag("<map>"),
    ],
    plain_or_map(),
]


class Plane(Part):
    """A straight line, seen from the side, on which bodies stand and slide."""

    at: Position = Field(description="any of its points")
    normal: Direction = Field(description="points away from it, to where bodies are")

    def named(self, name: str) -> plane.Plane:
        """The plane."""
        return plane.Plane(name, self.at, self.normal)


# Forces as a case file writes them; each says itself what that is.


_PLANE: dict[str, type[Element]] = {word: element(word, noun) for word, noun in FORCES.items()}
_SPRING = element("spring", FORCES["spring"], without=("only",), axes=3)
_SPRING.elsewhere = {"only": "a spring in space acts on both sides"}
_AS_IN_THE_PLANE = ("damper", "torsion", "torsion_damper", "motor")
_ALONG_THREE_AXES = ("push", "torque")
FORCE_KINDS: dict[int, dict[str, type[Element]]] = {
    2: _PLANE,
    3: {
        "spring": _SPRING,
        **{word: _PLANE[word] for word in _AS_IN_THE_PLANE},
        **{word: element(word, FORCES[word], axes=3) for word in _ALONG_THREE_AXES},
    },
}
"""By the dimension of the frame."""
NOT_IN_SPACE = {
    "couple": "in space a torque between two bodies is a `motor` about a hinge",
    "rope": "in space nothing comes taut or slackens",
    "stops": "in space nothing is struck",
}
Force = Annotated[Element, OneOf("force", FORCE_KINDS[2])]
SpatialForce = Annotated[Element, OneOf("force", FORCE_KINDS[3], NOT_IN_SPACE)]


GRAVITY = "`none` (a scene seen from above), how strong it is [m/s²], or a vector of its own"
INCLINE = "turns gravity, never the ground: x points down the slope"


NOT_THERE: Mapping[str, str] = dict.fromkeys(
    ("gears", "pulleys", "meshes", "fluids"), "no scene has gears, pulleys, meshes or fluids"
)


class Scene(Part):
    """Bodies and what joins, touches and drives them."""

    elsewhere = {  # noqa: RUF012  # a ClassVar of Part
        "stops": "each is one of the `forces`: NAME: {stops: JOINT, low: -90 deg}",
        **NOT_THERE,
    }

    space: Annotated[int, Space()] | None = Field(None, description="3: a scene in space")
    gravity: Gravity | None = Field(None, description=GRAVITY)
    seen: Annotated[str, Word("view", ("from above",))] | None = Field(
        None, description="of gravity only what points down the incline is left"
    )
    incline: Angle | None = Field(None, description=INCLINE)
    points: dict[Name, GroundPoint] = Field({}, description="points of the ground")
    planes: dict[Name, Plane] = Field({}, description="planes of the ground, beside the floor")
    bodies: dict[Name, Body]
    joints: dict[Name, Joint] = Field({})
    constraints: dict[Name, Constraint] = Field({}, description="that cannot be integrated")
    contacts: dict[Name, Contact] = Field({})
    forces: dict[Name, Force] = Field({})
    drive: dict[Rate, Driven] = Field({}, description="prescribed rates of joints' freedoms")


class SpatialScene(Part):
    """Bodies in space, and what joins, touches and drives them."""

    elsewhere = NOT_THERE

    space: Annotated[int, Space()] = 3
    gravity: vector.Gravity | None = Field(None, description=GRAVITY)
    incline: Angle | None = Field(None, description=f"about y; {INCLINE}")
    points: dict[Name, SpatialGroundPoint] = Field({}, description="points of the ground")
    bodies: dict[Name, SpatialBody]
    joints: dict[Name, SpatialJoint] = Field({})
    constraints: dict[Name, SpatialConstraint] = Field({}, description="that cannot be integrated")
    contacts: dict[Name, Rolling] = Field({})
    forces: dict[Name, SpatialForce] = Field({})
    drive: dict[Rate, Driven] = Field({}, description="prescribed rates of joints' freedoms")
