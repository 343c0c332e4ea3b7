"""A user's model in lines: what it is, how it is run, what each claim covers, and a script."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from operator import itemgetter
from textwrap import wrap

from ....cases.fields.signal import Signal
from ....cases.mistake import CaseError, plain
from ....cases.model_case import JOINTS, Law, ModelCase
from ....cases.tree import CONSTRAINTS, DRIVEN, PARTS
from ....engines.own_model import description
from ....engines.own_model.limit import PAIRS, apart_by_pairs
from ....engines.own_model.model import VERSION, OwnModel
from ....engines.own_model.opened import Opened, opened
from ....engines.own_model.script import script
from ....engines.own_model.static import short_times
from ....engines.own_model.step_law import with_step
from ...compare.own_steps import Setting, integrator_of, times_of

WIDTH = 96
GAP = "  "


def described(case: ModelCase) -> list[str] | CaseError:
    """Returns the lines that say what a model is, or why it is none."""
    try:
        return [plain(line) for line in _lines(case, opened(case))]
    except CaseError as error:
        return error


def _lines(case: ModelCase, ready: Opened) -> Iterator[str]:
    own = ready.own
    if case.title:
        yield f"{case.name}: {case.title}"
    yield f"{case.path if case.source.lines else case.file}: {own}"
    yield from _section("model", description.identity(own.model))
    yield from _section("options", description.options(own.model))
    for table in (description.joints(own), description.motors(own)):
        yield from _table(table)
    yield from ("", *_section("start", [own.started]))
    yield from _section("control", [f"{name}: {_law(law)}" for name, law in case.control.items()])
    contacts = [] if case.contacts else ["without contacts"]
    run = [f"{case.duration:.4g} s", f"{case.samples} samples", *contacts]
    yield from _section("run", run)
    yield from _section("tolerance", _tolerances(case, ready))
    yield from ("", *_claims(own), "", "  --engine mujoco prints a script that runs it", "")


def _section(name: str, words: Sequence[str]) -> Iterator[str]:
    indent = f"  {name:10} "
    text = ", ".join(map(plain, words))
    yield from wrap(text, WIDTH, initial_indent=indent, subsequent_indent=" " * len(indent))


def _table(table: Sequence[Sequence[str]]) -> Iterator[str]:
    if len(table) < 2:
        return
    yield ""
    rows = [[plain(cell) for cell in row] for row in table]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (f"{cell:{width}}" for cell, width in zip(row, widths, strict=True))
        yield f"  {GAP.join(cells)}".rstrip()


def _law(law: Law) -> str:
    if not isinstance(law, Signal):
        return f"{len(law.corners) + 1} values, each held"
    size, w, times = f"{law.amplitude[0]:.4g}", law.angular_frequency, law.times
    return {
        "constant": lambda: size,
        "ramp": lambda: f"{size} t",
        "sine": lambda: f"{size} sin({w:.4g} t + {law.phase:.4g})",
        "step": lambda: f"{size} from {times[0]:.4g} s on",
        "pulse": lambda: f"{size} from {times[0]:.4g} s to {times[1]:.4g} s",
        "polynomial": lambda: " + ".join(f"{c:.4g} t^{k}" for k, c in enumerate(law.values)),
        "table": lambda: f"{len(times)} values, lines between",
    }[law.law]()


def _tolerances(case: ModelCase, ready: Opened) -> list[str]:
    """Returns each tolerance, that of all joints once."""
    bars = {q.name: f"{q.name} {bar:.4g} {q.unit}".rstrip() for q, bar in ready.bars.items()}
    joints = case.allow.get(JOINTS)
    words = [] if joints is None else [f"each joint {joints.value:.4g} rad or m"]
    return words + [bars[name] for name in case.allow if name != JOINTS]


def _claims(own: OwnModel) -> Iterator[str]:
    m = own.model
    if not m.nv:
        yield "  nothing moves, and nothing is compared"
        return
    constraints = _and(description.constraints(m))
    yield "  equations, against the textbook's by `textmech check`"
    for part in PARTS:
        nothing = part == DRIVEN and not own.tree.motors
        compared = "nothing drives it" if nothing else "compared"
        words = [f"not compared: {what}" for what in own.tree.unread.get(part, ())] or [compared]
        yield from (f"    {part:15}  {each}" for each in words)
    if constraints:
        yield f"    {CONSTRAINTS:15}  {constraints}: their forces compared, where they act"
    yield "  motion, until a constraint acts, against our own reference by `textmech run`"
    unread = f"not compared: {_and([*own.tree.unread])} are not read as a whole"
    yield f"    {unread if own.tree.unread else 'compared'}"
    yield "  step, against its own limit for h → 0 by `textmech run`"
    reasons = with_step(own)
    yield from (f"    no limit: {reason}" for reason in reasons)
    if not reasons:
        yield f"    compared{f', with {constraints}' if constraints else ''}"
    least = f"is below 2h = {2 * m.opt.timestep:.3g} s; the law is what refsafe makes of that"
    for time, each in groupby(sorted(short_times(own), key=itemgetter(1)), key=itemgetter(1)):
        names = ", ".join(name for name, _ in each)
        text = f"solref {time:.3g} s {least}: {names}"
        yield from wrap(text, WIDTH, initial_indent="    ", subsequent_indent="      ")
    if apart_by_pairs(m):
        yield f"    no finer steps: {PAIRS}"


def _and(words: Sequence[str]) -> str:
    *others, last = words or [""]
    return f"{', '.join(others)} and {last}" if others else last


def script_lines(case: ModelCase, setting: Setting) -> list[str] | CaseError:
    """Returns a script that runs a model as `textmech run` does, or why there is none."""
    try:
        own = opened(case).own
    except CaseError as error:
        return error
    h = setting.step or own.model.opt.timestep
    times = times_of(case, [h])
    steps, every = round(float(times[-1]) / h), round(float(times[1]) / h)
    head = [
        f"{case.name}: {case.title}" if case.title else case.name,
        f"MuJoCo {VERSION}, {setting.name}: {integrator_of(own, setting)}, h = {h:.6g} s",
        f"{own.started}; {steps} steps are {float(times[-1]):.6g} s",
        "printed: time [s] and qpos",
    ]
    lines = script(own, case.path, setting.options, h, steps, every)
    return [*(f"# {plain(line)}" for line in head), *lines]
