"""The mechanism of any scene, in maximal coordinates with multipliers."""
