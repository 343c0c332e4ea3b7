"""A system followed from event to event, and its bodies' states on the way."""
