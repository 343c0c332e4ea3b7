"""Hand-written systems that answer for states, by the names that cases give them."""

from ..stated import Stated
from .arm_states import ArmStates

STATED: dict[str, type[Stated]] = {
    "arm_states": ArmStates,
}
