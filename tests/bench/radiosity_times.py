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
import struct
import subprocess
import tempfile

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


def box(low, high):
    """A box seen from inside."""
    corners = [[(high if k >> axis & 1 else low)[axis] for axis in range(3)] for k in range(8)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def room(triangles):
    bands = max(2, round(math.sqrt(triangles / 64 / 4)))
    rng = random.Random(1)
    parts = [(box([-4, 0, -4], [4, 3, 4]), 0), (([[-1, 2.99, -1], [1, 2.99, -1], [1, 2.99, 1], [-1, 2.99, 1]], [(0, 1, 2), (0, 2, 3)]), 1)]
    for k in range(64):
        centre = [rng.uniform(-3.4, 3.4), rng.uniform(.4, 2.2), rng.uniform(-3.4, 3.4)]
        parts.append((ball(rng, centre, rng.uniform(.1, .4), bands), 0))
    return parts


def write_gltf(parts, path):
    data, views, accessors, meshes = b"", [], [], []
    for (points, triangles), material in parts:
        for kind, rows, code, bounds in (("VEC3", points, "f", True), ("SCALAR", triangles, "I", False)):
            raw = b"".join(struct.pack(f"<3{code}", *row) for row in rows)
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(raw)})
            accessor = {"bufferView": len(views) - 1, "componentType": 5126 if bounds else 5125, "type": kind,
                        "count": len(rows) * (1 if bounds else 3)}
            if bounds:
                accessor |= {"min": [min(c) for c in zip(*points)], "max": [max(c) for c in zip(*points)]}
            accessors.append(accessor)
            data += raw
        meshes.append({"primitives": [{"attributes": {"POSITION": len(accessors) - 2}, "indices": len(accessors) - 1, "material": material}]})
    path.with_suffix(".bin").write_bytes(data)
    plain = {"metallicFactor": 0, "roughnessFactor": 1}
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "extensionsUsed": ["KHR_materials_specular"],
        "buffers": [{"uri": path.with_suffix(".bin").name, "byteLength": len(data)}], "bufferViews": views, "accessors": accessors,
        "materials": [{"pbrMetallicRoughness": plain | {"baseColorFactor": [.7, .7, .7, 1]}, "extensions": {"KHR_materials_specular": {"specularFactor": 0}}},
                      {"pbrMetallicRoughness": plain | {"baseColorFactor": [0, 0, 0, 1]}, "emissiveFactor": [1, 1, 1],
                       "extensions": {"KHR_materials_specular": {"specularFactor": 0}}}],
        "meshes": meshes, "nodes": [{"mesh": m} for m in range(len(meshes))], "scenes": [{"nodes": list(range(len(meshes)))}]}))


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
            maker = multiprocessing.Process(target=lambda: write_gltf(room(int(count)), path))
            maker.start()
            maker.join()
            scenes.append((path, f"room of balls, {count}", "Y"))
        for scene, name, up in scenes:
            for quality in arguments.qualities.split(","):
                print(row(arguments.build, scene, name, quality, up), flush=True)


if __name__ == "__main__":
    main()
