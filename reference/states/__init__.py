"""The reference of claims about states: every quantity at each of them, by two derivations."""
