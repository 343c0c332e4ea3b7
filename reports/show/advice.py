"""What `textmech advise` prints: the recipe, its price, what to paste, and plain numbers."""

from collections.abc import Iterator, Sequence

from ...engines.engine import Diverged, Tunable
from ...engines.knobs import as_text
from ..judge.plain import plain
from ..search.advised import Advised, row, words
from ..search.candidate import Candidate
from ..search.errors import trial_of
from ..search.price import ratio
from ..search.recipe import front
from ..trial.start import first


def told(one: Advised) -> Iterator[str]:
    """Of one case in one engine, line by line."""
    case, engine, advice = one.pair.case, one.pair.engine, row(one)
    tolerance, margin = one.asked.tolerance, one.asked.margin
    within = "its tolerances" if tolerance is None else f"{tolerance:g} of its size"
    yield ""
    yield f"{case.name} in {engine.name} {engine.version}: all within {within} / {margin:g}"
    if one.kitchen is None:
        yield f"  refused: {advice.remains}"
        return
    yield f"  as shipped    h = {one.shipped.step:g} s: {_worst(one, one.shipped)}"
    if one.recipe is None:
        yield f"  no recipe     {advice.remains}"
    else:
        yield from _recipe(one, one.recipe.candidate, words(one.recipe.choice))
    if one.asked.front:
        yield "  cost against error, each point a fifth better at least than what costs less:"
        yield from (f"    {line}" for line in _front(one))
    yield from _plain(one)


def _recipe(one: Advised, candidate: Candidate, changed: str) -> Iterator[str]:
    assert one.kitchen is not None
    engine, scene = one.pair.engine, one.pair.case.scene
    assert isinstance(engine, Tunable)
    cost = one.kitchen.cost(candidate) / one.kitchen.cost(one.shipped)
    measured = ratio(one.pair, candidate, one.shipped)
    beside = "" if measured is None else f", measured here ×{measured:.2g}"
    yield f"  recipe        {changed}, h = {candidate.step:g} s: {_worst(one, candidate)}"
    yield f"  its cost      ×{cost:.2g} of shipped's{beside}"
    if one.draws is not None:
        yield f"  robust        {one.draws}"
    yield "  to paste"
    start = first(one.pair.reference())
    lines = engine.snippet(scene, start, candidate.options, candidate.step).rstrip().splitlines()
    yield from (f"    {line}" for line in lines)
    yield "  as a file of --settings"
    own = as_text({**candidate.options, "step": candidate.step})
    yield f"    {engine.name}: {own}"


def _worst(one: Advised, candidate: Candidate) -> str:
    assert one.kitchen is not None
    worst, quantity = one.kitchen.bar.worst(candidate)
    return f"{quantity} ×{worst:.2g}" if quantity else "every quantity is lost"


def _front(one: Advised) -> Sequence[str]:
    assert one.kitchen is not None
    return [
        f"{one.kitchen.cost(candidate):9.4g} /s  ×{worst:<8.2g} {quantity:20} "
        f"h = {candidate.step:.3g} s  {as_text(candidate.options)}"
        for candidate, worst, quantity in front(one.kitchen)
    ]


def _plain(one: Advised) -> Iterator[str]:
    """Of shipped, and of the recipe: what a person asks for."""
    both = {"as shipped": one.shipped}
    if one.recipe is not None:
        both |= {"with the recipe": one.recipe.candidate}
    for who, candidate in both.items():
        trial = trial_of(one.pair, candidate)
        try:
            numbers = plain(trial) if trial else []
        except Diverged as gone:
            yield f"  {who}: {gone}"
            continue
        if numbers:
            yield f"  {who}: {'; '.join(map(str, numbers))}"
