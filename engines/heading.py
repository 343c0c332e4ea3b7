"""The heading of an engine's file or script: the scene, the setting, and each number's reason."""

from .engine import Engine, Plan
from .knobs import Options, as_text


def heading(
    engine: Engine, title: str, step: float, plan: Plan, options: Options | None = None
) -> list[str]:
    """Lines for the engine to make comments of. Each is one line, whatever the title holds.

    options: what in a file of settings gives the same numbers.
    """
    protocol, own = plan.protocol(step), as_text({"step": step, **(options or {})})
    lines = [
        title,
        f"{engine.name} {engine.version}, {engine.setting}, h = {step:g} s",
        *(f"{c.name} = {c.value}: {c.because}" for c in plan.choices(step)),
        f"protocol: {protocol}" if protocol else "",
        f"as your own settings: {engine.name}: {own}" if options else "",
    ]
    return [" ".join(map(_printable, line.split())) for line in lines if line]


def _printable(word: str) -> str:
    """A text with � for each unprintable character, which would end a comment, or the file."""
    return "".join(character if character.isprintable() else "�" for character in word)
