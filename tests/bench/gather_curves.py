#!/usr/bin/env python3
"""Error against CPU time: the paper's gather, ours, the full gather, path tracing and Cycles. A Markdown table, and a log-log plot of each scene.

    tests/bench/gather_curves.py [--scenes cornell office classroom hospital bookstore] [--methods ...] [--out docs/images]

CPU seconds of both cores together, of the whole process, scene preparation and radiosity included, no audit. Error by the peers' ruler with the
masks of docs/benchmarks.md; cornell and office against the peers' references, the others against two halves of our own `path-trace`
of --reference-samples with other seeds, made once in --references. Cycles renders the peers' scenes by their own script where blender is
installed. Finished rows are kept in WORK/rows.jsonl: start it again to go on. Scenes that are missing are skipped, so without ../shared
(or $RADFARM_SHARED) nothing is measured.
"""
import argparse
import os
import pathlib
import shutil
import tempfile

from log_plot import log_plot
from renders import PEERS, ROOT, add_arguments, note, percent, renders_of, ruler, run_child, scene_named

METHODS = {  # name -> request
    "paper": {"integrator": "gather", "gather": "paper", "audit": False},
    "default": {"integrator": "gather", "audit": False},
    "full-gather": {"integrator": "full-gather", "audit": False},
    "path-trace": {"integrator": "path-trace", "audit": False},
    "cycles": {},
}


def cycles_row(renders, scene, samples):
    """The peers' script in Blender; None where there is no Blender, or no such scene."""
    blender = shutil.which("blender")
    script = PEERS / "render_cycles.py"
    if not blender or not script.exists() or not scene.references:
        return None

    def make():
        with tempfile.TemporaryDirectory() as folder:
            image = pathlib.Path(folder, "image.exr")
            command = [blender, "-b", "--factory-startup", "--python", script, "--", f"{scene.name}/{scene.name}", samples, image]
            # The Python within Blender takes its modules from where the first python3 of PATH has them: that must be the system's.
            cpu = run_child(command, renders.limit, env=os.environ | {"PATH": "/usr/bin:/bin"}, cwd=PEERS)
            if cpu is None or not image.exists():  # Blender's exit code is 0 when the script fails
                note(f"cycles: no image of {scene.name}")
                return None
            return {"cpu": {"all": cpu}, "ruler": ruler(image, scene, scene.references)}

    return renders.kept({"scene": scene.name, "request": {"cycles": samples}}, make)


def settings_of(method, arguments):
    if method == "cycles":
        return arguments.cycles_samples
    return arguments.samples if method == "path-trace" else arguments.qualities


def row_of(renders, scene, method, setting):
    if method == "cycles":
        return cycles_row(renders, scene, setting)
    return renders.row(scene, METHODS[method] | {"seed": 2} | ({"samples": setting} if method == "path-trace" else {"quality": setting}))


def print_row(scene, method, setting, row):
    radiosity = row["cpu"].get("radiosity")
    samples = row["counts"]["camera_rays"] / row["pixels"] if "counts" in row and "pixels" in row else None
    print(f"| {scene} | {method} | {setting} | {row['cpu']['all']:.1f} | {'-' if radiosity is None else f'{radiosity:.1f}'} | "
          f"{'-' if samples is None else f'{samples:.0f}'} | {percent(row['ruler'])} | {row['ruler']['ratio']:.4f} |", flush=True)


def measure(renders, scene, arguments):
    """Method -> points of the curve; prints rows of the table."""
    series = {}
    for method in arguments.methods:
        for setting in settings_of(method, arguments):
            row = row_of(renders, scene, method, setting)
            if row and row["ruler"]:
                row = row | {"pixels": scene.request["width"] * scene.request["height"]}
                print_row(scene.name, method, setting, row)
                if row["ruler"]["error"] > 0:
                    series.setdefault(method, []).append((row["cpu"]["all"], 100 * row["ruler"]["error"]))
    return series


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="+", default=["cornell", "office", "classroom", "hospital", "bookstore"])
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=list(METHODS))
    parser.add_argument("--qualities", nargs="+", default=["preview", "standard", "high"])
    parser.add_argument("--samples", nargs="+", type=int, default=[16, 32, 64, 128, 256], help="of path-trace")
    parser.add_argument("--cycles-samples", nargs="+", type=int, default=[16, 64, 256])
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/images", help="folder of the plots")
    add_arguments(parser, "gather-curves")
    arguments = parser.parse_args()
    scenes = list(filter(None, (scene_named(name, arguments.work, arguments.size) for name in arguments.scenes)))
    if not scenes:
        return note("no scene is there: nothing to measure")
    renders = renders_of(arguments)
    print("| scene | method | setting | CPU s | of it radiosity | camera samples a pixel | error (95 %) | ratio of means |\n"
          "|---|---|---|---|---|---|---|---|", flush=True)
    arguments.out.mkdir(parents=True, exist_ok=True)
    for scene in scenes:
        series = measure(renders, scene, arguments)
        if series:
            plot = log_plot(series, scene.name, "CPU seconds, preparation included", "relative RMSE, %")
            (arguments.out / f"gather-error-{scene.name}.svg").write_text(plot)


if __name__ == "__main__":
    main()
