"""The list of the textbook cases: what each claims, and where in the book it comes from."""

from ...cases.find import of_the_book
from ...cases.load import load


def catalogue() -> list[list[str]]:
    """Lines of cells, the head first: a file, its title, and its places in the book."""
    lines = [["case", "what it claims", "in the book"]]
    for name, path in sorted(of_the_book().items()):
        first = load(path)[0]
        lines.append([f"[`{name}`]({path.name})", first.title, str(first.origin)])
    return lines
