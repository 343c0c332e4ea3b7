"""Every mistake a case file can have: its place, its field, and what is said about it."""

import os
import re
from collections.abc import Iterable
from pathlib import Path

import pytest
from given.otherwise import otherwise

from textmech.cases.fields import words as wording
from textmech.cases.find import find
from textmech.cases.language import parse
from textmech.cases.load import load
from textmech.cases.mistake import SHOWN, CaseError, nearest
from textmech.cases.scene.forces import limit

SYSTEMS = {"pendulum": ("m", "l", "phi0"), "wheel": ("R",)}
ENGINES = {"mujoco": ("shipped", "tuned"), "pymunk": ("shipped", "tuned"), "broken": None}

SOUND = """\
title: A bar and a wheel
source: {exercise: "2.3", equations: ["2.34"]}
system: pendulum
parameters: {m: 1.2, l: 0.8 m, phi0: 30 deg}
drops_out: [m]
scene:
  points: {O: [0, 0]}
  bodies:
    bar: {bar: {mass: m, length: l}, points: {P: [0.1, 0]}}
    wheel: {disk: {mass: 2.0, radius: 0.25}}
    ball: {particle: {mass: 0.5}}
  joints:
    hinge: {pin: [ground.O, bar.start]}
    guide: {slide: [ground.O, ball.center], along: [0, 2], dry_friction: {static: 6, kinetic: 4}}
  contacts:
    touch: {between: [wheel, ground.floor], friction: 0.5, ideal: rolling}
  forces:
    coil: {spring: [bar.end, wheel.center], stiffness: 40.0, rest_length: 0.2}
    oil: {damper: [bar.end, wheel.center], damping: 0.1}
    hand: {push: wheel.center, constant: [1.0, 0]}
    motor: {torque: bar, sine: {amplitude: 1.0, angular_frequency: 20 rpm}}
initial: {bar: {angle: phi0}, wheel: {x: 1.0}}
near: {ball: {y: 0.1}}
duration: 1.0
samples: 26
step: {mujoco: 1.0e-3, pymunk: 1.0e-4}
allow: {bar.angle: 1.0e-2, bar.P.x: 1.0e-3, touch.slip: unknown, halt.time: 1.0e-3}
reach:
  mujoco: {bar.angle: 1.0e-6}
deviates:
  pymunk.shipped: {bar.P.x: {limit: 2.0e-3, because: soft}}
events: {halt: {guide.slip: stays zero}, top: {ball.vy: falls to zero}}
"""

EACH = re.findall(
    r"^- (.*)\n\+ (.*)\n(\d+:\d+): ([^:]*): (.*)$",
    Path(__file__).with_name("mistakes.txt").read_text(encoding="utf-8"),
    flags=re.MULTILINE,
)


def mistakes(tmp_path: Path, text: str | bytes) -> CaseError:
    path = tmp_path / "case.yaml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(CaseError) as caught:
        load(path, systems=SYSTEMS, engines=ENGINES)
    return caught.value


