"""Runs peer_bench for one kind of loads, and keeps what the peers' references computed."""
import hashlib
import subprocess
import sys
from pathlib import Path

import pandas as pd

BENCH = Path(__file__).resolve().parent.parent
ACCELERATIONS = BENCH.parent / "configs" / "accelerations"
HARSH_LOADS = [BENCH.parent / "configs" / "layouts" / f"{name}.txt"
               for name in ("BR0_012_block", "BR15_077_wall", "BR1_001_ep", "BR8_009_ep", "BR2_015_brick")]


def files_of(folders, most=None):
    """The layouts in folders, by name, without those that are unstable by design; at most so many, evenly chosen."""
    found = {}
    for folder in folders:
        for path in sorted(Path(folder).glob("*.txt")):
            if not path.name.startswith("unstable"):
                found.setdefault(path.name, path)
    files = [found[name] for name in sorted(found)]
    if most is None or most >= len(files):
        return files
    return [files[i * len(files) // most] for i in range(most)]


def loose_loads(folder, layouts):
    """The layouts with 1 mm of play, made anew."""
    subprocess.run([sys.executable, BENCH / "with_play.py", "1", folder, *layouts], check=True)
    return [Path(folder) / path.name for path in layouts]


def generated_loads(folder, count, *options):
    """So many layouts of candidates.py, made anew."""
    subprocess.run([sys.executable, BENCH / "candidates.py", str(count), folder, *map(str, options)],
                   check=True, stdout=subprocess.DEVNULL)
    return files_of([folder])


def weaker_accelerations(folder):
    """The accelerations of the road, with 0.6 g in place of 0.8 g and 0.4 g in place of 0.5 g, made anew."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    files = []
    for name, share in (("brake_0g8", 0.75), ("rearward_0g5", 0.8), ("corner_left_0g5", 0.8), ("corner_right_0g5", 0.8)):
        head, *rows = (ACCELERATIONS / f"road_{name}.txt").read_text(encoding="ascii").splitlines()
        scaled = [[*row.split()[:2], *(f"{share * float(value):.6g}" for value in row.split()[2:])] for row in rows]
        files.append(Path(folder) / f"weaker_{name}.txt")
        files[-1].write_text("\n".join([head, *map("\t".join, scaled)]) + "\n", encoding="ascii")
    return files


def asked_loads(arguments, problem, accelerations, count):
    """So many of the loads that a search for one problem asks for, evenly chosen; made once."""
    folder = Path(arguments.output) / "asked" / str(problem)
    if not folder.exists():
        if not arguments.search:
            sys.exit("--search: where loading_search is, which makes the loads of searches")
        subprocess.run([arguments.search, BENCH / "instances.txt", str(problem), *accelerations, "--generations", "40",
                        "--threads", "1", "--asked", folder], check=True, stdout=subprocess.DEVNULL)
        for path in folder.glob("*.txt"):  # names of layouts are those of files, and searches count theirs from 1
            path.rename(path.with_name(f"BR{problem}_{path.name}"))
    files = sorted(folder.glob("*.txt"))
    return [files[i * len(files) // count] for i in range(min(count, len(files)))]


def sampled_accelerations(folder):
    """A lane change and a braking as curves of samples, made anew."""
    subprocess.run([sys.executable, BENCH / "sampled_accelerations.py", folder], check=True)
    return [Path(folder) / "lane_change_0g2.txt", Path(folder) / "braking_0g8.txt"]


def signature(layouts, accelerations, words):
    """Changes with the bytes of the inputs and with the words."""
    digest = hashlib.sha256(repr(words).encode())
    for path in [*layouts, *accelerations]:
        digest.update(Path(path).name.encode() + Path(path).read_bytes())
    return digest.hexdigest()[:16]


class Runner:
    """Runs peer_bench and reads what it writes, in an output folder."""

    def __init__(self, program, output):
        self.program, self.output = Path(program), Path(output)
        self.output.mkdir(parents=True, exist_ok=True)

    def run(self, name, layouts, accelerations, settings, interval=None, repeats=1, friction=None):
        """The settings, taking turns in one process: (worlds, positions); no positions without an interval."""
        worlds, positions = self.output / f"{name}_worlds.csv", self.output / f"{name}_positions.csv"
        command = [self.program, "--layouts", *layouts, "--accelerations", *accelerations, "--settings", *settings,
                   "--worlds", worlds, "--repeats", str(repeats)]
        if interval:
            command += ["--positions", positions, "--interval", str(interval)]
        if friction:
            command += ["--friction", str(friction)]
        subprocess.run([str(word) for word in command], check=True)
        return pd.read_csv(worlds), pd.read_csv(positions) if interval else None

    def ask(self, name, layouts, accelerations, settings):
        """Whether each layout holds all accelerations, by every setting, and what it costs to know."""
        answers = self.output / f"{name}_answers.csv"
        command = [self.program, "--holds", "--layouts", *layouts, "--accelerations", *accelerations, "--settings", *settings,
                   "--worlds", answers]
        subprocess.run([str(word) for word in command], check=True)
        return pd.read_csv(answers)

    def references(self, name, layouts, accelerations, settings, interval=None, friction=None):
        """The same for references, one acceleration after the other. Peers' results of the same inputs are kept from
        the last time: only ours change."""
        worlds, positions = [], []
        for setting in settings:
            for acceleration in accelerations:
                peer = setting.startswith(("box3d-", "jolt-"))
                part = f"reference_{name}_{signature(layouts, [acceleration], [setting, interval, friction])}"
                kept = self.output / f"{part}.done"
                if peer and kept.exists():
                    worlds.append(pd.read_csv(self.output / f"{part}_worlds.csv"))
                    if interval:
                        positions.append(pd.read_csv(self.output / f"{part}_positions.csv"))
                    continue
                kept.unlink(missing_ok=True)
                found, moved = self.run(part, layouts, [acceleration], [setting], interval, friction=friction)
                kept.touch()
                worlds.append(found)
                positions.append(moved)
        return pd.concat(worlds), pd.concat(positions) if interval else None
