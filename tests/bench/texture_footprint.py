#!/usr/bin/env python3
"""What filtered textures gain: error against a reference and CPU time, of two builds, as a markdown table.

    tests/bench/texture_footprint.py BEFORE-BUILD AFTER-BUILD [SAMPLES...]        default samples: 1 4 16

Scenes: a checkered plane to the horizon under a directional light, seen and in a mirror; a mottled room under a lamp. The
reference is BEFORE's path tracer at 1024 samples of another seed (256 in the room); BEFORE is to be a build that filters nothing.
Error: relative RMSE, median of three seeds.
Standard library only.
"""
import json
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/scenes"))
import effect_scene  # noqa: E402
from effect_scene import DOWN, EffectScene, image  # noqa: E402

SEEDS = (1, 2, 3)


def checker():
    return image(256, lambda u, v: (240,) * 3 if (int(32 * u) + int(32 * v)) % 2 else (20,) * 3)


def mottle():
    numbers = random.Random(1)
    return image(256, lambda u, v: (numbers.choice((30, 90, 160, 250)),) * 3)


def horizon():
    scene = EffectScene("horizon", eye=(0, 1.6, 30), look_at=(0, 1, 0))
    scene.textures["checker"] = checker()
    scene.material("floor", (1, 1, 1), texture="checker", uv=lambda p: (p[0] / 2, p[2] / 2))
    scene.polygon("floor", (-200, 0, 30), (200, 0, 30), (200, 0, -400), (-200, 0, -400))
    scene.punctual("directional", (0, 5, 0), 1000, rotation=DOWN)
    return scene


def mirrored():
    scene = horizon()
    scene.name = "mirrored"
    scene.material("mirror", (1, 1, 1), metallic=1, roughness=0)
    scene.polygon("mirror", (-3, 0, 20), (3, 0, 20), (3, 4, 20), (-3, 4, 20))
    return scene


def room():
    scene = EffectScene("room", eye=(0, 1.5, 3.8), look_at=(0, 1, 0), yfov=.9)
    scene.textures["mottle"] = mottle()
    scene.material("walls", (1, 1, 1), texture="mottle", uv=lambda p: (p[0] + p[2], p[1] + p[2]))
    scene.inward_box(["walls"] * 6, (-2, 0, -2), (2, 3, 4))
    scene.material("lamp", (0, 0, 0), emission=(500, 500, 500))
    scene.lamp("lamp", (0, 2.9, 0), (0, 0, 0), .8)
    return scene


def render(build, scene, out, **request):
    report = out.with_suffix(".json")
    request = {"width": 240, "height": 180, "audit": False} | request
    subprocess.run([build / "bin/render_in_process", scene, out, json.dumps(request), report], check=True, capture_output=True)
    stages = json.loads(report.read_text())["stages"]
    return {s["name"]: s["cpu_s"] for s in stages}["tasks"]


def error(build, image_file, reference):
    run = subprocess.run([build / "bin/radfarm", "compare", "--json", image_file, reference], check=True, capture_output=True, text=True)
    return json.loads(run.stdout)["relative_rmse"]


def row(builds, tools, scene, reference, integrator, samples, folder):
    errors, times = ([], []), ([], [])
    for seed in SEEDS:
        for k, build in enumerate(builds):
            out = folder / "image.exr"
            times[k].append(render(build, scene, out, samples=samples, seed=seed, integrator=integrator))
            errors[k].append(100 * error(tools, out, reference))
    e, t = ([statistics.median(x) for x in both] for both in (errors, times))
    print(f"| {scene.stem} | {integrator} | {samples} | {e[0]:.2f} | {e[1]:.2f} | {t[0]:.2f} | {t[1]:.2f} |", flush=True)


def main(before, after, samples):
    print("| scene | integrator | samples | error before, % | after | CPU before, s | after |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "effects").mkdir()
        effect_scene.FOLDER = folder
        for scene, integrator, at_reference in ((horizon(), "path-trace", 1024), (mirrored(), "path-trace", 1024),
                                                (room(), "path-trace", 256), (room(), "gather", 256)):
            scene.write()
            file, reference = folder / "effects" / f"{scene.name}.gltf", folder / f"{scene.name}.exr"
            if not reference.exists():
                render(before, file, reference, samples=at_reference, seed=99, integrator="path-trace")
            for n in samples:
                row((before, after), before, file, reference, integrator, n, folder)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), [int(n) for n in sys.argv[3:]] or [1, 4, 16])