def test_sound(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(SOUND)
    assert [case.name for case in load(path, systems=SYSTEMS, engines=ENGINES)] == ["case"]


def test_table_is_read_whole() -> None:
    table = Path(__file__).with_name("mistakes.txt").read_text(encoding="utf-8")
    assert len(EACH) == table.count("\n- ") > 80


@pytest.mark.parametrize(("old", "new", "place", "field", "what"), EACH)
def test_each(tmp_path: Path, old: str, new: str, place: str, field: str, what: str) -> None:
    old, new = old.replace(r"\n", "\n"), new.replace(r"\n", "\n")
    assert SOUND.count(old) == 1
    error = mistakes(tmp_path, SOUND.replace(old, new))
    assert [(f"{m.line}:{m.column}", m.where, m.what) for m in error.mistakes] == [
        (place, field, what)
    ]


DISK, SPOKES = "{disk: {mass: 2.0, radius: 0.25}}", "length: 0.3, mass: 2, inertia: 0.1}}"
BESIDE = [
    (DISK, "{spokes: {number: phi0, " + SPOKES, "a plain number was", "only a disk rolls"),
    (DISK, "{spokes: {number: 2, " + SPOKES, "a whole number from 3", "only a disk rolls"),
    (DISK, "{spokes: {number: m, " + SPOKES, "a whole number from 3", "only a disk rolls"),
    ("length: l}, points: {P:", "length: x}, points: {Q:", "unknown parameter 'x'", "'bar.P.x'"),
    (
        "coil: {spring: [bar.end, wheel.center], stiffness: 40.0",
        "coil: {spring: [bar.ende, wheel.center], stiffness: -1",
        "must be positive, is -1",
        "'ende'",
    ),
    (
        "[wheel, ground.floor], friction: 0.5",
        "[wheel, ground.wall], friction: -1",
        "must not be negative, is -1",
        "'ground.wall'",
    ),
    ("{mujoco: 1.0e-3, py", "{mujoco: -1, bullet: 1.0e-3, py", "must be positive", "'bullet'"),
    ("mujoco: {bar.angle: 1.0e-6}", "mujoco: {bar.angel: -1}", "must be positive", "'bar.angel'"),
]


@pytest.mark.parametrize(("old", "new", "number", "other"), BESIDE)
def test_a_wrong_number_hides_no_other_mistake(
    tmp_path: Path, old: str, new: str, number: str, other: str
) -> None:
    """It is as a number of which nothing is known."""
    assert SOUND.count(old) == 1
    said = [mistake.what for mistake in mistakes(tmp_path, SOUND.replace(old, new)).mistakes]
    assert any(number in what for what in said)
    assert any(other in what for what in said)


@pytest.mark.mutant("a wrong number that hides what else is wrong beside it")
def test_a_wrong_number_that_hides_others_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parse, "_without_number", lambda data, path: (data, False))
    for old, new, _, other in BESIDE:
        said = [mistake.what for mistake in mistakes(tmp_path, SOUND.replace(old, new)).mistakes]
        assert not any(other in what for what in said), other


def test_a_wrong_number_and_a_mistaken_body_are_told_together(tmp_path: Path) -> None:
    text = SOUND.replace("{bar: {mass: m, length: l}", "{bar: {mass: m}")
    text = text.replace("damping: 0.1", "damping: .nan")
    assert [(m.where, m.what) for m in mistakes(tmp_path, text).mistakes] == [
        ("scene.bodies.bar.bar.length", "missing key 'length'"),
        ("scene.forces.oil.damping", "must be finite, is nan"),
    ]


def test_what_no_scene_has_is_told(tmp_path: Path) -> None:
    text = SOUND.replace("  contacts:\n", "  pulleys: {p: 1}\n  contacts:\n")
    (told,) = mistakes(tmp_path, text).mistakes
    assert told.what == "unknown key 'pulleys'; no scene has gears, pulleys, meshes or fluids"


def test_a_step_of_an_unknown_engine_is_asked_for_nothing_else(tmp_path: Path) -> None:
    text = SOUND.replace("{mujoco: 1.0e-3, pymunk: 1.0e-4}", "{mujoco: 1.0e-3, foo: 3}")
    assert [m.where for m in mistakes(tmp_path, text).mistakes] == ["step.foo"]


def test_a_wrong_drag_of_a_mistaken_body_is_told(tmp_path: Path) -> None:
    text = """\
title: A sled that slows down
scene:
  bodies: {sled: {bar: {mass: 1}}}
  forces: {snow: {drag: sled.center, coefficient: .nan, exponent: 2}}
initial: {sled: {x: 0, y: 0, angle: 0, vx: 1}}
duration: 1
samples: 3
allow: {sled.x: 1}
"""
    said = {mistake.where for mistake in mistakes(tmp_path, text).mistakes}
    assert {"scene.bodies.sled.bar.length", "scene.forces.snow.coefficient"} <= said


