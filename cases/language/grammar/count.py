"""How many: a whole number, or a parameter that is one."""

from dataclasses import dataclass
from typing import Any

from .field import NUMBER, Plain
from .number import Names, number
from .words import wrong


@dataclass(frozen=True)
class Count(Plain):
    """A whole number from `least` to `most`; `least` stands for a mistaken parameter, too."""

    least: int
    most: int

    def check(self, value: object, known: Names) -> int:
        found = number(value, "1", known)
        if found is None:
            return self.least
        if not self.least <= found.value <= self.most or found.value != round(found.value):
            by_name = f" ({value})" if isinstance(value, str) else ""
            raise wrong(
                f"should be a whole number from {self.least} to {self.most}, is "
                f"{found.value:g}{by_name}"
            )
        return round(found.value)

    def schema(self) -> dict[str, Any]:
        literal = {"type": "integer", "minimum": self.least, "maximum": self.most}
        return {"anyOf": [literal, {"type": "string"}], "description": NUMBER}
