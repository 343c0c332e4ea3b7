"""The interface for Python: cases, references and comparisons, as pandas frames.

    from textmech.reports import advise, load, run, solve

What the command would refuse raises `textmech.cases.mistake.CaseError`, with the same words and all
mistakes at once in `mistakes`. What computes is imported by the first call, and not with this.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import inf
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ...cases.case import Case
from ...cases.mistake import CaseError, Mistake, Source, nearest
from ...cases.model_case import ModelCase, of_model
from ...engines.own_space import AnySpace, is_space

if TYPE_CHECKING:
    import pandas as pd

    from ..runs.request import Request
    from ..runs.task_results import Progress
    from .page.notebook import Drawing

OWN = "own"  # how the column of a user's own options is called
SMALLEST = 1e-300
MOST = 3  # plots that a notebook shows unasked
BY_DEFAULT = ("jobs", "tolerance")  # numbers that may be None
SPACE = "space"  # how a Space is called that comes without a name
Word = str | Path | Case | ModelCase | AnySpace


@dataclass(frozen=True)
class Reference:
    """The textbook's solution of a case: its motion, its events, and its checks.

    motion: by time [s] each quantity that the case bounds, and where its bodies are; of an attitude
    the angle [rad] from where it began. units: of its columns. events: the name, the number from 1
    and the time [s] of each. checks: what the reference was held against, the difference, the bound
    that it keeps, and of a bounded quantity what it is certified to. allowed: of each quantity that
    the case bounds. warnings: sentences on what the motion shows that is no mistake, and is most
    likely not meant.
    """

    case: str
    motion: "pd.DataFrame"
    units: Mapping[str, str]
    events: "pd.DataFrame"
    checks: "pd.DataFrame"
    allowed: Mapping[str, float]
    warnings: tuple[str, ...] = ()

    def plot(self, quantities: str | Sequence[str] = ()) -> "Drawing":
        """A matplotlib figure of columns of `motion`; of those that the case bounds for none.

        Raises CaseError.
        """
        from .page.motion_frames import REFERENCE
        from .page.notebook import drawn

        shown = _plotted(quantities, [*map(str, self.motion)], self.allowed)
        motions: dict[tuple[str, str, str], pd.DataFrame] = {REFERENCE: self.motion}
        return drawn(self.case, motions, self.units, shown, self.allowed)

    def __str__(self) -> str:
        known = self.checks.dropna(subset=["certified"])
        rows = known[["name", "certified", "unit"]].to_numpy().tolist()
        certified = [
            f"{name.removeprefix('error of ')} to {error:.0e} {unit}" for name, error, unit in rows
        ]
        what = ", ".join(certified) or "nothing that its case bounds"
        return f"{self.case}: the reference is certified: {what}"

    def _repr_html_(self) -> str:
        from .page.notebook import paragraphs, table

        events = table(self.events) if len(self.events) else ""
        return paragraphs([str(self)]) + events + self.plot([*self.allowed][:MOST]).html


@dataclass(frozen=True)
class Comparisons:
    """The results of engines on cases: the frames of the reports of the same names.

    summary: of each case and engine the worst quantity over what is allowed, and what agrees.
    motions: by case its motion by engine, setting, way and time, with the columns of
    `Reference.motion`; the reference's is called `reference`. causes: what cures each row above its
    tolerance, as far as it was asked for. fails: whether a verdict is FAILS.
    """

    summary: "pd.DataFrame"
    tolerance: "pd.DataFrame"
    convergence: "pd.DataFrame"
    steps: "pd.DataFrame"
    events: "pd.DataFrame"
    reference: "pd.DataFrame"
    causes: "pd.DataFrame"
    fails: bool
    motions: "Mapping[str, pd.DataFrame]"

    def plot(self, case: str = "", quantities: str | Sequence[str] = ()) -> "Drawing":
        """A matplotlib figure of the reference and all engines, with what the case allows.

        case: by its name, of several. quantities: as columns of `motions`; for none the worst one.
        Raises CaseError.
        """
        from .page.motion_frames import BY
        from .page.notebook import drawn

        name = _one_of("case", case or next(iter(self.motions), ""), self.motions)
        rows = self.tolerance[(self.tolerance.case == name) & self.tolerance.ratio.notna()]
        rows = rows[rows.quantity.isin(self.motions[name].columns)]
        worst = rows.sort_values("ratio").quantity.tail(1).tolist()
        bounded = rows.dropna(subset=["allowed"])[["quantity", "allowed"]]
        allowed = {str(name): float(bar) for name, bar in bounded.to_numpy().tolist()}
        shown = _plotted(quantities, [*map(str, self.motions[name])], worst)
        motions: dict[Any, pd.DataFrame] = {
            way: frame.droplevel(list(BY))
            for way, frame in self.motions[name].groupby(level=list(BY))
        }
        units = self.motions[name].attrs["units"]
        return drawn(name, motions, units, shown, allowed)

    def __str__(self) -> str:
        from .show.summary import Line
        from .show.table import narrow

        lines = [Line(*row) for row in self.summary.itertuples(index=False)]
        return narrow(lines) if lines else "no engine was run"

    def _repr_html_(self) -> str:
        from .page.notebook import table

        return table(self.summary) + (self.plot().html if len(self.motions) == 1 else "")


def load(word: Word | Sequence[Word] = ()) -> list[Any]:
    """The cases of a name, a variant (`rolling_wheel.pushed`) or a YAML file; all shipped for none.

    A model is a case as well: an MJCF or URDF file, the text of one, an `MjSpec` or an `MjModel`.
    So is a `pymunk.Space`, or the name of a function that makes one, as `mygame:make_space`.
    Raises CaseError with all mistakes of all files, and where two cases have one name.
    """
    from ..runs.chosen_models import choose_models
    from ..runs.selection import choose_cases, told_apart

    words = _as_list("cases", _given(word), (str, Path, Case, ModelCase))
    given = [case for case in words if isinstance(case, Case | ModelCase)]
    named = [str(name) for name in words if not isinstance(name, Case | ModelCase)]
    chosen = choose_models(named) if named else None
    if chosen and chosen.mistakes:
        raise CaseError(chosen.mistakes)
    models = [*(chosen.cases if chosen else ())]
    others = [*(chosen.others if chosen else ())]
    loaded = choose_cases(others) if others or not words else []
    cases = told_apart([*(case for case in given if isinstance(case, Case)), *loaded])
    return [*cases, *(case for case in given if isinstance(case, ModelCase)), *models]


def _given(word: Any) -> Any:
    """Returns what was given, with each model that is no file as a case."""
    if isinstance(word, list | tuple):
        return [_given(each) for each in word]
    if isinstance(word, str) and word.lstrip().startswith("<"):
        return of_model("", "MJCF", "model", word)
    if is_space(word):
        from ..runs.spaces import space_case

        return space_case(word, SPACE, SPACE)
    given: Any = word
    kind = type(given)
    if kind.__module__.partition(".")[0] != "mujoco":
        return word
    if kind.__name__ == "MjSpec":
        from ...engines.own_model.model import compiled_by

        return of_model("", kind.__name__, "model", compiled_by(kind.__name__, given.compile).model)
    return of_model("", kind.__name__, "model", word)


def solve(word: Word) -> Reference:
    """The reference of one case, without any engine.

    Raises CaseError, also for a file of several variants.
    """
    import pandas as pd

    from ...reference.solve import solve as solved
    from ..compare.events.states import mistaken
    from ..compare.judge.instants import of_reference
    from ..compare.judge.unintended import unintended
    from .page.motion_frames import reference_frame
    from .show import progress as shown

    words = _as_list("cases", _given(word), (str, Path, Case, ModelCase))
    if not words:
        raise CaseError([Mistake("cases", 0, 0, "", "none is named; one can be solved")])
    cases = load(words)
    if len(cases) > 1:
        names = ", ".join(case.name for case in cases)
        named = ", ".join(str(getattr(item, "name", item)) for item in words)
        raise CaseError([Mistake(named, 0, 0, "", f"has variants; solve one of: {names}")])
    (case,) = cases
    if isinstance(case, ModelCase):
        what = "is a model, whose limit is MuJoCo's own: `run` compares its steps with that"
        raise CaseError([Mistake(case.file, 0, 0, "", what)])
    with shown.aloud():
        solution = solved(case)
    if mistakes := mistaken(case, solution.trajectory):
        raise CaseError(mistakes)
    motion = reference_frame(case, solution.trajectory)
    instants = of_reference(case, solution.trajectory)
    times = [(instant.event, instant.k, instant.time) for instant in instants]
    return Reference(
        case=case.name,
        motion=motion,
        units=motion.attrs["units"],
        events=pd.DataFrame(times, columns=["event", "k", "time"]),
        checks=pd.DataFrame([vars(check) | {"holds": check.holds} for check in solution.checks]),
        allowed={name: bar for name, bar in case.allow.items() if bar is not None},
        warnings=(*unintended(case, solution.trajectory),),
    )


def run(
    word: Word | Sequence[Word] = (),
    *,
    engines: str | Sequence[str] = (),
    settings: str | Path | Sequence[str | Path] = (),
    options: Mapping[str, Mapping[str, Any]] | None = None,
    causes: bool = False,
    jobs: int | None = None,
    cache: bool = True,
    progress: "Progress | None" = None,
) -> Comparisons:
    """Compares engines with the reference of one case, of several, or of all for none.

    engines: as `mujoco`, `mujoco.tuned`, `book`; all for none. settings: `shipped`, `tuned`, or
    files of own options; of both one, or several in a list. options: own ones as a mapping,
    `{"mujoco": {"integrator": "RK4"}}`, which are the setting `own`. causes: whether they are
    searched for, which takes as long again. cache: whether results are kept and found again as the
    command's are. progress: is told how far it is; by default a line on the error stream says so
    where it takes longer than two seconds.

    Raises CaseError with all mistakes, of the cases and of the rest.
    """
    import pandas as pd

    from ...cases.language.document import Document
    from ..runs.cache.store import usable
    from ..runs.request import requested
    from ..search.causes.explained import measure
    from ..tables import committed, write
    from ..tables.user_settings import made
    from .page.motion_frames import motion_frames
    from .show import cures
    from .show.summary import summary

    loaded = load(word)
    _in_range(jobs=(jobs, 1.0))
    own = made(Document(Source("options", (), {}), _options(options), []), OWN)
    names = _as_list("engines", engines, (str,))
    files = [str(file) for file in _as_list("settings", settings, (str, Path))]
    models = [case for case in loaded if isinstance(case, ModelCase)]
    cases = [case for case in loaded if isinstance(case, Case)]
    wanted = requested(cases, names, files, own=list(own.values()), models=models)
    known = committed.committed_causes() if causes and cache else None
    with _aloud(progress) as listener:
        store = usable() if cache else None
        request = replace(wanted, jobs=jobs, progress=listener, store=store)
        report = measure(request, search=causes, known=known)
    if mistakes := [*wanted.mistakes, *report.mistakes]:
        raise CaseError(mistakes)
    told_cures = cures.known(report.cases, report.causes)
    frames = {Path(n).stem: f for n, f in write.tables(report, report.cases).items()}
    return Comparisons(
        summary=pd.DataFrame(map(vars, summary(report.comparisons, report.rungs, told_cures))),
        tolerance=frames["tolerance"],
        convergence=frames["convergence"],
        steps=frames["steps"],
        events=frames["events"],
        reference=frames["reference"],
        causes=frames["causes"],
        fails=report.fails,
        motions=motion_frames(report),
    )


def advise(
    word: Word | Sequence[Word],
    *,
    engines: str | Sequence[str] = (),
    tolerance: float | None = None,
    margin: float = 2.0,
    jobs: int | None = None,
    cache: bool = True,
    progress: "Progress | None" = None,
) -> "pd.DataFrame":
    """Which settings cases need: for each case and engine a recipe or two, as rows of advice.csv.

    engines: as `mujoco`; all for none. tolerance: of each quantity's own size; None: as the case
    allows. margin: how often the worst error has to fit into that. Of models, which are asked
    alone, a row for each thing that cures and for the cheapest; their tolerance is in rad and m.
    Raises CaseError.
    """
    import pandas as pd

    from ..runs.cache.store import usable
    from ..runs.request import requested
    from ..search.advice.advice_rows import Requirement, rows
    from ..search.advice.advise import advised

    _in_range(jobs=(jobs, 1.0), margin=(margin, 1.0), tolerance=(tolerance, SMALLEST))
    if not (words := _as_list("cases", _given(word), (str, Path, Case))):
        raise CaseError([Mistake("cases", 0, 0, "", "none is named: all of them take very long")])
    cases = load(words)
    models = [case for case in cases if isinstance(case, ModelCase)]
    if models and len(models) < len(cases):
        what = "is a model: ask for advice on models alone, for their rows are others"
        raise CaseError([Mistake(model.file, 0, 0, "", what) for model in models])
    names = _as_list("engines", engines, (str,))
    wanted = requested([] if models else cases, names, ["shipped"], models=models)
    if models:
        return _advised_models(replace(wanted, jobs=jobs), tolerance, margin, progress)
    bar = Requirement(tolerance, margin)
    store = usable() if cache else None
    with _aloud(progress) as listener:
        request = replace(wanted, jobs=jobs, progress=listener, store=store)
        with advised(request, bar) as advice:
            table = [row for case_advice in advice for row in rows(case_advice)]
    if wanted.mistakes:
        raise CaseError(wanted.mistakes)
    return pd.DataFrame(map(vars, table))


def _advised_models(
    request: "Request", tolerance: float | None, margin: float, progress: "Progress | None"
) -> "pd.DataFrame":
    import pandas as pd

    from .command.own_advice import advised_models

    with _aloud(progress) as listener:
        advice, mistakes = advised_models(replace(request, progress=listener), tolerance, margin)
    if mistakes:
        raise CaseError(mistakes)
    rows = [
        {"case": each.case, "what": what, "seen": "; ".join(tried.seen), "change": recipe.change,
         "integrator": recipe.integrator, "step": recipe.step, "cost": recipe.cost,
         "ratio": recipe.ratio, "quantity": recipe.quantity, "lines": "\n".join(recipe.lines),
         "because": tried.because}
        for each in advice
        for tried in each.tried
        for what, recipe in [
            ("own", tried.own),
            *(("cure", cure) for cure in tried.cures),
            *([("cheapest", tried.cheapest)] if tried.cheapest else []),
        ]
    ]  # fmt: skip
    return pd.DataFrame(rows)


def _in_range(**numbers: tuple[float | None, float]) -> None:
    """Raises CaseError with every number that is below its least one, not finite, or none."""
    mistakes = [
        Mistake(name, 0, 0, "", f"should be {_kind(name)} {_from(least)}, is {number!r}")
        for name, (number, least) in numbers.items()
        if not (number is None and name in BY_DEFAULT) and not _is_number(name, number, least)
    ]
    if mistakes:
        raise CaseError(mistakes)


def _is_number(name: str, number: object, least: float) -> bool:
    from .command.options import MOST_JOBS

    if isinstance(number, bool) or not isinstance(number, Integral if name == "jobs" else Real):
        return False
    try:
        plain = float(number)
    except OverflowError:
        return False
    return least <= plain < inf and not (name == "jobs" and plain > MOST_JOBS)


def _kind(name: str) -> str:
    from .command.options import MOST_JOBS

    return f"a whole number up to {MOST_JOBS}," if name == "jobs" else "a number"


def _from(least: float) -> str:
    return "above 0" if least < 1.0 else f"from {least:g} on"


@contextmanager
def _aloud(progress: "Progress | None") -> "Iterator[Progress]":
    """Yields the user's progress, or one on the error stream after two seconds."""
    from .show import progress as shown

    with shown.aloud(), shown.progress(quiet=True) as listener:
        yield progress or listener