def test_all_at_once(tmp_path: Path) -> None:
    """A broken part hides no other, and drags nothing along: bar's own quantities are not named."""
    text = SOUND.replace("bar: {bar: {mass: m", "bar: {bar: {mass: 0 kg")
    text = text.replace("touch.slip: unknown", "touch.slp: unknown")
    text = text.replace("[1.0, 0]", "[1.0]")
    text = text.replace("slide: [ground.O, ball.center]", "slide: [ground.O, boll.center]")
    text = text.replace("samples: 26", "samples: 27").replace("mujoco: 1.0e-3", "mujoco: 1 ms")
    found = [(m.where, m.what) for m in mistakes(tmp_path, text).mistakes]
    assert [where for where, _ in found] == [
        "scene.bodies.bar.bar.mass",
        "scene.joints.guide.slide.1",
        "scene.forces.hand.constant",
        "samples",
        "allow.touch.slp",
    ]


def test_message_shows_the_line(tmp_path: Path) -> None:
    error = mistakes(tmp_path, SOUND.replace("duration: 1.0", "duration: 0.8 m"))
    assert str(error) == (
        f"{tmp_path / 'case.yaml'}:24:1: duration: is '0.8 m', but s was expected\n"
        "    duration: 0.8 m\n"
        "    ^"
    )


def test_a_mistaken_parameter_is_named_once(tmp_path: Path) -> None:
    error = mistakes(tmp_path, SOUND.replace("l: 0.8 m", "l: 0.8 mm m m q"))
    assert [m.where for m in error.mistakes] == ["parameters.l"]


VARIANTS = """variants:
  heavy: {parameters: {m: 2.0}}
  long: {parameters: {l: -1}, duration: 0}
"""


def test_variants(tmp_path: Path) -> None:
    """An overlay's mistake is on its line; what it spoils elsewhere names it; the rest is once."""
    text = SOUND.replace("radius: 0.25", "radius: 0")
    found = mistakes(tmp_path, text + VARIANTS).mistakes
    assert [(m.line, m.where, m.what) for m in found] == [
        (9, "scene.bodies.bar.bar.length", "must be positive, is -1 (l) (variant 'long')"),
        (10, "scene.bodies.wheel.disk.radius", "must be positive, is 0"),
        (35, "duration", "must be positive, is 0 (variant 'long')"),
    ]


@pytest.mark.parametrize(
    ("variants", "field", "what"),
    [
        ("{a: {title: b}}", "variants.a.title", "unknown key 'title' in a variant"),
        ("{a: 3}", "variants.a", "should be a map of keys, is the number 3"),
        ("{a b: {}}", "variants.a b", "'a b' is not a name"),
        ("[a]", "variants", "should be a map of names, is a list"),
    ],
)
def test_no_variant(tmp_path: Path, variants: str, field: str, what: str) -> None:
    (found,) = mistakes(tmp_path, f"{SOUND}variants: {variants}\n").mistakes
    assert (found.line, found.where) == (33, field)
    assert found.what.startswith(what)


BILLION = "a: &a [1, 1]\nb: &b [*a, *a]\nc: &c [*b, *b]\nd: [*c, *c]\n"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("content", "what"),
    [
        (b"", "is empty"),
        (b"# nothing\n", "is empty"),
        (b"just text", "should be a map of keys"),
        (b"- 1\n- 2\n", "should be a map of keys"),
        (b"title: [1\n", "not YAML: "),
        (b"title: '\n", "not YAML: "),
        (b'title: "\\U99999999"\n', "not YAML: "),
        (b"a: \x01\n", "the character \\x01 cannot stand in YAML"),
        ("a: 1 # b\u2029c: 2\n".encode(), "the character \\u2029 ends a line for some"),
        ("a: b\x85c\n".encode(), "the character \\x85 ends a line for some and not for others"),
        (b"title: \xff\xfe\n", "is not UTF-8 text: here is the byte 0xff"),
        (b"title: x\n---\ntitle: y\n", "a second document"),
        (b"title: " + b"x" * 1_000_000, "is larger than 200 kB"),
        (b"x: " + b"[" * 10_000, "is nested deeper than 20 levels"),
        (b"x: &x [*x]\n", "anchor '&x'"),
        (b"a: 1\n<<: *a\n", "alias '*a'"),
        (BILLION.encode(), "anchor '&a'"),
        (b"!!python/object:os.system {a: b}\n", "tag 'tag:yaml.org,2002:python/object:os.system'"),
        (b"? [a, b]\n: 1\n", "a key should be a word"),
    ],
)
def test_no_case_at_all(tmp_path: Path, content: bytes, what: str) -> None:
    assert mistakes(tmp_path, content).mistakes[0].what.startswith(what)


