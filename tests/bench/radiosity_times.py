#!/usr/bin/env python3
"""What the radiosity solve costs: time, links, elements and memory on scenes, and on one room whose clutter is cut finer and finer.

    tests/bench/radiosity_times.py BUILD [--scene SCENE ...] [--series 10000,100000,1000000]

Prints a Markdown table. Each row is one `render_in_process` of a small image of one sample, of which the stage `radiosity` is shown: two
threads, other stages left out of the times, but not of the peak memory. The series is a closed room with a lamp and 64 crumpled balls.
"""
import argparse
import json
import math
import multiprocessing
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from big_scene import BigScene  # noqa: E402

REQUEST = {"width": 32, "height": 18, "integrator": "gather", "samples": 1, "audit": False}


def ball(rng, centre, radius, bands):
    """A sphere of 4 bands^2 triangles, its radius jittered by a tenth."""
    points, triangles = [], []
    for i in range(bands + 1):
        for j in range(2 * bands + 1):
            seam = random.Random(f"{centre}{i}{j % (2 * bands)}" if 0 < i < bands else f"{centre}{i}")
            theta, phi, r = math.pi * i / bands, math.pi * j / bands, radius * (1 + seam.uniform(-.1, .1))
            points.append([centre[0] + r * math.sin(theta) * math.cos(phi), centre[1] + r * math.cos(theta),
                           centre[2] + r * math.sin(theta) * math.sin(phi)])
    row = 2 * bands + 1
    for i in range(bands):
        for j in range(2 * bands):
            a, b = i * row + j, (i + 1) * row + j
            triangles += [[a, a + 1, b], [a + 1, b + 1, b]]
    return points, triangles


def room(triangles, name):
    scene = BigScene(name)
    scene.material("grey", (.7, .7, .7))
    scene.material("lamp", (0, 0, 0), (1, 1, 1))
    scene.inward_box(["grey"] * 6, (-4, 0, -4), (4, 3, 4))
    scene.polygon("lamp", (-1, 2.99, -1), (1, 2.99, -1), (1, 2.99, 1), (-1, 2.99, 1))
    bands = max(2, round(math.sqrt(triangles / 64 / 4)))
    rng = random.Random(1)
    for _ in range(64):
        centre = [rng.uniform(-3.4, 3.4), rng.uniform(.4, 2.2), rng.uniform(-3.4, 3.4)]
        scene.mesh("grey", *ball(rng, centre, rng.uniform(.1, .4), bands))
    return scene


def row(build, scene, name, quality, up):
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder, "report.json")
        request = REQUEST | {"quality": quality, "up": up}
        subprocess.run([build / "bin/render_in_process", scene, pathlib.Path(folder, "x.exr"), json.dumps(request), report], check=True,
                       stdout=subprocess.DEVNULL)
        r = json.loads(report.read_text())
    stage = next(s for s in r["stages"] if s["name"] == "radiosity")
    return (f"| {name} | {r['scene']['triangles']} | {quality} | {stage['wall_s']:.1f} | {stage['cpu_s']:.1f} | {r['counts']['elements']} | "
            f"{r['counts']['links']} | {r['peak_memory_bytes'] / 1e6:.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--scene", type=pathlib.Path, action="append", default=[])
    parser.add_argument("--series", default="10000,100000,1000000")
    parser.add_argument("--qualities", default="preview,standard")
    arguments = parser.parse_args()
    print("| scene | triangles | quality | wall, s | CPU, s | elements | links | peak MB |\n|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        scenes = [(s, s.stem, "Z" if s.suffix == ".obj" else "Y") for s in arguments.scene]
        for count in filter(None, arguments.series.split(",")):
            path = pathlib.Path(folder, f"balls-{count}.gltf")
            # In a process of its own: a child's peak memory starts at its parent's.
            maker = multiprocessing.Process(target=lambda: room(int(count), path.stem).write(path.parent))
            maker.start()
            maker.join()
            scenes.append((path, f"room of balls, {count}", "Y"))
        for scene, name, up in scenes:
            for quality in arguments.qualities.split(","):
                print(row(arguments.build, scene, name, quality, up), flush=True)


if __name__ == "__main__":
    main()
