#!/usr/bin/env bash
# Error against CPU time on the two peer scenes, whose converged references are not ours: a markdown table.
#
#   tests/bench/peers.sh [PEERS-DIR]     default: ../shared/peers beside the checkout; needs python3-numpy, python3-openimageio
set -euo pipefail
cd "$(dirname "$0")/../.."
peers="${1:-../shared/peers}"
[[ -d "$peers" ]] || { echo "no peer scenes at $peers: nothing to measure" >&2; exit 0; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# row SCENE SIZE INTEGRATOR SAMPLES: renders, asks the peers' ruler, prints one line.
row() {
  local name="$1-$3-$4" pair
  build/release/bin/radfarm render "$peers/$1/$1.gltf" --size "$2" --integrator "$3" --samples "$4" -o "$work/$name.exr" \
    --report "$work/$name.json" --no-cache >/dev/null 2>&1
  pair=$(/usr/bin/python3 "$peers/error.py" "$work/$name.exr" "$peers/$1/$1_refA.exr" "$peers/$1/$1_refB.exr")
  python3 - "$work/$name.json" "$1" "$3" "$4" "$pair" <<'PYTHON'
import json, sys
report = json.load(open(sys.argv[1])); accuracy = report["accuracy"]
wall = sum(s["wall_s"] for s in report["stages"]); cpu = sum(s["cpu_s"] for s in report["stages"])
percent = lambda x: "-" if x is None else f"{100 * x:.1f}"
low, high = (percent(x) for x in accuracy["relative_rmse_ci95"])
print(f"| {sys.argv[2]} | {sys.argv[3]} | {sys.argv[4]} | {wall:.1f} | {cpu:.1f} | {sys.argv[5].replace('relative RMSE ', '')} "
      f"| {percent(accuracy['relative_rmse'])} % ({low}..{high}) | {report['peak_memory_bytes'] / 1e6:.0f} |")
PYTHON
}

echo "| scene | integrator | samples | wall s | CPU s, audit included | error by the peers' ruler | audited | peak MB |"
echo "|---|---|---|---|---|---|---|---|"
for samples in 16 64; do
  row cornell 256x256 gather "$samples"
  row office 320x180 gather "$samples"
done
for samples in 64 256; do
  row cornell 256x256 path-trace "$samples"
  row office 320x180 path-trace "$samples"
done
