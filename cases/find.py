"""Finds a case by what a person calls it: the path of a YAML file, or the name of a shipped one."""

from collections.abc import Iterator, Sequence
from pathlib import Path

from .mistake import CaseError, Mistake, invisible, nearest, plain

LONGEST = 100  # letters of a name: with a variant's and an ending it has to make a file's name
SUFFIXES = (".yaml", ".yml")
MODELS = "models"
QUESTIONS = "questions"  # the folder of cases that answer public questions


def shipped() -> dict[str, Path]:
    """The case files that come with the suite, by name: the textbook's, then the questions."""
    return of_the_book() | questions()


def of_the_book() -> dict[str, Path]:
    """The case files of the textbook's chapter, by name."""
    return _files_by_name(Path(__file__).parent)


def questions() -> dict[str, Path]:
    """The case files that answer what people ask in public, by name."""
    return _files_by_name(Path(__file__).parent / QUESTIONS)


def is_shipped(file: Path | str) -> bool:
    """Whether the file comes with the suite, decided by its path, which is fast."""
    path, home = Path(file).resolve(), Path(__file__).resolve().parent
    return (
        path.parent in (home, home / QUESTIONS, home / MODELS)
        and path.suffix == ".yaml"
        and path.is_file()
    )


def models() -> dict[str, Path]:
    """The case files of models that come with the suite, by name."""
    return _files_by_name(Path(__file__).parent / MODELS)


def _files_by_name(folder: Path) -> dict[str, Path]:
    return {path.stem: path for path in sorted(folder.glob("*.yaml"))}


def find(words: Sequence[str]) -> list[Path]:
    """Return the file of each word. Raises CaseError with every word that is no case."""
    case_files, model_files = shipped(), models()
    alike = [*case_files, *model_files]
    paths: list[Path] = []
    mistakes: list[Mistake] = []
    for word in words:
        if not word:  # which is also how the folder here is called
            mistakes.append(Mistake("''", 0, 0, "", "no such case: the name is empty"))
            continue
        path = case_files.get(word, Path(word))
        try:
            is_file, is_dir = path.is_file(), path.is_dir()
        except OSError as error:  # a name that no file can have
            mistakes.append(Mistake(word, 0, 0, "", f"no such file: {error.strerror}"))
            continue
        if is_file:
            paths.append(path)
        elif is_dir:
            mistakes.append(Mistake(word, 0, 0, "", "is a directory; a case is one YAML file"))
        elif path.exists() or path.is_symlink():
            leads = "" if path.exists() or not path.is_symlink() else ": a link that leads nowhere"
            mistakes.append(Mistake(word, 0, 0, "", f"is no file{leads}"))
        elif path.suffix in SUFFIXES:
            mistakes.append(Mistake(word, 0, 0, "", f"no such file{nearest(path.stem, alike)}"))
        elif word.partition(".")[0] in model_files:
            mistakes.append(Mistake(word, 0, 0, "", "is a model, and has no scene"))
        else:
            own = [str(file) for end in SUFFIXES if (file := Path(word + end)).is_file()]
            hint = nearest(word, alike) if not own else f"; did you mean {own[0]!r}?"
            mistakes.append(Mistake(word, 0, 0, "", f"no such case{hint}"))
    if mistakes:
        raise CaseError(mistakes)
    return paths


def case_name(path: Path, variant: str) -> str:
    """The name of a variant of the file; with "" the name of a file that has none."""
    return f"{path.stem}.{variant}" if variant else path.stem


def check_name(path: Path) -> Iterator[Mistake]:
    """Yields the mistake in the file's name, which is the case's name in every report."""
    stem = path.stem
    if len(stem) > LONGEST:
        what = f"has a name of {len(stem)} letters; a case has at most {LONGEST}"
    elif invisible(stem) or "#" in stem or stem[0] in "=+-@":
        what = (
            f"has the name '{plain(stem)}': in the reports `#` begins a comment, and with = + - @ "
            "a spreadsheet begins a formula; rename the file"
        )
    else:
        return
    yield Mistake(str(path), 0, 0, "", what)