NEW_BODY = """\
title: a body that turns
scene:
  bodies: {b: {rigid: {mass: 1, inertia: INERTIA}}}
initial: {b: {x: 0, y: 0, angle: 0}}
duration: 1
samples: 11
allow: {b.x: 1.0e-3}
"""


@pytest.mark.parametrize(
    ("content", "place"),
    [
        (b"\xff", (1, 1)),
        ("title: é\nscene: ".encode() + b"\xe9", (2, 8)),
        (b"\xef\xbb\xbftitle: \xff", (1, 8)),
        (b"title: a\r\nscene: \x07", (2, 8)),
        (b"title: a\rscene: \x07", (2, 8)),
        (b"title: a\rscene: \xff", (2, 8)),
        ("title: a\rb: 1 # c\u2028d: 2\n".encode(), (2, 9)),  # an end of YAML 1.1 alone
        (b"a: 1\n\nb: [\x00]", (3, 5)),
    ],
)
def test_what_is_no_text_has_a_place(
    tmp_path: Path, content: bytes, place: tuple[int, int]
) -> None:
    (mistake,) = mistakes(tmp_path, content).mistakes
    assert (mistake.line, mistake.column) == place


@pytest.mark.parametrize("inertia", ["0", "0.0 kg m^2"])
def test_what_turns_without_inertia_is_told_to_be_a_particle(tmp_path: Path, inertia: str) -> None:
    content = NEW_BODY.replace("INERTIA", inertia).encode()
    (mistake,) = mistakes(tmp_path, content).mistakes
    assert str(mistake.where) == "scene.bodies.b.rigid.inertia"
    assert mistake.what.startswith("must be positive, is ")
    assert mistake.what.endswith(
        ": what turns without inertia has no equation of its turn; a point mass is a `particle`"
    )


def test_no_file(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="is a directory; a case is one YAML file"):
        load(tmp_path)
    with pytest.raises(CaseError, match=r"nowhere\.yaml: no such file"):
        load(tmp_path / "nowhere.yaml")


def test_find(tmp_path: Path) -> None:
    own = tmp_path / "own.yaml"
    own.write_text(SOUND)
    assert [path.name for path in find(["four_bar", str(own)])] == ["four_bar.yaml", "own.yaml"]
    with pytest.raises(CaseError) as caught:
        find(["four_bra", str(tmp_path), str(tmp_path / "for_bar.yaml"), str(tmp_path / "own")])
    said = {m.file: m.what for m in caught.value.mistakes}
    assert said["four_bra"] == "no such case; did you mean 'four_bar'?"
    assert said[str(tmp_path)] == "is a directory; a case is one YAML file"
    assert said[str(tmp_path / "for_bar.yaml")] == "no such file; did you mean 'four_bar'?"
    assert said[str(tmp_path / "own")] == f"no such case; did you mean {str(own)!r}?"


def test_what_is_there_and_is_no_file(tmp_path: Path) -> None:
    pipe, loop = tmp_path / "pipe.yaml", tmp_path / "loop.yaml"
    os.mkfifo(pipe)
    loop.symlink_to(loop)
    with pytest.raises(CaseError) as caught:
        find([str(pipe), str(loop)])
    said = {m.file: m.what for m in caught.value.mistakes}
    assert said == {str(pipe): "is no file", str(loop): "is no file: a link that leads nowhere"}
    with pytest.raises(CaseError, match=r"pipe\.yaml: is no file"):
        load(pipe)


