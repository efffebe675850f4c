"""What the tables of compare.py say, computed from the CSV files of peer_bench."""
import numpy as np
import pandas as pd

MOVED = 0.10  # m: the verdict 'moved' of a box, as in `holdfast screen`
AGREED = 1e-3  # m: within which the references must agree on a box
CAP = 10e-3  # m: a box that is further off counts as much as one that is just this far off
WORLD = ["layout", "acceleration"]


def cpu_per_second(worlds):
    """Processor seconds per simulated second of every setting: over all worlds, each at the median of its repeats."""
    each = worlds.groupby(["setting", *WORLD], sort=False)[["cpu_seconds", "simulated_seconds"]].median()
    total = each.groupby("setting").sum().reindex(worlds["setting"].unique())
    return total["cpu_seconds"] / total["simulated_seconds"]


def largest(worlds):
    """The largest displacement of a world, m: one row per world, one column per setting."""
    return worlds[worlds["repeat"] == 0].pivot(index=WORLD, columns="setting", values="peak_displacement")


def verdict_errors(worlds, references):
    """Wrong verdicts and the median difference of the largest displacement, of every setting.

    The truth is where all references say the same about 'a box moved 10 cm'; the other worlds are left out. A world
    that failed is wrong. Returns (table, worlds that count, all worlds, how far the references are apart in the median).
    """
    true = largest(references)
    moved = true > MOVED
    agreed = true.notna().all(axis=1) & (moved.nunique(axis=1) == 1)
    true, moved = true[agreed], moved[agreed].iloc[:, 0]
    middle = true.mean(axis=1)
    found = largest(worlds).reindex(true.index)
    rows = {}
    for setting in worlds["setting"].unique():
        of_setting = found[setting]
        wrong = ((of_setting > MOVED) != moved) | of_setting.isna()
        rows[setting] = {"wrong": int(wrong.sum()), "difference": (of_setting - middle).abs().median()}
    apart = (true.max(axis=1) - true.min(axis=1)).median()
    return pd.DataFrame.from_dict(rows, orient="index"), len(true), len(agreed), apart


def accepted(worlds):
    """Whether no box ever goes beyond a limit, in a world that did not fail: one row per world, one column per setting."""
    stayed = worlds.assign(accepted=worlds["verdict"] == "stayed")
    return stayed.pivot(index=["friction", *WORLD], columns="setting", values="accepted")


def wrong_answers(answers, references):
    """Which answers to "does it hold?" are wrong: one row per layout, one column per setting.

    A layout holds when its largest displacements under all accelerations are below the limit in all references, and does
    not when it is above under one acceleration in all of them; other layouts are left out. Returns (table, layouts that
    hold, layouts that count, all layouts).
    """
    moved = (largest(references) > MOVED).groupby("layout")
    holds, fails = ~moved.any().any(axis=1), (largest(references) > MOVED).all(axis=1).groupby("layout").any()
    true = holds[holds | fails]
    found = answers.pivot(index="layout", columns="setting", values="holds").reindex(true.index).astype(bool)
    return found.ne(true, axis=0)[answers["setting"].unique()], int(true.sum()), len(true), len(holds)


def consensus(references):
    """The boxes on which all references agree at a time: (their mean positions, the share that agrees per time)."""
    index = [*WORLD, "time", "box"]
    points = references.set_index([*index, "setting"])[["x", "y", "z"]].unstack("setting").dropna()
    settings = points.columns.get_level_values("setting").unique()
    of_setting = [points.xs(setting, axis=1, level="setting") for setting in settings]
    middle = sum(of_setting) / len(of_setting)
    apart = pd.Series(0.0, index=points.index)
    for i, first in enumerate(of_setting):
        for second in of_setting[i + 1:]:
            apart = np.maximum(apart, np.sqrt(((first - second)**2).sum(axis=1)))
    agreed = apart <= AGREED
    return middle[agreed], agreed.groupby("time").mean()


def consensus_errors(positions, middle):
    """Distance from the consensus, m, as three tables: the mean and the root mean square of the capped distance, and the
    median; one row per setting, one column per time. A box without a position counts as the cap."""
    index = [*WORLD, "time", "box"]
    tables = {"mean": {}, "rms": {}, "median": {}}
    for setting, found in positions.groupby("setting", sort=False):
        found = found.set_index(index)[["x", "y", "z"]].reindex(middle.index)
        distance = np.sqrt(((found - middle)**2).sum(axis=1, skipna=False)).fillna(np.inf)
        capped = distance.clip(upper=CAP)
        tables["mean"][setting] = capped.groupby("time").mean()
        tables["rms"][setting] = np.sqrt((capped**2).groupby("time").mean())
        tables["median"][setting] = distance.groupby("time").median()
    return {name: pd.DataFrame(table).T for name, table in tables.items()}


def cost_of_sizes(worlds):
    """Milliseconds per simulated second: one row per setting, one column per nominal number of boxes."""
    sized = worlds.assign(ms=1e3 * worlds["cpu_seconds"] / worlds["simulated_seconds"])
    table = sized.pivot_table(index="setting", columns="size", values="ms", aggfunc="mean")
    return table.reindex(worlds["setting"].unique())


def exponents(costs):
    """The power of the number of boxes that the cost grows with, of every setting: least squares of the logarithms."""
    sizes = np.log(costs.columns.to_numpy(dtype=float))
    return pd.Series({setting: np.polyfit(sizes, np.log(row.to_numpy(dtype=float)), 1)[0]
                      for setting, row in costs.iterrows()})


def pareto_front(cost, error):
    """The settings that no other one beats in cost and error, in the order of their costs."""
    front, best = [], np.inf
    for setting in sorted(cost.index, key=lambda name: (cost[name], error[name])):
        if error[setting] < best:
            front.append(setting)
            best = error[setting]
    return front
