#!/usr/bin/env python3
"""Writes the scenes of the final gather's experiments: make_gather_scenes.py FOLDER [plant=TRIANGLES] [hall=LIGHTS] [shadow] ...

    plant=10000    a plant on a floor whose left half is plain and whose right half is textured, in a small room under an area
                   lamp: detail that masks, as figure 4 of the grid final gather paper. The sum of the leaves' areas does not
                   depend on their number.
    hall=80        a library of shelves and 80 rectangular ceiling lights, as figure 8. Area and power of all lights together
                   do not depend on their number.
    shadow         a floor, an area lamp and a blocker, as figures 5 and 6; cameras `near` and `far`
    shadow=dim     the same with an eighth of the lamp's light, and a large panel that fills in
    shadow=bare    without blockers, and shadow=dim-bare: what the floor has where nothing is in the way

Without names: plant=10000 hall=80 shadow shadow=dim. Metres, Y up, every surface exactly Lambertian. Standard library only; the
same bytes on every machine. docs/testing.md, tests/bench/gather_*.py.
"""
import math
import pathlib
import random
import sys

from big_scene import BigScene
from effect_scene import image
from make_scenes import leaf

LEAF_AREA = 5.0     # m^2, all leaves of the plant
LAMP_AREA = 18.0    # m^2, all lights of the hall
BOOK_WIDTH = .055   # m, mean


def mosaic():
    """Tiles of four tones with dark joints, 16 across."""
    rng = random.Random(5)
    tones = [[rng.choice(((205, 190, 160), (120, 75, 50), (235, 225, 205), (70, 60, 60))) for _ in range(16)] for _ in range(16)]
    return image(256, lambda u, v: (25, 22, 20) if min(16 * u % 1, 16 * v % 1) < .1 else tones[int(16 * v)][int(16 * u)])


def plant(triangles):
    scene = BigScene(f"plant-{triangles}")
    scene.cameras["camera"] = ((0, 1.75, 2.35), (0, .55, -.2), .95)
    scene.textures["mosaic"] = mosaic()
    for name, rho in (("wall", (.72, .7, .66)), ("plain", (.45, .4, .34)), ("pot", (.52, .25, .15)), ("stem", (.2, .28, .08)),
                      ("leaf", (.1, .33, .06)), ("young leaf", (.22, .42, .1))):
        scene.material(name, rho)
    scene.material("textured", (1, 1, 1), texture="mosaic", uv=lambda p: (p[0] / 2, p[2] / 2))
    scene.material("lamp", (0, 0, 0), (24, 22, 19))
    scene.inward_box([None, "wall", "wall", "wall", "wall", "wall"], (-2, 0, -2), (2, 2.6, 2.5))
    for material, x0, x1 in (("plain", -2, 0), ("textured", 0, 2)):
        scene.polygon(material, (x0, 0, -2), (x0, 0, 2.5), (x1, 0, 2.5), (x1, 0, -2))
    scene.polygon("lamp", (-.3, 2.55, -.5), (.3, 2.55, -.5), (.3, 2.55, .1), (-.3, 2.55, .1))
    scene.cylinder("pot", (0, 0, -.2), .14, .19, .32, 16)
    scene.cylinder("stem", (0, .32, -.2), .022, .012, .75, 8)
    leaves = (triangles - scene.triangles()) // 2
    # A leaf of length l has an area of about .234 l^2; crowns of more leaves have smaller ones.
    length = math.sqrt(LEAF_AREA / leaves / .234)
    rng = random.Random(7)
    for _ in range(leaves):
        leaf(scene, rng, (0, 1.1, -.2), (.62, .5, .62), (.7 * length, 1.3 * length), .15 * length)
    return scene


