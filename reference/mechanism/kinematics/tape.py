"""Formulas written down while they run once: scalars that record what is done to them.

A formula of vectors, run with the scalars of a tape in place of numbers, leaves one straight line
of sums and products behind. `Tape.compiled` makes a function of them, which costs a tenth of what
walking through the vectors at every state would; `Compiled.text` shows it.

What is zero or one falls out, what was computed is not computed again, what no result needs is
left out, and what is used once stands where it is used. Names of a case never enter the text.
"""

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from types import CodeType
from typing import Any

DEEP = 20  # terms within each other: a deeper one gets a name, as Python reads no endless nest


Node = tuple[str, tuple[Any, ...]]
"""A number in the making: an operation, or a text of its own, and the numbers that it is of."""


class Scalar:
    """A number on a tape, times its sign."""

    __slots__ = ("at", "sign", "tape")

    def __init__(self, tape: "Tape", at: int, sign: int = 1) -> None:
        self.tape, self.at, self.sign = tape, at, sign

    def __neg__(self) -> "Scalar":
        return Scalar(self.tape, self.at, -self.sign)

    def __add__(self, other: Any) -> Any:
        if is_number(other) and other == 0:
            return self
        if isinstance(other, Scalar) and other.at == self.at:
            return 2.0 * self if other.sign == self.sign else 0.0
        return self.tape.sum(self, other)

    def __radd__(self, other: Any) -> Any:
        return self + other

    def __sub__(self, other: Any) -> Any:
        return self + -other

    def __rsub__(self, other: Any) -> Any:
        return -self + other

    def __mul__(self, other: Any) -> Any:
        if is_number(other):
            if other == 0:
                return 0.0
            if abs(other) == 1:
                return self if other > 0 else -self
        return self.tape.product("*", self, other)

    def __rmul__(self, other: Any) -> Any:
        return self * other

    def __truediv__(self, other: Any) -> Any:
        if is_number(other) and abs(other) == 1:
            return self * other
        return self.tape.product("/", self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return 0.0 if other == 0 else self.tape.product("/", other, self)

    def __pow__(self, power: Any) -> Any:
        return self * self if power == 2 else self.tape.product("**", self, power)

    def __bool__(self) -> bool:
        raise TypeError("what is written down has no branches: let a function called by it choose")


def is_number(x: Any) -> bool:
    """Whether it is a number that is known already."""
    return not isinstance(x, Scalar)


Function = Callable[..., list[Any]]


@dataclass(frozen=True)
class Compiled:
    """A function of t, q and v, given as numbers or lists of them, that returns a list."""

    tape: "Tape"
    results: Sequence[Any]

    @cached_property
    def text(self) -> str:
        """The function, to read."""
        lines, results = self.tape.written(self.results)
        body = "".join(f"    {line}\n" for line in lines)
        return f"def run(t, q, v):\n{body}    return [{', '.join(results)}]\n"

    @cached_property
    def real(self) -> Function:
        """The function of real numbers."""
        return self._made(math)

    @cached_property
    def complex(self) -> Function:
        """The same of complex ones, as a complex step asks it."""
        return self._made(cmath)

    def __call__(self, t: Any, q: Any, v: Any = ()) -> list[Any]:
        """The results for real or complex t and q; v may be any numbers that have products."""
        q = q.tolist() if hasattr(q, "tolist") else q
        v = v.tolist() if getattr(v, "ndim", 0) == 1 else v
        stepped = any(isinstance(x, complex) for x in (t, *q))
        return (self.complex if stepped else self.real)(t, q, v)

    def _made(self, maths: Any) -> Function:
        names: dict[str, Any] = {"cos": maths.cos, "sin": maths.sin} | self.tape.called
        exec(_compiled(self.text), names)
        return names["run"]


@lru_cache(maxsize=1000)  # a case is solved several times, to be certified
def _compiled(text: str) -> CodeType:
    return compile(text, "<formulas>", "exec")


class Tape:
    """Numbers that are known by their formulas alone; `t`, `q` and `v` are those to begin with."""

    def __init__(self, q: int, v: int) -> None:
        self._nodes: list[Node] = []
        self._known: dict[Node, int] = {}
        self._called: list[Callable[..., Any]] = []
        self.t = self._input("t")
        self.q = [self._input(f"q[{i}]") for i in range(q)]
        self.v = [self._input(f"v[{i}]") for i in range(v)]

    def cos(self, x: Any) -> Any:
        """cos x."""
        return math.cos(x) if is_number(x) else self._new("cos", x)

    def sin(self, x: Any) -> Any:
        """sin x."""
        return math.sin(x) if is_number(x) else self._new("sin", x)

    def call(self, function: Callable[..., Any], *of: Any) -> Any:
        """The function of these numbers, which it gets when they are known; it may choose."""
        if function not in self._called:
            self._called.append(function)
        return self._new(f"f{self._called.index(function)}", *of)

    def sum(self, a: Scalar, b: Any) -> Any:
        """a + b, of which one order and one sign is written down."""
        if is_number(b):
            first, second = a, b
        else:
            first, second = sorted((a, b), key=lambda x: x.at)
        node = "+", (self._plain(first), self._signed(second, first.sign))
        return Scalar(self, self._at(node), first.sign)

    def product(self, operation: str, a: Any, b: Any) -> Any:
        """a b, a/b or aᵇ; signs are carried outward, where they mostly meet another."""
        if operation == "**":
            return Scalar(self, self._at(("**", (self._signed(a, 1), b))))
        sign, of = 1, []
        for x in (a, b):
            sign *= x.sign if isinstance(x, Scalar) else (1 if x >= 0 else -1)
            of.append(self._plain(x) if isinstance(x, Scalar) else float(abs(x)))
        if operation == "*":
            of.sort(key=lambda x: (isinstance(x, tuple), x))
        return Scalar(self, self._at((operation, tuple(of))), sign)

    def compiled(self, results: Sequence[Any]) -> Compiled:
        """The function of these results."""
        return Compiled(self, results)

    @property
    def called(self) -> dict[str, Callable[..., Any]]:
        """The functions that are called, by their names in the text."""
        return {f"f{i}": function for i, function in enumerate(self._called)}

    def written(self, results: Sequence[Any]) -> tuple[list[str], list[str]]:
        """The lines of what is used more than once, in order, and the results' texts."""
        uses = self._uses([x.at for x in results if isinstance(x, Scalar)])
        texts: dict[int, str] = {}
        depths: dict[int, int] = {}
        lines = []

        def text(x: Any) -> str:
            if not isinstance(x, tuple):
                return repr(x)
            at, sign = x
            return texts[at] if sign > 0 else f"-{texts[at]}"

        for at in sorted(uses):
            operation, of = self._nodes[at]
            depths[at] = 1 + max((depths[x[0]] for x in of if isinstance(x, tuple)), default=0)
            if operation in ("+", "*", "/", "**"):
                first, second = map(text, of)
                if operation == "**" and first.startswith("-"):
                    first = f"({first})"
                if operation == "+" and second.startswith("-"):
                    code = f"({first} - {second[1:]})"
                else:
                    code = f"({first} {operation} {second})"
            else:
                code = f"{operation}({', '.join(map(text, of))})" if of else operation
            if uses[at] > 1 or depths[at] > DEEP:
                name = f"x{at}"
                lines.append(f"{name} = {code}")
                code, depths[at] = name, 0
            texts[at] = code
        return lines, [
            text((x.at, x.sign)) if isinstance(x, Scalar) else repr(float(x)) for x in results
        ]

    def _uses(self, wanted: list[int]) -> dict[int, int]:
        """How often each number is used that the wanted ones need."""
        uses: dict[int, int] = {}
        stack = list(wanted)
        while stack:
            at = stack.pop()
            uses[at] = uses.get(at, 0) + 1
            if uses[at] == 1:
                stack += [x[0] for x in self._nodes[at][1] if isinstance(x, tuple)]
        return uses

    def _input(self, text: str) -> Scalar:
        return Scalar(self, self._at((text, ())))

    def _new(self, operation: str, *of: Any) -> Scalar:
        return Scalar(self, self._at((operation, tuple(self._signed(x, 1) for x in of))))

    @staticmethod
    def _plain(x: Scalar) -> tuple[int, int]:
        return x.at, 1

    @staticmethod
    def _signed(x: Any, sign: int) -> Any:
        """As a node has it; a number that is known stands for itself."""
        return (x.at, x.sign * sign) if isinstance(x, Scalar) else float(x * sign)

    def _at(self, node: Node) -> int:
        if node not in self._known:
            self._known[node] = len(self._nodes)
            self._nodes.append(node)
        return self._known[node]
