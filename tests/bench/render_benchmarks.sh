#!/usr/bin/env bash
# Renders the scenes of tests/scenes/cameras.json with gather and path-trace and prints a markdown table. Scenes that are not
# present are skipped.
#   tests/bench/render_benchmarks.sh [SCENE...]      by default all of them
# RADFARM_BIN=DIR      where the programs are (build/release/bin)
# RADFARM_SIZE=WxH     instead of the size of each camera
# RADFARM_QUALITY=Q    preview, standard (default), high or reference
# RADFARM_OUT=DIR      keeps images, reports and logs there (default: a temporary folder that goes away)
#
# wall s: of the whole program, start of the farm included. CPU s: all stages of the report, prepare and workers together.
# peak memory: the largest process, not the sum. The interval is the audit's, 95 %.
set -euo pipefail
cd "$(dirname "$0")/../.."

out="${RADFARM_OUT:-}"
if [[ -z "$out" ]]; then
  out="$(mktemp -d)"
  trap 'rm -rf "$out"' EXIT
fi
mkdir -p "$out"

python3 - "$out" "${RADFARM_BIN:-build/release/bin}/radfarm" "${RADFARM_QUALITY:-standard}" "${RADFARM_SIZE:-}" "$@" <<'PYTHON'
import json, os, subprocess, sys, time

out, radfarm, quality, size, *wanted = sys.argv[1:]
with open("tests/scenes/cameras.json", encoding="utf-8") as file:
    cameras = json.load(file)["cameras"]
unknown = [name for name in wanted if name not in cameras]
if unknown:
    sys.exit(f"render_benchmarks.sh: no camera {', '.join(unknown)}; there are {', '.join(cameras)}")


def flags(camera):
    point = lambda key: ",".join(str(x) for x in camera[key])
    result = ["--size", size or "x".join(str(n) for n in camera["size"])]
    if "up" in camera:
        result += ["--up", camera["up"]]
    if "eye" in camera:
        result += [f"--eye={point('eye')}", f"--look-at={point('look_at')}", f"--up-vector={point('up_vector')}",
                   "--fov", str(camera["vertical_fov_degrees"])]
    return result


def error(accuracy):
    interval = accuracy.get("relative_rmse_ci95")
    if interval is None:
        return "not measured"
    low, high = (f"{100 * x:.3g} %" for x in interval)
    value = accuracy.get("relative_rmse")
    return f"< {high}" if value is None else f"{100 * value:.3g} % ({low} to {high})"


print("| scene | integrator | size | wall s | CPU s | audited error (95 %) | peak memory MiB |")
print("|---|---|---|---|---|---|---|", flush=True)
failed = False
for name in wanted or cameras:
    camera = cameras[name]
    if not os.path.exists(camera["scene"]):
        print(f"render_benchmarks.sh: {name}: {camera['scene']} is not there, skipped", file=sys.stderr)
        continue
    for integrator in ("gather", "path-trace"):
        stem = os.path.join(out, f"{name}-{integrator}")
        command = [radfarm, "render", camera["scene"], "-o", stem + ".exr", "--png", stem + ".png",
                   "--report", stem + ".json", "--exposure", "auto", "--no-cache", "--integrator", integrator, "--quality", quality]
        begin = time.monotonic()
        with open(stem + ".log", "wb") as log:
            code = subprocess.run(command + flags(camera), stdout=log, stderr=subprocess.STDOUT).returncode
        wall = time.monotonic() - begin
        if code not in (0, 5):
            failed = True
            with open(stem + ".log", encoding="utf-8", errors="replace") as log:
                last = (log.read().strip().splitlines() or ["no output"])[-1]
            print(f"render_benchmarks.sh: {name} {integrator}: exit code {code}: {last}", file=sys.stderr)
            continue
        with open(stem + ".json", encoding="utf-8") as file:
            report = json.load(file)
        resolved = report["settings"]["resolved"]
        cpu = sum(stage["cpu_s"] for stage in report["stages"])
        memory = report["peak_memory_bytes"] / 2**20
        print(f"| {name} | {integrator} | {resolved['width']}x{resolved['height']} | {wall:.1f} | {cpu:.1f} | "
              f"{error(report['accuracy'])} | {memory:.0f} |", flush=True)
sys.exit(1 if failed else 0)
PYTHON
