#!/usr/bin/python3
"""Speed against error of native, Box3D and Jolt: loads that are asked whether they hold, and road, gentle, sampled,
harsh and large loads. README.md says what the numbers mean.

Example: bench/peers/compare.py build/release/bin/peer_bench --output build/peers
"""
import argparse
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "peers"})
import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.transforms import Bbox

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import peer_statistics as statistics
from peer_runs import (ACCELERATIONS, BENCH, HARSH_LOADS, Runner, asked_loads, files_of, generated_loads, loose_loads,
                       sampled_accelerations, weaker_accelerations)
from tables import replace_tables, table_of

BASE = "native-screening"
KINDS = ["holds", "search", "road", "loose", "gentle", "sampled", "harsh", "large", "random"]
SETTINGS = {
    "holds": [BASE, f"{BASE}:StepsPerSecond=30:Iterations=10", "native-standard", "box3d-60x4s", "box3d-60x8ks",
              "box3d-60x16ks", "jolt-60s", "jolt-240s"],
    "road": [BASE, f"{BASE}:StepsPerSecond=30:Iterations=10", "native-standard", "box3d-60x4s", "box3d-60x8ks",
             "box3d-60x16ks", "box3d-240x4s", "box3d-240x4ks", "jolt-60s", "jolt-60ps", "jolt-240s", "jolt-240ps"],
    "gentle": [BASE, "native-standard", "box3d-60x4s", "box3d-60x4", "box3d-60x16ks", "jolt-60s", "jolt-60ps"],
    "sampled": [BASE, "native-standard", "box3d-60x4s", "box3d-60x16ks", "jolt-60s"],
    "harsh": [BASE, f"{BASE}:Iterations=64", f"{BASE}:StepsPerSecond=240:Iterations=32", "native-standard",
              "box3d-60x4s", "box3d-60x8ks", "box3d-60x16ks", "box3d-60x32ks", "box3d-240x4s", "box3d-240x4ks", "jolt-60s",
              "jolt-240s", "jolt-480x20x4s", "jolt-480x20x4ps"],
    "large": [BASE, "box3d-60x4s", "box3d-60x16ks", "jolt-60s", "jolt-240ps"],
    "random": [BASE, "native-standard", "box3d-60x4s", "box3d-60x16ks"],
}
REFERENCES = {"random": ["box3d-480x4k"],
              "road": ["box3d-960x4k", "jolt-960"],
              "harsh": [f"{BASE}:StepsPerSecond=960:Iterations=400", "box3d-1920x4k", "jolt-960"]}
SETTINGS["loose"], REFERENCES["loose"] = SETTINGS["road"], REFERENCES["road"]
SETTINGS["search"], REFERENCES["holds"], REFERENCES["search"] = SETTINGS["holds"], REFERENCES["road"], REFERENCES["road"]
ROAD = [ACCELERATIONS / f"road_{name}.txt" for name in ("brake_0g8", "rearward_0g5", "corner_left_0g5", "corner_right_0g5")]
PROBLEMS = [3, 5, 7, 10]  # of Bischoff and Ratcliff, that the searches load containers with
ASKED_LOADS = 20  # of each search, evenly chosen among those that it asks for
TIMES = [0.1, 0.2, 0.5, 0.7, 2.0]  # s, of the harsh loads
SIZES = [100, 200, 400, 600]  # boxes of the large loads
GENTLE_REPEATS = 3  # a world takes a few milliseconds, as long as it takes a process to get its first memory
LARGE_LOADS = 8  # of each size: the time of one may be twice that of another
FRICTIONS = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]  # of the random loads
RANDOM_LOADS = 15  # of each friction


def number(value):
    """Two or three significant digits, without an exponent."""
    return f"{value:.0f}" if abs(value) >= 99.5 else f"{value:.2g}"


def label_points(axes, x, y):
    """Writes the name of each point beside it, where it covers nothing, if there is such a place."""
    taken = [axes.get_legend().get_window_extent()]
    taken += [Bbox.from_bounds(*axes.transData.transform((x[name], y[name])) - 4, 8, 8) for name in x.index]
    places = [(dx, dy, side) for dy in (4, -9, 12, -17) for dx, side in ((5, "left"), (-5, "right"))]
    for name in x.index:
        label = axes.annotate(name, (x[name], y[name]), textcoords="offset points", xytext=(0, 0), fontsize=7)
        for dx, dy, side in places:
            label.xyann = (dx, dy)
            label.set_horizontalalignment(side)
            box = label.get_window_extent()
            if axes.bbox.x0 <= box.x0 and box.x1 <= axes.bbox.x1 and not any(box.overlaps(other) for other in taken):
                break
        taken.append(box)


