"""A second reading of the case language, written from `cases/README.md` alone.

Nothing here imports textmech, but the tests, which ask the reference for its motion and compare.
Files become plain dictionaries; every body has its own coordinates, every joint its rows between
them; accelerations and reactions are solved for together and integrated by SciPy's DOP853. What
switches is followed from event to event, and at each one every combination of open, stuck and
sliding is tried. `test_words.py` lists what of the grammar is not read here, and why.
"""