def _as_list(name: str, given: Any, kinds: tuple[type, ...]) -> list[Any]:
    """Returns what was given as a list, where each is of these kinds; else raises CaseError."""
    values = [given] if isinstance(given, kinds) else given
    if isinstance(values, Iterable) and not isinstance(values, str | bytes | Mapping):
        values = list(values)
        if all(isinstance(value, kinds) for value in values):
            return values
    known = " or ".join(kind.__name__ for kind in kinds)
    what = f"should be {known}, or several in a list, is {given!r}"
    raise CaseError([Mistake(name, 0, 0, "", what)])


def _options(options: Any) -> dict[str, Any]:
    """Returns the options of engines by their names, which are text; else raises CaseError."""
    mapping = {} if options is None else options
    if not isinstance(mapping, Mapping) or not all(map(_text_names, mapping.items())):
        what = f'should be as {{"mujoco": {{"integrator": "RK4"}}}}, is {options!r}'
        raise CaseError([Mistake("options", 0, 0, "", what)])
    return _plain(mapping)


def _text_names(item: tuple[Any, Any], depth: int = 0) -> bool:
    """Whether all names of options are text, and nest no deeper than a file's may."""
    from ...cases.language.document import DEEPEST

    name, value = item
    if not isinstance(value, Mapping):
        return isinstance(name, str)
    deep = depth < DEEPEST and all(_text_names(each, depth + 1) for each in value.items())
    return isinstance(name, str) and deep


def _plain(value: Any) -> Any:
    """Converts numpy's numbers and arrays to Python's, as a file has them."""
    if isinstance(value, Mapping):
        return {name: _plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return value.tolist() if isinstance(value, np.generic | np.ndarray) else value


def _plotted(asked: str | Sequence[str], known: Iterable[str], first: Iterable[str]) -> list[str]:
    """Returns the quantities that are plotted. Raises CaseError of one that is not there."""
    shown = _as_list("quantities", asked, (str,)) or [name for name in first if name in known]
    for name in shown:
        _one_of("quantities", name, known)
    return shown or list(known)[:1]


def _one_of(field: str, name: str, known: Iterable[str]) -> str:
    if name not in (names := list(known)):
        hint = nearest(name, names) or f"; there are {', '.join(names)}"
        raise CaseError([Mistake(field, 0, 0, "", f"no such one: {name!r}{hint}")])
    return name
