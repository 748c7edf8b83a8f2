#!/usr/bin/env python3
"""What the gather costs as scenes grow: the plant at 10k, 100k and 1M triangles, the hall at 8, 80 and 800 lights. Markdown tables.

    tests/bench/gather_complexity.py [--triangles 10000 100000 1000000] [--lights 8 80 800] [--qualities standard high]
                                     [--gather default|paper|full-gather] [--error PERCENT]

The plant's leaves have the same area and the hall's lights the same power whatever their number. CPU seconds a stage, two
threads, the audit left out; equal settings. The second table has the CPU time of equal error: log time over log error is a line through the
two qualities (least squares through more); by default the error is the geometric mean of all measured ones. Finished rows are kept in WORK/rows.jsonl.
"""
import argparse
import math

from renders import add_arguments, note, percent, renders_of, scene_named

STAGES = ("load", "acceleration", "effects", "radiosity", "senders", "tasks")
GATHERS = {"default": {"integrator": "gather"}, "paper": {"integrator": "gather", "gather": "paper"}, "full-gather": {"integrator": "full-gather"}}


def error_of(row):
    """By the ruler; the audit's where there are no references, None where that found less than its noise."""
    measured = row["ruler"] or row["audited"]
    return measured["error"] or None


def measure(renders, scenes, qualities, request):
    """Scene -> its rows, one a quality; prints the first table."""
    print("| scene | triangles | quality | " + " | ".join(STAGES) + " | all, CPU s | peak MB | visibility samples | error (95 %) | audited |\n|---" +
          "|---" * (len(STAGES) + 7) + "|", flush=True)
    found = {}
    for scene in scenes:
        for quality in qualities:
            row = renders.row(scene, request | {"quality": quality, "seed": 2})
            if not row:
                continue
            found.setdefault(scene.name, []).append(row)
            stages = " | ".join(f"{row['cpu'].get(stage, 0):.2f}" for stage in STAGES)
            print(f"| {scene.name} | {row['triangles']} | {quality} | {stages} | {row['cpu']['all']:.1f} | {row['memory'] / 1e6:.0f} | "
                  f"{row['counts']['visibility_samples_per_pixel']:.0f} | {percent(row['ruler'])} | {percent(row['audited'])} |", flush=True)
    return found


def line_through(points):
    """Offset and slope by least squares; None of fewer than two different places."""
    x, y = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    spread = sum((p[0] - x) ** 2 for p in points)
    if spread < 1e-12:
        return None
    slope = sum((p[0] - x) * (p[1] - y) for p in points) / spread
    return y - slope * x, slope


def print_equal_error(found, wanted):
    points = {name: [(math.log(error_of(row)), math.log(row["cpu"]["all"])) for row in rows if error_of(row)] for name, rows in found.items()}
    errors = [p[0] for one in points.values() for p in one]
    if not errors:
        return
    at = math.log(wanted / 100) if wanted else sum(errors) / len(errors)
    print(f"\nCPU time at an error of {100 * math.exp(at):.3g} %:\n\n| scene | CPU s | time ~ error^ | |\n|---|---|---|---|")
    for name, one in points.items():
        line = line_through(one)
        if line is None or line[1] >= 0:
            print(f"| {name} | - | - | the qualities' errors do not differ enough |")
            continue
        inside = min(p[0] for p in one) <= at <= max(p[0] for p in one)
        print(f"| {name} | {math.exp(line[0] + line[1] * at):.1f} | {line[1]:.2f} | {'interpolated' if inside else 'extrapolated'} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--triangles", nargs="*", type=int, default=[10000, 100000, 1000000])
    parser.add_argument("--lights", nargs="*", type=int, default=[8, 80, 800])
    parser.add_argument("--qualities", nargs="+", default=["standard", "high"])
    parser.add_argument("--gather", choices=GATHERS, default="default")
    parser.add_argument("--error", type=float, help="per cent")
    add_arguments(parser, "gather-complexity")
    arguments = parser.parse_args()
    renders = renders_of(arguments)
    for names in ([f"plant={n}" for n in arguments.triangles], [f"hall={n}" for n in arguments.lights]):
        scenes = [scene_named(name, arguments.work, arguments.size) for name in names]
        if scenes:
            note(f"{len(scenes)} scenes made")
            print_equal_error(measure(renders, scenes, arguments.qualities, GATHERS[arguments.gather]), arguments.error)
            print()


if __name__ == "__main__":
    main()
