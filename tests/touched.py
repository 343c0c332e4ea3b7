"""Which tests and shipped cases see what differs from the last commit: paths for `make quick`.

With `--files`: which programs differ, for the type checker.
"""

import subprocess
import sys
from collections.abc import Sequence
from itertools import chain, zip_longest
from pathlib import Path

import executed

ROOT = Path(__file__).parents[1]
ALWAYS = ("tests/test_structure.py",)
CASES = 6  # files at most, of some 3 CPU s each: within a minute of two cores


def changed() -> list[Path]:
    """Files that git sees as changed or new."""
    words = ["git", "status", "--porcelain", "--untracked-files=all", "--no-renames"]
    lines = subprocess.run(words, capture_output=True, text=True, check=True, cwd=ROOT).stdout
    return [Path(line[3:].strip('"')) for line in lines.splitlines()]


def mirror(file: Path) -> list[Path]:
    """The test itself, or those in the folder of tests that mirrors its own and in those above."""
    if file.parts[0] == "tests":
        is_test = file.name.startswith("test_") and (ROOT / file).exists()
        return [file] if is_test else []
    folders = [folder for folder in (file.parent, *file.parent.parents) if folder.parts]
    tests = [sorted((ROOT / "tests" / folder).glob("test_*.py")) for folder in folders]
    return [test.relative_to(ROOT) for test in chain(*tests)]


def cases(files: Sequence[Path]) -> list[str]:
    """The case files among them, and such as execute each of the programs, as far as there is room.

    Their references have certificates, and the engines' errors are held against the committed ones.
    """
    own = [file.as_posix() for file in files if file.parts[0] == "cases" and file.suffix == ".yaml"]
    known, systems = executed.read(), executed.of_systems()
    programs = [file.as_posix() for file in files]
    names = zip_longest(*([*systems.get(p, ()), *known.get(p, ())] for p in programs))
    chosen = dict.fromkeys([*own, *filter(None, chain(*names))])
    return [name for name in chosen if (ROOT / name).is_file()][:CASES]


def main(*words: str) -> None:
    """Prints them, each once."""
    if "--files" in words:
        files = [str(f) for f in changed() if f.suffix == ".py" and (ROOT / f).exists()]
        print(*files or ALWAYS)  # of no file the type checker would take all
        return
    files = changed()
    tests = {str(test) for file in files for test in mirror(file)}
    print(*ALWAYS, *sorted(tests - set(ALWAYS)), *cases(files))


if __name__ == "__main__":
    main(*sys.argv[1:])
