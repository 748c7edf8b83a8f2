#!/usr/bin/env python3
"""What the gather's image loses when the radiosity under it gets rougher: a Markdown table.

    tests/bench/radiosity_roughness.py BUILD SCENE [--reference 512] [RENDER-FLAGS...]

Renders SCENE by `gather` with --link-error from 1 (nothing is refined) downwards, all else as at standard quality, and compares it with two
independent halves of `path-trace`, whose noise cancels: MSE = (MSE(x, a) + MSE(x, b) - MSE(a, b)) / 2. The mean that errors are shares of
includes what emitters show of themselves.
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile

ERRORS = (1, 1e-2, 1e-3, 1e-4, 2e-5, 4e-6)


def render(build, scene, out, flags):
    report = out.with_suffix(".json")
    subprocess.run([build / "bin/radfarm", "render", scene, "-o", out, "--report", report, "--no-audit", "--no-cache", *map(str, flags)],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return json.loads(report.read_text())


def compare(build, a, b):
    return json.loads(subprocess.run([build / "bin/radfarm", "compare", a, b, "--json"], check=True, capture_output=True).stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--reference", type=int, default=512)
    a, flags = parser.parse_known_args()
    with tempfile.TemporaryDirectory() as folder:
        halves = [pathlib.Path(folder, f"{n}.exr") for n in (1, 2)]
        for seed, half in enumerate(halves, 1):
            render(a.build, a.scene, half, [*flags, "--integrator", "path-trace", "--samples", a.reference, "--seed", 1000 + seed])
        noise = compare(a.build, *halves)["rmse"] ** 2
        print("| link error | links | elements | radiosity, CPU s | error | ratio of means |\n|---|---|---|---|---|---|")
        for error in ERRORS:
            image = pathlib.Path(folder, "x.exr")
            report = render(a.build, a.scene, image, [*flags, "--integrator", "gather", "--link-error", error])
            with_each = [compare(a.build, image, half) for half in halves]
            mse = (sum(c["rmse"] ** 2 for c in with_each) - noise) / 2
            mean = sum(c["mean_b"] for c in with_each) / 2
            stage = next(s for s in report["stages"] if s["name"] == "radiosity")
            print(f"| {error:g} | {report['counts']['links']} | {report['counts']['elements']} | {stage['cpu_s']:.1f} | "
                  f"{100 * math.sqrt(max(mse, 0)) / mean:.2f} % | {sum(c['ratio_of_means'] for c in with_each) / 2:.4f} |", flush=True)


if __name__ == "__main__":
    main()
