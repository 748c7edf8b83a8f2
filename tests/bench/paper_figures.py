#!/usr/bin/env python3
"""The figures of paper 3 for docs/photon-paths.md: paper_figures.py [--bin BUILD/bin] [--out docs/images]

Runs the program paper_figures, which writes the pictures, plots the errors that it prints, and prints the table of the views.
"""
import argparse
import json
import pathlib
import subprocess

from log_plot import log_plot

RADII = (.4, .2, .1, .05, .025)      # of the curves over paths
COUNTS = (5000, 55000, 455000, 2455000)  # of the curves over radii


def nearest(values, wanted):
    return min(values, key=lambda value: abs(value - wanted))


def percent(row):
    return 100 * row["error"]


def plots(rows):
    """File name -> SVG."""
    errors = [row for row in rows if row["figure"] == "errors"]
    radii = sorted({row["radius"] for row in errors})
    over_paths = {f"{r:.3g} m": [(row["paths"] / 1000, percent(row)) for row in errors if row["radius"] == r]
                  for r in (nearest(radii, wanted) for wanted in RADII)}
    over_radius = {f"{n // 1000} k": [(row["radius"], percent(row)) for row in errors if row["paths"] == n] for n in COUNTS}
    vertices = {"error": [(row["vertices"], percent(row)) for row in rows if row["figure"] == "vertices"]}
    return {"photon-paths-over-paths.svg": log_plot(over_paths, "Error over paths, by radius", "thousand paths", "RMSE, % of the mean"),
            "photon-paths-over-radius.svg": log_plot(over_radius, "Error over radius, by paths", "radius, m", "RMSE, % of the mean"),
            "photon-paths-over-vertices.svg": log_plot(vertices, "Error over vertices: r = .02 m, 2,455,000 paths", "vertices",
                                                       "RMSE, % of the mean")}


def print_minima(rows):
    """Where the error over the radius is least, and how that radius goes with the number of paths."""
    print("| paths | best radius, m | error there |\n|---|---|---|")
    errors = [row for row in rows if row["figure"] == "errors"]
    for paths in sorted({row["paths"] for row in errors}):
        best = min((row for row in errors if row["paths"] == paths), key=percent)
        print(f"| {paths:,} | {best['radius']:.3f} | {percent(best):.2f} % |")


def print_views(rows):
    print("\n| view | | RMSE, of the mean | mean, of the truth's |\n|---|---|---|---|")
    for row in rows:
        if "way" in row:
            print(f"| {row['figure']} | {row['way']} | {percent(row):.1f} % | {row['mean']:.3f} |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=pathlib.Path, default="build/release/bin")
    parser.add_argument("--out", type=pathlib.Path, default="docs/images")
    parser.add_argument("--numbers", type=pathlib.Path, help="what the program printed before: it is not run again")
    given = parser.parse_args()
    text = given.numbers.read_text() if given.numbers else subprocess.run(
        [given.bin / "paper_figures", given.out], check=True, capture_output=True, text=True).stdout
    rows = [json.loads(line) for line in text.splitlines()]
    for name, svg in plots(rows).items():
        (given.out / name).write_text(svg)
    print_minima(rows)
    print_views(rows)


if __name__ == "__main__":
    main()