def rows_and_columns(count, aspect):
    """Two factors of `count` with about the ratio columns / rows = `aspect`."""
    return min(((r, count // r) for r in range(1, count + 1) if count % r == 0), key=lambda rc: abs(math.log(rc[1] / rc[0] / aspect)))


def add_shelf(scene, rng, x, z0, z1):
    """Six boards and a back, books on both sides of it."""
    scene.box("wood", (x - .02, 0, z0), (x + .02, 2.3, z1))
    for board in range(6):
        y = .05 + .42 * board
        scene.box("wood", (x - .32, y, z0), (x + .32, y + .03, z1))
        for side in (-1, 1) if board < 5 else ():
            add_books(scene, rng, x, y + .03, side, z0 + .02, z1 - .1)


def add_books(scene, rng, x, y, side, z, end):
    while z < end:
        width, high, deep = BOOK_WIDTH * rng.uniform(.5, 1.5), rng.uniform(.22, .34), rng.uniform(.16, .24)
        near, far = sorted((x + side * .04, x + side * (.04 + deep)))
        if rng.random() < .9:  # else a gap
            scene.box(rng.choice(("red", "blue", "green", "paper", "leather")), (near, y, z), (far, y + high, z + .95 * width))
        z += width


def add_table(scene, x, z):
    scene.box("wood", (x - .9, .72, z - .45), (x + .9, .76, z + .45))
    for dx in (-.85, .79):
        for dz in (-.4, .34):
            scene.box("wood", (x + dx, 0, z + dz), (x + dx + .06, .72, z + dz + .06))
    scene.box("paper", (x - .3, .76, z - .15), (x + .02, .79, z + .1), 20)


def hall(lights):
    scene = BigScene(f"hall-{lights}")
    scene.cameras["camera"] = ((21.5, 2.0, 13.2), (9.5, 1.1, 5.5), .9)
    for name, rho in (("wall", (.7, .68, .62)), ("ceiling", (.8, .8, .8)), ("floor", (.35, .28, .2)), ("wood", (.42, .28, .15)),
                      ("red", (.5, .08, .06)), ("blue", (.08, .14, .42)), ("green", (.1, .3, .12)), ("paper", (.75, .72, .64)),
                      ("leather", (.3, .17, .08))):
        scene.material(name, rho)
    scene.material("light", (0, 0, 0), (12, 11.5, 10.5))
    width, height, depth = 24, 4.2, 14
    scene.inward_box(["floor", "ceiling", "wall", "wall", "wall", "wall"], (0, 0, 0), (width, height, depth))
    rng = random.Random(3)
    for k in range(8):
        add_shelf(scene, rng, 2 + 2.6 * k, 1, 8.5)
    for x in (5, 9, 13, 17):
        add_table(scene, x, 11.2)
    rows, columns = rows_and_columns(lights, width / depth)
    b = math.sqrt(LAMP_AREA / lights / 2) / 2  # half the shorter side, twice as long as wide
    for i in range(columns):
        for j in range(rows):
            x, y, z = width * (i + .5) / columns, height - .06, depth * (j + .5) / rows
            scene.polygon("light", (x - 2 * b, y, z - b), (x + 2 * b, y, z - b), (x + 2 * b, y, z + b), (x - 2 * b, y, z + b))
    return scene


def add_blockers(scene):
    """A board over the floor and a post on it: smooth shadows, and one that is sharp at its foot."""
    scene.box("blocker", (-1.3, .5, -.5), (-.3, .54, .5), 25)
    scene.box("blocker", (.35, 0, -.35), (.5, .8, -.2))


def shadow(kind):
    scene = BigScene("-".join(filter(None, ("shadow", kind))))
    scene.cameras |= {"near": ((.2, 1.3, 2.1), (-.1, 0, .1), .6), "far": ((.8, 5.2, 8.4), (-.1, 0, .1), .6)}
    scene.material("floor", (.6, .58, .54))
    scene.material("blocker", (.35, .2, .12))
    scene.polygon("floor", (-12, 0, -12), (-12, 0, 12), (12, 0, 12), (12, 0, -12))
    if "bare" not in kind:
        add_blockers(scene)
    share = 1 / 8 if "dim" in kind else 1
    scene.material("lamp", (0, 0, 0), (share * 30, share * 29, share * 27))
    scene.polygon("lamp", (.8, 3, -.4), (1.6, 3, -.4), (1.6, 3, .4), (.8, 3, .4))
    if "dim" in kind:
        scene.material("panel", (0, 0, 0), (.35, .35, .35))
        scene.polygon("panel", (-4, 6, -4), (4, 6, -4), (4, 6, 4), (-4, 6, 4))
    return scene


MAKERS = {"plant": lambda n: plant(int(n or 10000)), "hall": lambda n: hall(int(n or 80)), "shadow": shadow}


def make(name, folder):
    """The scene `name` in `folder`, written unless it is there."""
    kind, _, value = name.partition("=")
    stem = {"plant": f"plant-{value or 10000}", "hall": f"hall-{value or 80}", "shadow": "-".join(filter(None, ("shadow", value)))}[kind]
    path = pathlib.Path(folder, stem + ".gltf")
    return path if path.exists() else MAKERS[kind](value).write(path.parent)


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    pathlib.Path(sys.argv[1]).mkdir(parents=True, exist_ok=True)
    for wanted in sys.argv[2:] or ["plant=10000", "hall=80", "shadow", "shadow=dim"]:
        print(make(wanted, sys.argv[1]))
