"""Says of a user's model what it is, how far off its steps are, and what of it is compared."""

from collections.abc import Iterator, Mapping, Sequence

from ....cases.mistake import plain
from ...compare import own_equations
from ...compare.own_rows import Modelled, worst_of
from ...compare.own_steps import Stepped, Steps
from ...tables.model_line import ModelLine
from ...tables.row import REFUSED, Comparison
from ...tables.short_numbers import factor, milliseconds
from ...tables.spoken import spoken

HEAD = (
    f"  {'setting':13} {'integrator':13} {'step':>8}  {'worst':24}{'off by':>12} {'at':>7}"
    f"{'of allowed':>12}"
)


FEW = 3  # models: of more there is one table, a row each


def overview(models: Sequence[ModelLine]) -> str:
    """Returns a table, a row a model."""
    head = ("model", "own setting, of allowed", "kept from", "cure", "and")
    rows = [head, *map(cells, models)]
    if not any(model.cure for model in models):
        rows = [(*row[:3], row[4]) for row in rows]
    *wide, _ = zip(*rows, strict=True)
    widths = [max(map(len, column)) for column in wide]
    return "\n".join(
        "  ".join([*(f"{cell:{wide}}" for cell, wide in zip(row, widths, strict=False)), row[-1]])
        .rstrip() for row in rows
    )  # fmt: skip


def cells(model: ModelLine) -> tuple[str, ...]:
    """Returns a model's row in words: name, own setting, what keeps all, cure, and what beside."""
    own = spoken(model.verdict)
    if model.ratio is not None:
        own = f"{model.quantity} {factor(model.ratio)}"
    keeps = model.keeps
    if model.keeps_step is not None:
        keeps = f"{keeps} {milliseconds(model.keeps_step)}"
    unread = f"not compared: {len(model.not_compared.split('; '))}" if model.not_compared else ""
    remark = "; ".join(filter(None, [model.because, model.seen, unread]))
    return tuple(map(plain, (model.case, own, keeps, model.cure.partition(";")[0], remark)))


def model_lines(model: Modelled) -> Iterator[str]:
    """Returns the lines of a model."""
    head = f"{model.case.name}: {model.model}" if model.model else model.case.name
    yield plain(head)
    if model.because:
        yield plain(f"  {model.because}")
    if model.steps is not None:
        yield from map(plain, _steps(model, model.steps))
    if model.parts:
        yield ""
        yield "  its equations of motion"
        yield from own_equations.lines(model.parts)
    yield ""


def _steps(model: Modelled, steps: Steps) -> Iterator[str]:
    end, limit = float(steps.limit.times[-1]), steps.limit
    yield f"  {model.started}, over {end:.3g} s, at {len(limit.times)} samples"
    yield f"  its limit for h → 0 by {limit.method}, known to {steps.known:.0e} rad or m"
    if steps.late:
        yield f"  judged until {steps.until:.3g} s: {steps.late}"
    if steps.note:
        yield f"  no finer steps: {steps.note}"
    yield from (f"  {words}" for words in [*model.seen.joints.values(), *model.seen.beside])
    yield ""
    yield f"{HEAD}  order  keeps all from"
    rows: dict[str, list[Comparison]] = {}
    for row in model.comparisons:
        rows.setdefault(row.setting, []).append(row)
    for stepped in steps.settings:
        yield f"  {_line(model, stepped, rows[stepped.setting.name])}".rstrip()


def _line(model: Modelled, stepped: Stepped, rows: Sequence[Comparison]) -> str:
    setting = stepped.setting
    worst = worst_of(rows)
    orders: Mapping[str, float | None] = {
        row.quantity: row.order for row in model.rungs if row.setting == setting.name
    }
    order = orders.get(worst.quantity)
    name = f"{setting.name:13} {model.integrators[setting.name]:13}"
    head = f"{name} {milliseconds(setting.step):>8}"
    if worst.error is None:
        return f"{head}  {spoken(worst.verdict)}"
    size = f"{worst.error:.1e} {worst.unit}".rstrip()
    ratio = factor(worst.ratio or 0.0)
    keeps = "none tried" if stepped.keeps is None else milliseconds(stepped.keeps)
    if worst.verdict == REFUSED:
        keeps = worst.because
    when = "" if worst.when is None else f"{worst.when:.3g} s"
    columns = f"{head}  {worst.quantity:24} {size:>11} {when:>7} {ratio:>11}"
    return f"{columns}  {'' if order is None else f'{order:.1f}':>5}  {keeps}"
