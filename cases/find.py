"""What a person may call a case: the path of a YAML file, or the name of one that is shipped."""

from collections.abc import Sequence
from pathlib import Path

from .mistake import CaseError, Mistake, nearest


def shipped() -> dict[str, Path]:
    """The case files that come with the suite, by name."""
    return {path.stem: path for path in sorted(Path(__file__).parent.glob("*.yaml"))}


def find(words: Sequence[str]) -> list[Path]:
    """The file of each word. Raises CaseError that names every word which is none."""
    known = shipped()
    paths: list[Path] = []
    mistakes: list[Mistake] = []
    for word in words:
        path = known.get(word, Path(word))
        if path.is_file():
            paths.append(path)
        elif path.is_dir():
            mistakes.append(Mistake(word, 0, 0, "", "is a directory; a case is one YAML file"))
        elif path.suffix in (".yaml", ".yml"):
            mistakes.append(Mistake(word, 0, 0, "", f"no such file{nearest(path.stem, known)}"))
        else:
            mistakes.append(Mistake(word, 0, 0, "", f"no such case{nearest(word, known)}"))
    if mistakes:
        raise CaseError(mistakes)
    return paths
