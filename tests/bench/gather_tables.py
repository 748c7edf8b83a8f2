#!/usr/bin/env python3
"""Tables 1 and 2 of the grid final gather paper with our scenes, as Markdown: what masking by detail saves, and what the full gather costs.

    tests/bench/gather_tables.py [--scenes plant=250000 office hall=80] [--quality standard] [--size WxH] [--work FOLDER]

Each scene is rendered by the paper's gather and by ours, with masking off and on, and with all that changes resampled (full-gather). The
plant stands for the scene of table 1, the peers' office for the toy room, the hall for the library of table 2. Visibility and form factor samples are
a pixel's; CPU seconds of two threads, the audit left out: `class` is the stage senders, `image` visibility and illumination. The
error is the peers' ruler's, against path traced halves where a scene has none of its own, and the audit's. Scenes that are missing are
skipped. Finished rows are kept in WORK/rows.jsonl: start it again to go on.
"""
import argparse

from renders import add_arguments, note, percent, renders_of, scene_named

METHODS = {  # name -> (gather, masking, request)
    "paper": ("paper", "off", {"integrator": "gather", "gather": "paper", "effects": "-masking"}),
    "paper-masked": ("paper", "on", {"integrator": "gather", "gather": "paper", "effects": "+masking"}),
    "paper-full": ("paper, full-gather", "-", {"integrator": "full-gather", "gather": "paper"}),
    "default": ("default", "off", {"integrator": "gather", "effects": "-masking"}),
    "default-masked": ("default", "on", {"integrator": "gather", "effects": "+masking"}),
    "default-full": ("default, full-gather", "-", {"integrator": "full-gather"}),
}
# With over without masking in the paper: visibility samples, form factor samples, total time (its tables 1 and 2).
PAPER = {"plant": (.62, .64, .55), "office": (.82, .72, .80), "hall": (.78, .79, .70)}


def visibility(row):
    return row["counts"]["visibility_samples_per_pixel"]


def form_factors(row):
    return row["counts"]["form_factor_samples_per_pixel"]


def print_row(scene, method, row):
    gather, masking, _ = METHODS[method]
    cpu = row["cpu"]
    print(f"| {scene} | {gather} | {masking} | {visibility(row):.1f} | {form_factors(row):.1f} | {cpu.get('radiosity', 0):.1f} | "
          f"{cpu.get('senders', 0):.1f} | {cpu['tasks']:.1f} | {cpu['all']:.1f} | {percent(row['ruler'])} | {percent(row['audited'])} |", flush=True)


def measure(renders, scenes, methods, quality):
    """(scene, method) -> row; prints the first table on the way."""
    print("| scene | gather | masking | visibility samples | form factors | radiosity, CPU s | class, CPU s | image, CPU s | total, CPU s | "
          "error (95 %) | audited |\n|---|---|---|---|---|---|---|---|---|---|---|", flush=True)
    rows = {}
    for scene in scenes:
        for method in methods:
            row = renders.row(scene, METHODS[method][2] | {"quality": quality, "seed": 2})
            if row:
                rows[scene.name, method] = row
                print_row(scene.name, method, row)
    return rows


def print_ratios(rows):
    """With over without masking, the paper's ratio in brackets."""
    print("\nWith masking over without (the paper's):\n\n| scene | gather | visibility samples | form factors | image, CPU s | total, CPU s |\n"
          "|---|---|---|---|---|---|")
    for (scene, method), row in rows.items():
        masked = rows.get((scene, method + "-masked"))
        if not masked:
            continue
        theirs = PAPER.get(scene.split("-")[0], (None,) * 3)
        def ratio(of, paper=None):
            return f"{of(masked) / max(of(row), 1e-9):.2f}" + (f" ({paper:.2f})" if paper else "")
        print(f"| {scene} | {METHODS[method][0]} | {ratio(visibility, theirs[0])} | {ratio(form_factors, theirs[1])} | "
              f"{ratio(lambda r: r['cpu']['tasks'])} | {ratio(lambda r: r['cpu']['all'], theirs[2])} |")


def print_shares_of_full(rows):
    print("\nOf the full gather's reevaluations (the paper: about a third at the same visual quality):\n\n"
          "| scene | gather | visibility samples | image, CPU s |\n|---|---|---|---|")
    for (scene, method), row in rows.items():
        full = rows.get((scene, method.split("-")[0] + "-full"))
        if full and not method.endswith("-full"):
            print(f"| {scene} | {method.replace('-', ', ')} | {visibility(row) / visibility(full):.2f} | {row['cpu']['tasks'] / full['cpu']['tasks']:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="+", default=["plant=250000", "office", "hall=80"])
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=list(METHODS))
    parser.add_argument("--quality", default="standard")
    add_arguments(parser, "gather-tables")
    arguments = parser.parse_args()
    renders = renders_of(arguments)
    scenes = list(filter(None, (scene_named(name, arguments.work, arguments.size) for name in arguments.scenes)))
    if not scenes:
        return note("no scene is there: nothing to measure")
    rows = measure(renders, scenes, arguments.methods, arguments.quality)
    print_ratios(rows)
    print_shares_of_full(rows)


if __name__ == "__main__":
    main()
