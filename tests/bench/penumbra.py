#!/usr/bin/env python3
"""Figure 6 of the grid final gather paper with our shadow: the penumbra from near and far, and the near one of a darker lamp, by both gathers.

    tests/bench/penumbra.py [--out docs/images/penumbra.png] [--size 256x192] [--quality standard]

A picture of three rows (far, near, near with an eighth of the lamp's light beside a panel that fills in) and three columns (the paper's
gather, ours, and our visibility samples: white is their 99th percentile), and a Markdown table of visibility samples a pixel, in all and
where the lamp lights in part. Needs the system's /usr/bin/python3 with python3-numpy and python3-openimageio.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

from renders import ROOT, Renders, scene_named

ROWS = (("far", "", "far"), ("near", "", "near"), ("near, darker lamp", "dim", "near"))
# The paper's gather has no layers of samples: pixel corners share them.
GATHERS = (("paper", "", {"gather": "paper"}), ("default", "", {"aov": ["depth", "samples.visibility"]}), ("bare", "bare", {"aov": ["depth"]}))


def scene_name(*kinds):
    return "=".join(filter(None, ("shadow", "-".join(filter(None, kinds)))))


def render_all(renders, size, quality, folder):
    """Images and their visibility samples a pixel, row by row; a failure ends the program."""
    files = []
    for name, made, camera in ROWS:
        for gather, without, more in GATHERS:
            scene = scene_named(scene_name(made, without), renders.work, size)
            image = pathlib.Path(folder, f"{len(files)}.exr")
            request = {"integrator": "gather", "quality": quality, "seed": 2, "audit": False, "camera": {"name": camera}}
            report = renders.run(scene, request | more, image)
            if report is None:
                sys.exit(f"penumbra.py: {name}, {gather}: no image")
            files.append({"row": name, "gather": gather, "file": str(image), "mean": report["counts"]["visibility_samples_per_pixel"]})
    return files


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build/penumbra")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/images/penumbra.png")
    parser.add_argument("--size", type=lambda text: tuple(map(int, text.split("x"))), default=(256, 192))
    parser.add_argument("--quality", default="standard")
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    renders = Renders(arguments.build, arguments.work, arguments.threads)
    with tempfile.TemporaryDirectory() as folder:
        files = render_all(renders, arguments.size, arguments.quality, folder)
        arguments.out.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["/usr/bin/python3", ROOT / "tests/bench/penumbra_picture.py", arguments.out, json.dumps(files)], check=True)


if __name__ == "__main__":
    main()