def test_of_an_engine_that_cannot_be_imported_no_setting_is_known(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(SOUND.replace("pymunk.shipped", "broken.anything"))
    assert [case.name for case in load(path, systems=SYSTEMS, engines=ENGINES)] == ["case"]
    path.write_text(SOUND.replace("pymunk.shipped", "nobody.anything"))
    assert [case.name for case in load(path, systems=SYSTEMS)] == ["case"]  # nobody asks


@pytest.mark.mutant("each of very many unknown keys is looked up among the known ones")
def test_of_very_many_unknown_keys_only_those_that_are_shown_are_looked_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """To compare a key with all others takes a millisecond, and a file may have 20 000."""
    asked = list[str]()

    def noted(word: str, known: Iterable[str]) -> str:
        asked.append(word)
        return nearest(word, known)

    monkeypatch.setattr(wording, "nearest", noted)
    file = tmp_path / "many.yaml"
    file.write_text("\n".join([*(f"samples{k}: 1" for k in range(500)), "titel: x"]))
    with pytest.raises(CaseError) as caught:
        load(file)
    assert len([m for m in caught.value.mistakes if "unknown key" in m.what]) == 501
    assert len(asked) == SHOWN
    assert "unknown key 'samples0'; did you mean 'samples'?" in str(caught.value)


EVENTS = "events: {halt: {guide.slip: stays zero}, top: {ball.vy: falls to zero}}\n"
DEEPER = [
    ("scene:\n", f"scene:\n  {EVENTS}", "7:3: scene.events"),
    ("  bodies:\n", f"  bodies:\n    {EVENTS}", "9:5: scene.bodies.events"),
    ("near: {", f"near: {{{EVENTS.strip()}, ", "23:8: near.events"),
    ("allow: {", f"allow: {{{EVENTS.strip()}, ", "27:9: allow.events"),
]


@pytest.mark.parametrize(("at", "deeper", "place"), DEEPER)
def test_a_section_that_stands_too_deep_is_told_once(
    tmp_path: Path, at: str, deeper: str, place: str
) -> None:
    """And what it would have named, as `halt.time`, is no second mistake."""
    (mistake,) = mistakes(tmp_path, SOUND.replace(EVENTS, "").replace(at, deeper, 1)).mistakes
    told = f"{mistake.line}:{mistake.column}: {mistake.where}"
    assert told == place
    assert mistake.what == "'events' stands beside `scene`, at the file's margin"


@pytest.mark.mutant("a section that stands too deep is taken for a misspelt key")
def test_a_section_that_is_taken_for_a_key_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parse, "_too_deep", lambda path, data: None)
    found = mistakes(tmp_path, SOUND.replace(EVENTS, "").replace("scene:\n", f"scene:\n  {EVENTS}"))
    assert any("did you mean 'seen'" in mistake.what for mistake in found.mistakes)


def test_a_part_may_be_called_as_a_section_is(tmp_path: Path) -> None:
    """Beside a section that stands where it belongs the name is a body's."""
    text = SOUND.replace(
        "    ball: {particle", "    events: {partcle: {mass: 1}}\n    ball: {particle"
    )
    (mistake,) = mistakes(tmp_path, text).mistakes
    assert mistake.what.startswith("unknown shape 'partcle'")


@pytest.mark.mutant("a number that is none is compared with another")
def test_what_follows_from_a_mistaken_number_is_not_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stops = "{stops: hinge, low: -120, high: 1}"
    text = SOUND.replace("{torque: bar, sine: {amplitude: 1.0, angular_frequency: 20 rpm}}", stops)
    (mistake,) = mistakes(tmp_path, text).mistakes
    assert "nan" not in mistake.what
    compared = otherwise(limit, "self.low >= self.high", "not self.low < self.high")
    monkeypatch.setattr(limit.Stops, "why_unfit", compared.Stops.why_unfit)
    assert any("is nan rad" in mistake.what for mistake in mistakes(tmp_path, text).mistakes)
