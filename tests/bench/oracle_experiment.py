#!/usr/bin/env python3
"""The paper's oracle experiment and error against CPU time: markdown tables and log-log plots for docs/radiosity.md.

    tests/bench/oracle_experiment.py room  [--seeds N]                        equal numbers of elements, five oracles
    tests/bench/oracle_experiment.py sweep [--seeds N] [--scene FILE.gltf]    error against CPU time
    --work DIR keeps references and what was solved (default build/oracles); --points, --paths of a new reference

Needs build/release/tests/bench/radiosity_lab. Errors: relative RMSE of luminous radiosity over the scene's area against path
tracing (radiosity_lab.cpp says how), ten seeds, 95 % intervals by Student's t. Standard library only.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess

from log_plot import log_plot

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOM = ROOT / "tests/scenes/oracle_room.gltf"
ORACLES = ("KS", "KL", "CS", "HE", "VAR")
ELEMENTS = 19000
RAYS = 16e6  # what the oracle with the most links needs, and a few light paths
MESH_HITS = 376  # of light paths a patch: so many that what differs is the mesh
MIN_PATCH_AREA = 2e-6  # far below what any of them asks for on average, so that oracles decide and not the floor
T95 = {1: 12.71, 2: 4.30, 3: 3.18, 4: 2.78, 7: 2.36, 9: 2.26, 19: 2.09, 31: 2.04}  # Student's quantile by degrees of freedom


class Lab:
    """Solves, and remembers what it solved."""

    def __init__(self, scene, work, points, paths):
        self.program = ROOT / "build/release/bin/radiosity_lab"
        self.scene, work = scene, work / scene.stem
        work.mkdir(parents=True, exist_ok=True)
        self.reference, self.results, self.process = work / "reference.json", work / "results.jsonl", None
        if not self.reference.exists():
            run = subprocess.run([self.program, "reference", scene, str(points), str(paths)], capture_output=True, check=True)
            self.reference.write_bytes(run.stdout)
        lines = self.results.read_text().splitlines() if self.results.exists() else []
        self.known = {json.dumps(row["settings"], sort_keys=True): row for row in map(json.loads, lines)}

    def solve(self, **settings):
        key = json.dumps(settings, sort_keys=True)
        if key not in self.known:
            if not self.process:
                self.process = subprocess.Popen([self.program, "solve", self.scene, self.reference], text=True,
                                                stdin=subprocess.PIPE, stdout=subprocess.PIPE)
            self.process.stdin.write(key + "\n")
            self.process.stdin.flush()
            row = json.loads(self.process.stdout.readline())
            assert "failed" not in row, row
            with self.results.open("a") as file:
                file.write(json.dumps(row) + "\n")
            self.known[key] = row
        return self.known[key]


def mse(row):
    return statistics.fmean(row["blocks"])


def error(row):
    """Relative RMSE; noise of the reference may leave less than nothing."""
    return math.sqrt(max(mse(row), 0)) / row["mean"]


def tune(lab, oracle, literal):
    """The threshold that gives ELEMENTS elements, to one per cent: the secant method on logarithms, inside what brackets it, from
    the coarse side, where solving costs little."""
    known = []
    guess = math.log(1e-2)
    for _ in range(30):
        row = lab.solve(oracle=oracle, literal=literal, error=math.exp(guess), seed=1, paths=0, min_patch_area=MIN_PATCH_AREA)
        known.append((guess, math.log(row["elements"] / ELEMENTS)))
        if abs(known[-1][1]) < .01:
            break
        few, many = (max([k for k in known if (k[1] > 0) == side], key=lambda k: k[0] if side else -k[0], default=None)
                     for side in (False, True))
        if few and many:  # most often regula falsi, every third time the middle
            share = .5 if len(known) % 3 == 0 else few[1] / (few[1] - many[1])
            guess = few[0] + share * (many[0] - few[0])
        else:
            guess += max(-2.5, min(2.5, 1.2 * known[-1][1]))
    return math.exp(guess)


def interval(values):
    return T95[len(values) - 1] * statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else 0


def over_kl(rows, kl):
    """Ratio of MSE to KL's with its 95 % interval, jackknifed over the blocks of points, seeds averaged: a chance set of points
    is the larger uncertainty."""
    blocks = len(rows[0]["blocks"])
    ours, theirs = ([statistics.fmean(r["blocks"][b] for r in group) for b in range(blocks)] for group in (rows, kl))
    ratio = sum(ours) / sum(theirs)
    left_out = [(sum(ours) - ours[b]) / (sum(theirs) - theirs[b]) for b in range(blocks)]
    spread = math.sqrt((blocks - 1) / blocks * sum((x - statistics.fmean(left_out)) ** 2 for x in left_out))
    return ratio, T95[blocks - 1] * spread


def paths_for_rays(lab, settings):
    """Hits a patch with which light paths use up what the links leave of RAYS."""
    with_none, with_few = (lab.solve(**settings, paths=k, seed=1)["rays"] for k in (0, 32))
    return max(1, round(32 * (RAYS - with_none) / (with_few - with_none)))


def table(lab, thresholds, literal, hits, seeds):
    """`hits` of light paths a patch; None: what uses up RAYS."""
    solved = {}
    for o in ORACLES:
        settings = {"oracle": o, "literal": literal, "error": thresholds[o], "min_patch_area": MIN_PATCH_AREA}
        paths = paths_for_rays(lab, settings) if hits is None else hits
        solved[o] = [lab.solve(**settings, paths=paths, seed=s) for s in range(1, seeds + 1)]
    print(f"\n{'Literal forms' if literal else 'Forms in one unit'}, {'the same rays by light paths' if hits is None else f'{hits} hits a patch'}, {seeds} seeds:\n")
    print("| oracle | threshold | elements | links | M rays | CPU s | error, % | MSE over KL's |\n|---|---|---|---|---|---|---|---|")
    for oracle, rows in solved.items():
        def mean(key, scale=1):
            return statistics.fmean(r[key] for r in rows) / scale
        errors = [100 * error(r) for r in rows]
        ratio, spread = over_kl(rows, solved["KL"])
        print(f"| {oracle} | {thresholds[oracle]:.3g} | {mean('elements'):.0f} | {mean('links'):.0f} | {mean('rays', 1e6):.2f} | "
              f"{statistics.median(r['cpu_s'] for r in rows):.1f} | {statistics.fmean(errors):.2f} ± {interval(errors):.2f} | "
              f"{ratio:.3f} ± {spread:.3f} |", flush=True)


def room(lab, seeds, forms):
    for form in forms:
        thresholds = {o: tune(lab, o, form == "literal") for o in ORACLES}
        for hits in (0, MESH_HITS, None):
            table(lab, thresholds, form == "literal", hits, seeds)


def sweep(lab, seeds, thresholds, hits):
    """Error against CPU seconds: the same thresholds for all, in their one unit."""
    name = lab.scene.stem
    series = {}
    print(f"\n{name}, {f'{hits} hits of light paths a patch' if hits else 'links alone'}, {seeds} seeds: error, % / CPU s / elements\n")
    print("| oracle | " + " | ".join(f"{t:g}" for t in thresholds) + " |\n|---" + "|---" * len(thresholds) + "|")
    for oracle in ORACLES:
        cells, series[oracle] = [], []
        for threshold in thresholds:
            rows = [lab.solve(oracle=oracle, literal=False, error=threshold, seed=s, paths=hits) for s in range(1, seeds + 1)]
            cpu, e = statistics.median(r["cpu_s"] for r in rows), 100 * statistics.fmean(map(error, rows))
            cells.append(f"{e:.1f} / {cpu:.1f} / {statistics.fmean(r['elements'] for r in rows):.0f}")
            series[oracle].append((cpu, e))
        print(f"| {oracle} | " + " | ".join(cells) + " |", flush=True)
    file = ROOT / "docs/images" / f"oracles-{name}-{'paths' if hits else 'links'}.svg"
    title = f"{name}, {'links and light paths' if hits else 'links alone'}"
    file.write_text(log_plot(series, title, "CPU seconds of the solve", "relative RMSE of radiosity, %"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("room", "sweep"))
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--scene", type=pathlib.Path, default=ROOM)
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build/oracles")
    parser.add_argument("--points", type=int, default=32768)
    parser.add_argument("--paths", type=int, default=128)
    parser.add_argument("--forms", nargs="+", choices=("literal", "power"), default=["literal", "power"])
    parser.add_argument("--hits", type=int, nargs="+", default=[0, 4], help="light-path hits a patch of each sweep; 0: links alone")
    parser.add_argument("--errors", type=float, nargs="+", default=[1e-3, 2e-4, 4e-5, 8e-6], help="max_link_error of a sweep")
    a = parser.parse_args()
    if not a.scene.exists():
        return print(f"no scene at {a.scene}: nothing to measure")
    lab = Lab(a.scene, a.work, a.points, a.paths)
    if a.what == "room":
        room(lab, a.seeds, a.forms)
    else:
        for hits in a.hits:
            sweep(lab, a.seeds, a.errors, hits)


if __name__ == "__main__":
    main()
