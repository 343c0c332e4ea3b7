"""What of the grammar the second reading does not know, and why; all else it has to read.

A word counts as read where it stands in one of these files and a case that is compared uses it.
"""

UNREAD = {
    # of the top of a file: nothing of them moves anything
    "title": "a claim in words",
    "source": "a place in the book",
    "equations": "a place in the book",
    "example": "a place in the book",
    "exercise": "a place in the book",
    "figure": "a place in the book",
    "section": "a place in the book",
    "thread": "a public question",
    "system": "which hand-written system answers",
    "drops_out": "said of parameters",
    "rests": "said of what is claimed",
    "stays": "said of what is claimed",
    "step": "of engines; as a law in time it is read",
    "reach": "of engines",
    "deviates": "of engines",
    "limit": "of engines",
    "by": "of engines",
    "because": "of engines",
    "tube": "of engines: the one case that has it asks nothing beside its events but times",
    # states
    "states": "how a seed draws is not said: `test_random.py` takes what the reference drew",
    "random": "as states",
    "seed": "as states",
    "q": "as states",
    "q_dot": "as states",
    "q_ddot": "as states",
    # the smooth law of dry friction
    "smooth": "(2.95) stands in the book and not in the README; it is compared with the exact law",
    "band": "as smooth",
    "sharpness": "as smooth",
}
"""Words of the grammar that are not read, with the reason."""

UNDRAWN = {
    "ahead_of": "only two walkers have it",
    "spokes": "only the rimless wheel has it",
    "number": "of spokes",
}
"""Words that no random scene has, though shipped cases do, with the reason."""
