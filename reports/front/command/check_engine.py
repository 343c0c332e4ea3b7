"""`textmech check-engine`."""

import pickle
from collections.abc import Sequence
from dataclasses import asdict
from textwrap import wrap
from typing import TYPE_CHECKING

import click

from ....cases.mistake import CaseError, Mistake, nearest
from ..show.console import say
from .options import FAILED, as_json, jobs

if TYPE_CHECKING:
    from ....engines.engine import Engine
    from ...compare.adapter_check import Mark

WIDTH = 100  # columns: a grade, and what is said of it
DOCUMENTED = "engines/README.md, The protocol; the fields of a scene: engines/SCENE.md"


@click.command("check-engine", short_help="Whether an adapter of an engine is right, step by step.")
@click.argument("name")
@click.argument("grades", nargs=-1, metavar="[GRADE]...")
@jobs
@as_json
def check_engine(name: str, grades: tuple[str, ...], jobs: int | None, wants_json: bool) -> None:
    """Whether an engine's adapter is right, from the easiest case on: for whoever writes one.

    NAME is an installed engine, as `toy`, or with its setting, as `toy.shipped`; of an engine alone
    its tuned setting is taken, or what else it offers. First its members are looked at, then
    shipped cases are run: a particle that falls, a pendulum, joints, loops, forces, drives,
    contact, friction, impacts, space, states. Of each GRADE, or of all, it is said:

    \b
      works      within 5 % of the motion; how near, is what `textmech run` measures
      refused    for the engine's own reason, which is no mistake
      wrong      by how much, at a quarter of the step too. `as if` tells a typical mistake of the
                 readout that explains it: the motion agrees once that is undone. Where none is
                 told, look at what the engine is given of the scene, and at its own model
      crashed    it raised an exception, ended its process, or took too long
      not there  an optional member, and what is lost without it

    \b
      textmech check-engine toy                       all grades
      textmech check-engine toy falls pendulum        two of them
      textmech check-engine mujoco.shipped --json     for scripts

    The exit code is 0 if all works or is refused, 1 if something is wrong or crashed, and 2 if
    there is no such engine or grade. How an engine is written: engines/README.md.
    """
    from ..show.document import write

    engine, marks = _engine(name)
    if engine is not None:
        marks += _marks(engine, grades, jobs)
    code = FAILED if any(mark.fails for mark in marks) else 0
    if wants_json:
        who = {"engine": name.partition(".")[0], "setting": engine and engine.setting}
        write({**who, "marks": [asdict(mark) for mark in marks], "exit_code": code})
    else:
        for mark in marks:
            for line in _lines(name, mark):
                say(line)
        say(_sum(marks))
    raise click.exceptions.Exit(code)


def _engine(name: str) -> "tuple[Engine | None, list[Mark]]":
    """Returns an engine, or marks why it cannot be made. Raises CaseError for an unknown name."""
    from .... import engines
    from ...compare.adapter_check import Mark

    word, _, setting = name.partition(".")
    if word not in engines.names():
        raise CaseError([_unknown(name, engines.names())])
    try:
        offers = engines.settings(word)
        if setting and setting not in offers:
            raise CaseError([_unknown(name, [f"{word}.{offered}" for offered in offers])])
        engine = engines.make(word, setting or ("tuned" if "tuned" in offers else offers[0]))
        pickle.loads(pickle.dumps(engine))
    except engines.Broken as broken:
        return None, [Mark("protocol", "", "wrong", str(broken))]
    except (pickle.PicklingError, TypeError, AttributeError) as error:
        what = f"it cannot cross into another process: {error}"
        return None, [Mark("protocol", "", "wrong", what)]
    return engine, []


def _unknown(name: str, known: Sequence[str]) -> Mistake:
    return Mistake(name, 0, 0, "", f"no such engine{nearest(name, known)}")


def _marks(engine: "Engine", words: Sequence[str], jobs: int | None) -> "list[Mark]":
    """Returns the marks of an engine's members and grades, each tried in its own process."""
    from ...compare.adapter_check import GRADES, Attempt, marked, members
    from ...runs.processes.pool import Died, local, spread, workers
    from ...runs.selection import choose_cases
    from ..show.progress import progress

    names = {grade.name: grade for grade in GRADES}
    if wrong := [word for word in words if word not in names]:
        what = f"no such grade{nearest(wrong[0], names)}"
        raise CaseError([Mistake(wrong[0], 0, 0, "", f"{what}; there are {', '.join(names)}")])
    marks = members(engine)
    if any(mark.fails for mark in marks):
        return marks
    chosen = [names[word] for word in words] or list(GRADES)
    attempts = [Attempt(g, choose_cases([g.case], known=None)[0], engine) for g in chosen]
    by_index: dict[int, Mark] = {}
    with progress() as listener, local(min(jobs or workers(), len(attempts))) as working:
        for index, mark in spread(marked, attempts, working):
            if isinstance(mark, Died):
                mark = attempts[index].mark("crashed", mark.because)
            by_index[index] = mark
            done = len(by_index) / len(attempts)
            listener("grades", len(by_index), len(attempts), attempts[index].name, done)
    return marks + [by_index[index] for index in range(len(attempts))]


def _lines(name: str, mark: "Mark") -> list[str]:
    head = f"{mark.outcome:11}{mark.grade:26}"
    more = [f"as if {what}" for what in mark.likely]
    if mark.fails and mark.case:
        more.append(f"to look closer: textmech run {mark.case} --engine {name}")
    texts = [f"{head}{mark.what}".rstrip(), *(" " * len(head) + text for text in more)]
    indent = " " * len(head)
    return [line for text in texts for line in wrap(text, WIDTH, subsequent_indent=indent)]


def _sum(marks: "Sequence[Mark]") -> str:
    counts = {mark.outcome: 0 for mark in marks}
    for mark in marks:
        counts[mark.outcome] += 1
    counted = ", ".join(f"{count} {outcome}" for outcome, count in counts.items())
    return f"\n{counted}; what is asked for: {DOCUMENTED}"
