"""What the scenes of make_effect_scenes.py share: colours, surfaces, pictures and the stage."""
import math
import random

from make_scenes import cross, normalized

GREY, WHITE, BLACK = (.5, .5, .5), (.75, .75, .75), (0, 0, 0)
RED, GREEN, BLUE, GOLD = (.62, .08, .05), (.12, .45, .09), (.08, .16, .55), (.95, .75, .35)
GLASS = {"specular": 1, "roughness": 0}


def square(scene, material, x0, x1, z0, z1, y):
    """Level, facing up."""
    scene.polygon(material, (x0, y, z0), (x0, y, z1), (x1, y, z1), (x1, y, z0))


def ceiling_square(scene, material, x0, x1, z0, z1, y):
    """Level, facing down."""
    scene.polygon(material, (x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))


def upright(scene, material, x0, x1, y0, y1, z):
    """Facing the viewer, +z."""
    scene.polygon(material, (x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))


def stage(scene, floor="floor", wall="wall", panel=20):
    """4 m of floor and a wall at its back, under a panel of 1 m^2 (0: none)."""
    for name in (floor, wall):
        if name and name not in scene.materials:
            scene.material(name, GREY)
    square(scene, floor, -2, 2, -2, 2, 0)
    if wall:
        upright(scene, wall, -2, 2, 0, 2.5, -2)
    if panel:
        scene.material("panel", BLACK, (panel,) * 3)
        ceiling_square(scene, "panel", -.5, .5, -.3, .7, 2.6)


def three_boxes(scene, *materials):
    for i, (x, z, height, turn) in enumerate(((-1, -.5, 1.1, 20), (.2, .5, .5, -15), (1.1, -.7, .8, 40))):
        scene.box(materials[i % len(materials)], (x - .3, 0, z - .3), (x + .3, height, z + .3), turn)


def tiles(u, v):
    return (235, 230, 220) if (int(6 * u) + int(6 * v)) % 2 else (200, 40, 30) if u < .5 else (30, 60, 190)


def screen(u, v):
    """Dark but for panes with bars, red on the left and blue on the right."""
    if not .1 < v < .9 or min(15 * u % 1, 8 * v % 1) < .2:
        return (0, 0, 0)
    return (255, 40, 20) if .05 < u < .34 else (30, 80, 255) if .66 < u < .94 else (0, 0, 0)


def leaf(u, v):
    """Lens-shaped, with a lobed edge and a pale rib."""
    half = .36 * math.sin(math.pi * v) * (1 + .25 * math.cos(20 * v))
    alpha = 255 if abs(u - .5) < half or (abs(u - .5) < .03 and v > .5) else 0
    return (150, 180, 70, alpha) if abs(u - .5) < .025 else (60, 130, 40, alpha)


def add_leaves(scene, middle, radius, count, seed, size):
    rng = random.Random(seed)
    for _ in range(count):
        d = normalized([rng.gauss(0, 1) for _ in range(3)])
        r = radius * rng.uniform(.2, 1) ** .5
        at = [middle[k] + r * d[k] for k in range(3)]
        out = normalized([d[0] + rng.gauss(0, .4), .4 * d[1] + rng.gauss(0, .4), d[2] + rng.gauss(0, .4)])
        side = normalized(cross(out, normalized([rng.gauss(0, .5), 1, rng.gauss(0, .5)])))
        corners = [[at[k] + size * (a * side[k] + b * out[k]) for k in range(3)]
                   for a, b in ((-.4, 0), (.4, 0), (.4, 1), (-.4, 1))]
        scene.polygon("leaf", *corners, uv=[(0, 1), (1, 1), (1, 0), (0, 0)])


def studs(u, v):
    """Domes that rise from the wall, as normals; green is up."""
    x, y = (3 * u) % 1 - .5, .5 - (3 * v) % 1
    r = math.hypot(x, y)
    tilt = 2.0 * math.sin(math.pi * r / .4) if 0 < r < .4 else 0
    n = normalized([tilt * x / r, tilt * y / r, 1] if tilt else [0, 0, 1])
    return tuple(round(127.5 * c + 127.5) for c in n)


def glass(attenuation, distance):
    return GLASS | {"extensions": {"transmission": {"transmissionFactor": 1}, "ior": {"ior": 1.5},
                                   "volume": {"thicknessFactor": 1, "attenuationDistance": distance,
                                              "attenuationColor": list(attenuation)}}}
