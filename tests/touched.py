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


def mirror(file: Path) -> Path | None:
    """The test itself, or the nearest folder of tests that mirrors the file's own."""
    if file.parts[0] == "tests":
        is_test = file.name.startswith("test_") and (ROOT / file).exists()
        return file if is_test else None
    for folder in (file.parent, *file.parent.parents):
        if folder.parts and (ROOT / "tests" / folder).is_dir():
            return "tests" / folder
    return None


def main(*words: str) -> None:
    """Prints them; a folder once, and not what lies in it again."""
    if "--files" in words:
        files = [str(f) for f in changed() if f.suffix == ".py" and (ROOT / f).exists()]
        print(*files or ALWAYS)  # of no file the type checker would take all
        return
    found = {path for file in changed() if (path := mirror(file)) is not None}
    alone = [path for path in found if not found & set(path.parents)]
    print(*ALWAYS, *sorted(map(str, alone)))


if __name__ == "__main__":
    main(*sys.argv[1:])