class Comparison:
    """The tables of all kinds of loads, and the fronts that the plot shows."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.runner = Runner(arguments.program, arguments.output)
        self.fronts = []  # (title, cost, label of the error, error)

    def settings(self, kind):
        return self.arguments.settings or SETTINGS[kind]

    def relative(self, worlds):
        cpu = statistics.cpu_per_second(worlds)
        return cpu, cpu / cpu[BASE if BASE in cpu else cpu.index[0]]

    def holds(self):
        """What a search asks: whether loads hold, with the bundled ones."""
        layouts = files_of(self.arguments.layouts, self.arguments.most)
        title = "Does it hold? The layouts of the road, with 1 mm of play"
        return self.asked("holds", title, loose_loads(self.arguments.output / "loose_road", layouts), ROAD)

    def search(self):
        """The same with the loads that searches have asked for, under accelerations of which some of them hold all."""
        accelerations = weaker_accelerations(self.arguments.output / "weaker")
        layouts = [load for problem in PROBLEMS
                   for load in asked_loads(self.arguments, problem, accelerations, ASKED_LOADS)]
        title = "Does it hold? Loads of searches, with 1 mm of play, under 0.6 g to the front and 0.4 g to the other sides"
        return self.asked("search", title, loose_loads(self.arguments.output / "loose_asked", layouts), accelerations)

    def asked(self, kind, title, layouts, accelerations):
        """The table of layouts that are asked whether they hold all accelerations."""
        known, _ = self.runner.references(kind, layouts, accelerations, self.references(kind))
        answers = self.runner.ask(kind, layouts, accelerations, self.settings(kind))
        wrong, holding, counted, every = statistics.wrong_answers(answers, known)
        costs = answers.groupby("setting", sort=False).agg(cpu=("cpu_seconds", "sum"), asked=("layout", "size"),
                                                           worlds=("worlds", "mean"))
        per_second = costs["asked"] / costs["cpu"]
        relative = per_second[BASE if BASE in per_second else per_second.index[0]] / per_second
        self.fronts.append((kind, relative, f"wrong answers of {counted}", wrong.sum().astype(float)))
        title = (f"{title}: {every} loads under {len(accelerations)} accelerations. {' and '.join(known['setting'].unique())} "
                 f"agree on {counted} loads, of which {holding} hold.")
        rows = [[name, number(relative[name]), number(per_second[name]), f"{costs['worlds'][name]:.1f}",
                 str(wrong[name].sum())] for name in per_second.index]
        return table_of(title, ["setting", "CPU, relative", "loads per CPU s", "worlds per load", f"wrong of {counted}"], rows)

    def road(self):
        return self.verdicts("road", "Road", files_of(self.arguments.layouts, self.arguments.most))

    def loose(self):
        layouts = files_of(self.arguments.layouts, self.arguments.most)
        return self.verdicts("loose", "Road, with 1 mm of play", loose_loads(self.arguments.output / "loose_road", layouts))

    def verdicts(self, kind, title, layouts):
        """The table of layouts under the accelerations of the road."""
        accelerations = [ACCELERATIONS / f"road_{name}.txt" for name in ("brake_0g8", "rearward_0g5", "corner_left_0g5")]
        known, _ = self.runner.references(kind, layouts, accelerations, self.references(kind))
        worlds, _ = self.runner.run(kind, layouts, accelerations, self.settings(kind))
        errors, counted, every, apart = statistics.verdict_errors(worlds, known)
        cpu, relative = self.relative(worlds)
        title = (f"{title}: {len(layouts)} layouts under three accelerations. {' and '.join(known['setting'].unique())} agree "
                 f"on {counted} of {every} worlds; their largest displacements differ by {1e3 * apart:.1f} mm in the median.")
        self.fronts.append((kind, relative, f"wrong verdicts of {counted}", errors["wrong"].astype(float)))
        rows = [[name, number(relative[name]), number(cpu[name]), str(row["wrong"]), number(1e3 * row["difference"])]
                for name, row in errors.astype(object).iterrows()]
        return table_of(title, ["setting", "CPU, relative", "CPU s per simulated s", f"wrong of {counted}", "difference, mm"],
                        rows)

    def gentle(self):
        layouts = files_of(self.arguments.layouts, self.arguments.most)
        worlds, _ = self.runner.run("gentle", layouts, [ACCELERATIONS / "lane_change_2ms2.txt"], self.settings("gentle"),
                                    repeats=GENTLE_REPEATS)
        cpu, relative = self.relative(worlds)
        found = statistics.largest(worlds)
        rows = [[name, number(relative[name]), number(cpu[name]), str(int((found[name] > statistics.MOVED).sum())),
                 number(1e3 * found[name].median())] for name in cpu.index]
        return table_of(f"Gentle: {len(layouts)} layouts under a lane change of 0.2 g.",
                        ["setting", "CPU, relative", "CPU s per simulated s", "worlds that moved",
                         "largest displacement, mm: median"], rows)

    def sampled(self):
        layouts = files_of(self.arguments.layouts, self.arguments.most)
        columns = {}
        for what, path in zip(("lane change", "brake"), sampled_accelerations(self.arguments.output / "sampled")):
            worlds, _ = self.runner.run("sampled", layouts, [path], self.settings("sampled"))
            cpu, relative = self.relative(worlds)
            moved = statistics.largest(worlds) > statistics.MOVED
            columns |= {f"{what}: CPU, relative": relative.map(number), "CPU s per simulated s, " + what: cpu.map(number),
                        "worlds that moved, " + what: moved.sum().astype(str)}
        rows = [[name, *[column[name] for column in columns.values()]] for name in cpu.index]
        return table_of(f"Sampled: {len(layouts)} layouts under a lane change of 0.2 g and a braking of 0.8 g, curves of 50 samples "
                        "per second.", ["setting", *columns], rows)

    def harsh(self):
        layouts = loose_loads(self.arguments.output / "harsh", HARSH_LOADS)
        acceleration = [BENCH / "to_and_fro.txt"]
        at_times = lambda table: table[table["time"].round(6).isin(TIMES)].assign(time=lambda t: t["time"].round(6))
        _, known = self.runner.references("harsh", layouts, acceleration, self.references("harsh"), interval=0.1)
        middle, share = statistics.consensus(at_times(known))
        worlds, positions = self.runner.run("harsh", layouts, acceleration, self.settings("harsh"), interval=0.1)
        errors = statistics.consensus_errors(at_times(positions), middle)
        cpu, relative = self.relative(worlds)
        shares = ", ".join(f"{100 * share[time]:.0f}" for time in TIMES)
        title = (f"Harsh: {len(layouts)} layouts with 1 mm of play, to and fro. Error in mm, mean / median, over the boxes on "
                 f"which {', '.join(known['setting'].unique())} agree to 1 mm: {shares} %.")
        self.fronts.append(("harsh", relative, "error, mm: mean over boxes and times", 1e3 * errors["mean"].mean(axis=1)))
        rms = 1e3 * errors["rms"].mean(axis=1)
        rows = [[name, number(relative[name]),
                 *[f"{1e3 * errors['mean'][t][name]:.2f} / {1e3 * errors['median'][t][name]:.2f}" for t in TIMES],
                 f"{rms[name]:.2f}"] for name in cpu.index]
        return table_of(title, ["setting", "CPU, relative", *[f"{time:g} s" for time in TIMES], "root mean square"], rows)

    def large(self):
        loads = {size: generated_loads(self.arguments.output / "large" / str(size), LARGE_LOADS, "--boxes", size, size)
                 for size in SIZES}
        tables = []
        for what, file in (("lane change", "lane_change_2ms2.txt"), ("brake, 0.8 g", "road_brake_0g8.txt")):
            parts = []
            for size, layouts in loads.items():
                worlds, _ = self.runner.run(f"large_{size}", layouts, [ACCELERATIONS / file], self.settings("large"))
                parts.append(worlds.assign(size=size))
            every = pd.concat(parts)
            costs = statistics.cost_of_sizes(every)
            exponent = statistics.exponents(costs)
            fell = every.assign(fell=every["fallen"] > 0).groupby("setting", sort=False)["fell"].sum()
            rows = [[name, *[number(costs[size][name]) for size in SIZES], f"{exponent[name]:.2f}", str(fell[name])]
                    for name in costs.index]
            tables.append(table_of(f"Large, {what}: CPU ms per simulated second, {LARGE_LOADS} layouts of each number of boxes.",
                                   ["setting", *map(str, SIZES), "exponent", f"fell, of {LARGE_LOADS * len(SIZES)}"], rows))
        return "\n\n".join(tables)

    def random(self):
        """What is let pass among generated loads with gaps, by the whole journey, beside a peer's reference."""
        accelerations = sorted(ACCELERATIONS.glob("*.txt"))
        parts = []
        for seed, friction in enumerate(FRICTIONS, start=1):
            folder = self.arguments.output / "random" / f"{friction:g}"
            layouts = generated_loads(folder, RANDOM_LOADS, "--gap", 1, "--seed", seed)
            name = f"random_{friction:g}"
            known, _ = self.runner.references(name, layouts, accelerations, self.references("random"), friction=friction)
            worlds, _ = self.runner.run(name, layouts, accelerations, self.settings("random"), friction=friction)
            parts += [worlds.assign(friction=friction), known.assign(friction=friction)]
        every = pd.concat(parts)
        passed = statistics.accepted(every)
        truth, standard = passed[self.references("random")[0]], passed["native-standard"]
        cpu, relative = self.relative(every)
        rows = [[name, number(relative[name]), str(int(passed[name].sum())), str(int((passed[name] & ~truth).sum())),
                 str(int((~passed[name] & truth).sum())), str(int((passed[name] != standard).sum()))] for name in cpu.index]
        title = (f"Random: {len(FRICTIONS) * RANDOM_LOADS} generated loads with gaps of up to 1 cm, {RANDOM_LOADS} for each friction "
                 f"coefficient from {FRICTIONS[0]} to {FRICTIONS[-1]}, under {len(accelerations)} accelerations: {len(passed)} worlds, of "
                 f"which {int(truth.sum())} hold in {truth.name}.")
        return table_of(title, ["setting", "CPU, relative", "let pass", "let pass, does not hold", "rejected, holds",
                                "other than native-standard"], rows)

    def references(self, kind):
        return self.arguments.references or REFERENCES[kind]

    def draw(self, path):
        """Error against cost, one panel per kind; the line joins the settings that no other one beats."""
        if not self.fronts:
            return
        figure, panels = plt.subplots(1, len(self.fronts), figsize=(7 * len(self.fronts), 5.5), squeeze=False)
        for axes, (title, cost, label, error) in zip(panels[0], self.fronts):
            for family, marker in (("native", "o"), ("bullet", "v"), ("box3d", "s"), ("jolt", "^")):
                of_family = [name for name in cost.index if name.startswith(family)]
                if of_family:
                    axes.plot(cost[of_family], error[of_family], marker, label=family)
            front = statistics.pareto_front(cost, error)
            axes.step(cost[front], error[front], "k:", where="post", linewidth=1)
            axes.set(xscale="log", xlabel=f"processor time relative to {BASE}", ylabel=label, title=title)
            if title == "harsh":
                axes.set(yscale="log")
            axes.legend(loc="upper right")
        figure.tight_layout()
        for axes, (_, cost, _, error) in zip(panels[0], self.fronts):
            label_points(axes, cost, error)
        figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="peer_bench, built with the sources of both peers")
    parser.add_argument("--output", type=Path, default=Path("peers"), help="folder of CSV files, references and plot")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS)
    parser.add_argument("--layouts", type=Path, nargs="+", default=[BENCH / "layouts", BENCH.parent / "configs" / "layouts"],
                        help="folders of the road, loose and gentle loads")
    parser.add_argument("--most", type=int, help="layouts of these at most, evenly chosen")
    parser.add_argument("--search", type=Path, help="loading_search, for the loads of searches")
    parser.add_argument("--settings", nargs="+", help="instead of the usual ones of each kind")
    parser.add_argument("--references", nargs="+", help="instead of the usual ones of each kind")
    parser.add_argument("--into", type=Path, help="page whose tables are replaced, such as docs/evidence/peers.md")
    parser.add_argument("--plot", type=Path, help="where it goes, instead of front.svg in the output folder")
    arguments = parser.parse_args()
    comparison = Comparison(arguments)
    try:
        tables = {}
        for kind in arguments.kinds:
            tables[kind] = getattr(comparison, kind)()
            print(tables[kind], end="\n\n", flush=True)
    except subprocess.CalledProcessError as error:
        parser.exit(1, f"{error.cmd[0]} failed: {error.returncode}\n")
    if arguments.into:
        replace_tables(arguments.into, {f"peers {kind}": text for kind, text in tables.items()})
    comparison.draw(arguments.plot or arguments.output / "front.svg")


if __name__ == "__main__":
    main()
