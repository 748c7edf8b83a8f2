#!/usr/bin/env python3
"""Writes tests/scenes/oracle_room.gltf: python3 tests/scenes/make_oracle_room.py

The room of the paper's oracle experiment, as far as its figures tell: a table, a chair before it and cubes on the right
wall under one area lamp. 5 x 2.7 x 4 m, closed, exactly Lambertian. Standard library only; the same bytes on every machine.
"""
from make_scenes import Scene


def oracle_room():
    scene = Scene("oracle_room", [.5, 1.6, 3.8], [3.0, .8, 1.2], 1.0)
    for name, rho in {"wall": (.7, .68, .62), "ceiling": (.8, .8, .8), "floor": (.4, .34, .28), "wood": (.5, .32, .17),
                      "chair": (.2, .3, .5), "cube": (.65, .45, .25), "lamp": (0, 0, 0)}.items():
        scene.material(name, rho, (40, 38, 34) if name == "lamp" else None)
    width, height, depth = 5, 2.7, 4
    scene.inward_box(["floor", None, "wall", "wall", "wall", "wall"], (0, 0, 0), (width, height, depth))
    scene.plane_with_holes("ceiling", lambda x, z: (x, height, z), [0, width], [0, depth], [(2.0, 2.6, 1.7, 2.3, "lamp")])
    scene.box("wood", (2.2, .70, 1.0), (3.8, .74, 1.9))
    for x in (2.25, 3.69):
        for z in (1.05, 1.79):
            scene.box("wood", (x, 0, z), (x + .06, .70, z + .06))
    add_chair(scene, 2.9, 2.25)
    for y, z, size in ((.6, .7, .3), (1.2, 1.5, .3), (.8, 2.5, .4)):
        scene.box("cube", (width - size, y, z), (width, y + size, z + size))
    return scene


def add_chair(scene, x, z):
    scene.box("chair", (x - .21, .42, z - .21), (x + .21, .46, z + .21))
    scene.box("chair", (x - .21, .46, z + .18), (x + .21, .95, z + .21))
    for dx in (-.21, .17):
        for dz in (-.21, .17):
            scene.box("chair", (x + dx, 0, z + dz), (x + dx + .04, .42, z + dz + .04))


if __name__ == "__main__":
    oracle_room().write()
