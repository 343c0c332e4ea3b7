"""The files of the tree, and what each imports."""

import ast
from pathlib import Path

ROOT = Path(__file__).parents[3]
PACKAGES = ("cases", "reference", "engines", "reports")
FILES = [file for package in PACKAGES for file in sorted((ROOT / package).rglob("*.py"))]
TESTS = sorted((ROOT / "tests").rglob("*.py"))


def module(file: Path) -> str:
    """`cases.scene` of cases/scene.py, `engines.mujoco` of its __init__.py."""
    parts = file.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


def imported(file: Path) -> set[str]:
    """Full names of all that a file imports, also inside functions; ours without `textmech`."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = absolute(file, node)
            names |= {base} | {f"{base}.{alias.name}".removeprefix(".") for alias in node.names}
    return names


def absolute(file: Path, node: ast.ImportFrom) -> str:
    """What `from … import` names, seen from the folder of the four."""
    if not node.level:
        assert (node.module or "").split(".")[0] not in (*PACKAGES, "textmech"), (
            f"{file}: what is ours is imported by its relative name"
        )
        return node.module or ""
    package = [*file.relative_to(ROOT).parent.parts]
    above = package[: len(package) - (node.level - 1)]
    return ".".join([*above, *([node.module] if node.module else [])])
