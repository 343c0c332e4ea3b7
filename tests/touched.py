"""Which tests mirror what differs from the last commit: their paths, for `make quick`.

With `--files`: which programs differ, for the type checker.
"""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
ALWAYS = ("tests/test_structure.py",)


def changed() -> list[Path]:
    """Files that git sees as changed or new."""
    words = ["git", "status", "--porcelain", "--untracked-files=all", "--no-renames"]
    lines = subprocess.run(words, capture_output=True, text=True, check=True, cwd=ROOT).stdout
    return [Path(line[3:].strip('"')) for line in lines.splitlines()]


def mirror(file: Path) -> list[Path]:
    """The test itself, or those that lie in the nearest folder of tests that mirrors its own."""
    if file.parts[0] == "tests":
        is_test = file.name.startswith("test_") and (ROOT / file).exists()
        return [file] if is_test else []
    for folder in (file.parent, *file.parent.parents):
        tests = sorted((ROOT / "tests" / folder).glob("test_*.py"))
        if folder.parts and tests:
            return [test.relative_to(ROOT) for test in tests]
    return []


def main(*words: str) -> None:
    """Prints them, each once."""
    if "--files" in words:
        files = [str(f) for f in changed() if f.suffix == ".py" and (ROOT / f).exists()]
        print(*files or ALWAYS)  # of no file the type checker would take all
        return
    found = {str(test) for file in changed() for test in mirror(file)}
    print(*ALWAYS, *sorted(found - set(ALWAYS)))


if __name__ == "__main__":
    main(*sys.argv[1:])
