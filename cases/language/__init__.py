"""The language of case files: from YAML text to a checked `Case`, with all mistakes at once.

text → `document` (YAML, `tree`; its variants by `cases.load`) → `parse` (`grammar`: what may stand
where) → `check`, `links`, `claims` (what must fit together) → `resolve` (a Case).
"""
