"""The short table: one row a case, one column an engine's setting."""

from collections.abc import Iterator

import pandas as pd

from reports.row import AGREES, FAILS


def summary(tolerance: pd.DataFrame, convergence: pd.DataFrame) -> pd.DataFrame:
    """How many quantities agree, the worst ratio to its tolerance, and the usable step.

    The usable step is the largest from which on *all* quantities stay within their tolerance.
    """
    rows = tolerance[tolerance["quantity"] != "audit"]
    columns = ["engine", "setting", "realised"]
    table: dict[str, dict[str, str]] = {}
    for (case, *key), group in rows.groupby(["case", *columns], sort=True):
        steps = convergence[
            (convergence["case"] == case) & (convergence[columns] == key).all(axis=1)
        ]
        name = ".".join(key[:2]) + ("" if key[2] == "native" else f" ({key[2]})")
        table.setdefault(name, {})[case] = "; ".join(_cell(group, steps))
    return pd.DataFrame(table).fillna("").rename_axis("case").reset_index()


def _cell(group: pd.DataFrame, steps: pd.DataFrame) -> Iterator[str]:
    judged = group[~group["verdict"].str.startswith("refused")]
    refused = len(group) - len(judged)
    if judged.empty:
        yield "refused"
        return
    agrees = int((judged["verdict"] == AGREES).sum())
    fails = int((judged["verdict"] == FAILS).sum())
    if fails:
        yield f"{fails} FAIL"
    if judged["ratio"].isna().all():
        yield str(judged["verdict"].iloc[0])
    elif agrees == len(judged):
        yield "agrees"
    else:
        worst = judged.loc[judged["ratio"].idxmax()]
        yield f"{len(judged) - agrees} of {len(judged)} beyond, {worst['quantity']} ×{worst['ratio']:.2g}"
    usable = steps["usable_step"]
    if len(usable) and not usable.isna().any():
        yield f"h ≤ {usable.min():.1g}"
    if refused:
        yield f"{refused} not read"


def markdown(table: pd.DataFrame) -> str:
    """The table for the README."""
    lines = ["| " + " | ".join(table.columns) + " |", "|" + "---|" * len(table.columns)]
    lines += ["| " + " | ".join(str(x) for x in row) + " |" for row in table.itertuples(index=False)]
    return "\n".join(lines) + "\n"
