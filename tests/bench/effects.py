#!/usr/bin/env python3
"""What the effects plan decides on the demonstration scenes, and what each skip saves: two markdown tables.

    tests/bench/effects.py [BUILD-DIR]        default: build/release

A skip's saving is CPU time of the tasks with the effect forced on against that as planned, path-trace, three pairs in turn, median.
Standard library only.
"""
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release")
SCENES = ROOT / "tests/scenes/effects"
ALWAYS = {"bounces", "colour", "channels"}


def flags_of_scenes():
    """Scene -> flags, from the folder's README."""
    rows = [[cell.strip(" `") for cell in line.split("|")[1:5]] for line in (SCENES / "README.md").read_text().splitlines()
            if line.startswith("| `")]
    return {cells[0]: cells[3].split() for cells in rows}


def explain(name, flags):
    scene = SCENES / f"{name}.gltf"
    run = subprocess.run([BUILD / "bin/radfarm", "explain", scene, "--json", *flags], capture_output=True, text=True, check=True, cwd=ROOT)
    return json.loads(run.stdout)


def table_of_decisions(plans):
    print("| scene | on | off, though the scene has it (value; bound in cd/m^2) |\n|---|---|---|")
    for name, plan in plans.items():
        on = [e["id"] for e in plan["effects"] if e["active"] and e["id"] not in ALWAYS]
        off = [f"{e['id']} ({e['value']:.2g}; {e['bound'] if isinstance(e['bound'], str) else format(e['bound'], '.2g')} {e['bound_kind']})"
               for e in plan["effects"] if not e["active"] and (e["value"] > 0 or e["bound"] != 0)]
        print(f"| `{name}` | {', '.join(on)} | {', '.join(off)} |")


def seconds(name, flags, effects, folder):
    report = folder / "report.json"
    command = [BUILD / "bin/radfarm", "render", SCENES / f"{name}.gltf", "-o", folder / "image.exr", "--report", report, "--size", "160x120",
               "--integrator", "path-trace", "--samples", "64", "--no-audit", "--workers", "1", "--no-cache", *flags]
    subprocess.run(command + (["--effects", effects] if effects else []), capture_output=True, check=True, cwd=ROOT)
    return sum(s["cpu_s"] for s in json.loads(report.read_text())["stages"] if s["name"] == "tasks")


def table_of_savings(skips):
    print("| scene | skipped | CPU time forced on / as planned |\n|---|---|---|")
    with tempfile.TemporaryDirectory() as work:
        for name, flags, effect in skips:
            ratios = []
            for _ in range(3):
                planned = seconds(name, flags, "", pathlib.Path(work))
                ratios.append(seconds(name, flags, f"+{effect}", pathlib.Path(work)) / planned)
            print(f"| `{name}` | {effect} | {statistics.median(ratios):.2f} ({min(ratios):.2f}..{max(ratios):.2f}) |", flush=True)


def main():
    flags = flags_of_scenes()
    plans = {name: explain(name, flags[name]) for name in flags}
    table_of_decisions(plans)
    print()
    switches = {"environment", "interreflection", "reflectance_textures", "normal_maps", "ies", "depth_of_field", "alpha_cutouts", "emission_textures"}
    table_of_savings([(name, flags[name], e["id"]) for name, plan in plans.items() for e in plan["effects"]
                      if not e["active"] and e["id"] in switches and (e["value"] > 0 or e["bound"] != 0)])


if __name__ == "__main__":
    main()
