"""A user's own options: which there are, and which values MuJoCo takes."""

from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any

import mujoco

from .law.signal import installed
from .run import listening

_WORDS = {
    "integrator": ("Euler", "RK4", "implicit", "implicitfast", "discrete"),
    "cone": ("pyramidal", "elliptic"),
    "jacobian": ("dense", "sparse", "auto"),
    "solver": ("PGS", "CG", "Newton"),
}
_WHOLE = ("iterations", "ls_iterations", "noslip_iterations")
_REAL = ("tolerance", "ls_tolerance", "noslip_tolerance", "impratio")
SOFT = {"solref": (2,), "solimp": (3, 5)}
_NAMES = ("step", *_WORDS, *_WHOLE, *_REAL, *SOFT)
_MOST = 2**31 - 1  # MuJoCo's int


def check(options: Mapping[str, Any]) -> None:
    """Raises ValueError with all mistakes: unknown names with the nearest right one, and values."""
    found = [mistake for name, value in options.items() if (mistake := _mistake(name, value))]
    mistakes = found or _refused(options)
    if mistakes:
        raise ValueError("\n".join(mistakes))


def as_written(name: str, value: Any) -> Any:
    """The value as it stands in the file: MuJoCo reads no 50.0 where it wants a whole number."""
    return int(value) if name in _WHOLE else value


def _mistake(name: str, value: Any) -> str | None:
    if name not in _NAMES:
        close = get_close_matches(str(name), _NAMES, n=1)
        hint = f"did you mean {close[0]!r}?" if close else f"known: {', '.join(_NAMES)}"
        return f"mujoco.{name}: unknown option; {hint}"
    if name in _WORDS:
        close = get_close_matches(str(value), _WORDS[name], n=1)
        hint = f"; did you mean {close[0]!r}?" if close else ""
        words = ", ".join(_WORDS[name])
        right = value in _WORDS[name]
        return None if right else f"mujoco.{name}: should be one of {words}, is {value!r}{hint}"
    right, what = _number(name, value)
    return None if right else f"mujoco.{name}: should be {what}, is {value!r}"


def _number(name: str, value: Any) -> tuple[bool, str]:
    """Whether the value is right, and what it should be."""
    if name in SOFT:
        sizes = " or ".join(str(size) for size in SOFT[name])
        right = isinstance(value, list | tuple) and len(value) in SOFT[name]
        right = right and all(map(_finite, value))
        return right, f"a list of {sizes} finite numbers"
    if name in _WHOLE:
        right = _finite(value) and value == int(value) and 0 <= value <= _MOST
        return right, f"a whole number from 0 to {_MOST}"
    if name == "step":
        return _finite(value) and value > 0, "a positive number of seconds"
    return _finite(value) and value >= 0, "a number of at least 0"


def _finite(value: Any) -> bool:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return number and abs(value) <= mujoco.mjMAXVAL**30  # 1e300: an int can exceed every float


def _refused(options: Mapping[str, Any]) -> list[str]:
    """What MuJoCo itself says of the values, when a pin and a contact are stepped with them."""
    with listening() as warnings, installed(None):
        try:
            model = mujoco.MjModel.from_xml_string(_trial(options))
            mujoco.mj_step(model, mujoco.MjData(model))
        except ValueError as refusal:
            return [f"mujoco: {' '.join(str(refusal).split())}"]
    return [f"mujoco: {' '.join(warning.split())}" for warning in warnings]


def _trial(options: Mapping[str, Any]) -> str:
    """A ball on a floor, pinned at its centre."""

    def text(name: str) -> str:
        value = as_written(name, options[name])
        words = value if isinstance(value, list | tuple) else [value]
        return f'{"timestep" if name == "step" else name}="{" ".join(map(str, words))}"'

    option = " ".join(text(name) for name in options if name not in SOFT)
    soft = " ".join(text(name) for name in options if name in SOFT)
    return f"""<mujoco><option {option}/>
<worldbody><geom name="floor" type="plane" size="0 0 1"/><site name="O"/>
<body name="b"><freejoint/><geom name="g" size="0.1"/><site name="s"/></body></worldbody>
<contact><pair geom1="floor" geom2="g" {soft}/></contact>
<equality><connect site1="O" site2="s" {soft}/></equality></mujoco>"""
