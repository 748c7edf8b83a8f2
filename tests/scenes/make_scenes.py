#!/usr/bin/env python3
"""Writes the small test scenes of this folder, each one .gltf with an embedded buffer: python3 tests/scenes/make_scenes.py

World: metres, Y up, right-handed. Every surface is exactly Lambertian (metallicFactor 0, specularFactor 0); emitters
face the way their corners run counter-clockwise. Standard library only; the same bytes on every machine.
"""
import base64
import json
import math
import pathlib
import random
import struct

FOLDER = pathlib.Path(__file__).resolve().parent


class Scene:
    def __init__(self, name, eye=None, look_at=None, yfov=None):
        self.name, self.camera, self.light = name, (eye, look_at, yfov), None
        self.materials, self.faces = {}, {}

    def material(self, name, rho, emission=None):
        self.materials[name] = (rho, emission)
        self.faces[name] = []

    def polygon(self, material, *corners):
        """A convex polygon, seen counter-clockwise from its front."""
        self.faces[material].append([tuple(map(float, c)) for c in corners])

    def box(self, material, low, high, turn=0.0):
        """Outward-facing, turned about its vertical axis by degrees."""
        middle = [(a + b) / 2 for a, b in zip(low, high)]
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))

        def corner(i):
            x, y, z = ((high if i >> k & 1 else low)[k] - middle[k] for k in range(3))
            return (middle[0] + c * x + s * z, middle[1] + y, middle[2] - s * x + c * z)

        for face in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 4, 6, 2), (1, 3, 7, 5), (2, 6, 7, 3), (0, 1, 5, 4)):
            self.polygon(material, *map(corner, face))

    def cylinder(self, material, base, radius, top_radius, height, sides=12):
        x, y, z = base
        ring = [(math.cos(2 * math.pi * i / sides), math.sin(2 * math.pi * i / sides)) for i in range(sides)]
        low = [(x + radius * c, y, z + radius * s) for c, s in ring]
        high = [(x + top_radius * c, y + height, z + top_radius * s) for c, s in ring]
        for i in range(sides):
            k = (i + 1) % sides
            self.polygon(material, low[i], high[i], high[k], low[k])
        self.polygon(material, *reversed(high))
        self.polygon(material, *low)

    def inward_box(self, materials, low, high):
        """A room: materials for floor, ceiling, x low, x high, z low, z high (None leaves a side open)."""
        (a, b, c), (d, e, f) = low, high
        sides = [[(a, b, c), (a, b, f), (d, b, f), (d, b, c)], [(a, e, c), (d, e, c), (d, e, f), (a, e, f)],
                 [(a, b, c), (a, e, c), (a, e, f), (a, b, f)], [(d, b, c), (d, b, f), (d, e, f), (d, e, c)],
                 [(a, b, c), (d, b, c), (d, e, c), (a, e, c)], [(a, b, f), (a, e, f), (d, e, f), (d, b, f)]]
        for material, side in zip(materials, sides):
            if material:
                self.polygon(material, *side)

    def plane_with_holes(self, material, point, xs, ys, holes):
        """The rectangle xs x ys, mapped by point(x, y), with rectangles (x0, x1, y0, y1, material) set into it."""
        xs = sorted(set(xs) | {h[0] for h in holes} | {h[1] for h in holes})
        ys = sorted(set(ys) | {h[2] for h in holes} | {h[3] for h in holes})
        for x0, x1 in zip(xs, xs[1:]):
            for y0, y1 in zip(ys, ys[1:]):
                inside = [h for h in holes if h[0] < (x0 + x1) / 2 < h[1] and h[2] < (y0 + y1) / 2 < h[3]]
                name = inside[0][4] if inside else material
                self.polygon(name, point(x0, y0), point(x1, y0), point(x1, y1), point(x0, y1))

    def write(self):
        gltf = bare_gltf(self.name, "make_scenes.py")
        data = bytearray()
        for name, (rho, emission) in self.materials.items():
            add_material(gltf, name, rho, emission)
            if self.faces[name]:
                gltf["meshes"][0]["primitives"].append(add_primitive(gltf, data, self.faces[name]))
                gltf["meshes"][0]["primitives"][-1]["material"] = len(gltf["materials"]) - 1
        uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        gltf["buffers"].append({"byteLength": len(data), "uri": uri})
        eye, look_at, yfov = self.camera
        if eye:
            add_camera(gltf, "camera", eye, look_at, {"yfov": yfov, "znear": .01})
        if self.light:
            gltf["extensionsUsed"].append("KHR_lights_punctual")
            gltf["extensions"] = {"KHR_lights_punctual": {"lights": [self.light[1]]}}
            add_node(gltf, {"name": "light", "translation": self.light[0],
                            "extensions": {"KHR_lights_punctual": {"light": 0}}})
        text = json.dumps(gltf, indent=1) + "\n"
        assert len(text) < 200_000, self.name
        (FOLDER / (self.name + ".gltf")).write_text(text)


def bare_gltf(name, generator):
    """One node with one mesh, which has nothing yet."""
    return {"asset": {"version": "2.0", "generator": f"radfarm tests/scenes/{generator}"},
            "extensionsUsed": ["KHR_materials_specular"], "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"name": name, "mesh": 0}], "meshes": [{"name": name, "primitives": []}],
            "materials": [], "accessors": [], "bufferViews": [], "buffers": []}


def add_node(gltf, node):
    gltf["scenes"][0]["nodes"].append(len(gltf["nodes"]))
    gltf["nodes"].append(node)


def add_camera(gltf, name, eye, look_at, perspective):
    gltf.setdefault("cameras", []).append({"type": "perspective", "perspective": perspective})
    add_node(gltf, {"name": name, "camera": len(gltf["cameras"]) - 1, "translation": eye, "rotation": look_rotation(eye, look_at)})


def add_material(gltf, name, rho, emission):
    material = {"name": name, "extensions": {"KHR_materials_specular": {"specularFactor": 0}},
                "pbrMetallicRoughness": {"baseColorFactor": [*rho, 1], "metallicFactor": 0, "roughnessFactor": 1}}
    if emission:
        strength = max(*emission, 1)
        material["emissiveFactor"] = [e / strength for e in emission]
        if strength != 1:
            material["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
            if "KHR_materials_emissive_strength" not in gltf["extensionsUsed"]:
                gltf["extensionsUsed"].append("KHR_materials_emissive_strength")
    gltf["materials"].append(material)


def add_accessor(gltf, data, blob, component, kind, count, **more):
    gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(blob)})
    data += blob + bytes(-len(blob) % 4)
    gltf["accessors"].append({"bufferView": len(gltf["bufferViews"]) - 1, "componentType": component, "type": kind,
                              "count": count, **more})
    return len(gltf["accessors"]) - 1


def add_primitive(gltf, data, faces):
    points, indices = [], []
    for corners in faces:
        first = len(points)
        points += [struct.unpack("<3f", struct.pack("<3f", *c)) for c in corners]
        for i in range(1, len(corners) - 1):
            indices += [first, first + i, first + i + 1]
    bounds = {"min": [min(p[k] for p in points) for k in range(3)], "max": [max(p[k] for p in points) for k in range(3)]}
    positions = b"".join(struct.pack("<3f", *p) for p in points)
    attribute = add_accessor(gltf, data, positions, 5126, "VEC3", len(points), **bounds)
    assert len(points) < 65535
    corners = add_accessor(gltf, data, struct.pack(f"<{len(indices)}H", *indices), 5123, "SCALAR", len(indices))
    return {"attributes": {"POSITION": attribute}, "indices": corners}


def normalized(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def look_rotation(eye, look_at):
    """The quaternion that turns -z to look_at - eye and keeps +y up: yaw about y, then pitch about the turned x."""
    d = normalized([b - a for a, b in zip(eye, look_at)])
    yaw, pitch = math.atan2(-d[0], -d[2]) / 2, math.asin(d[1]) / 2
    q = [math.cos(yaw) * math.sin(pitch), math.sin(yaw) * math.cos(pitch), -math.sin(yaw) * math.sin(pitch),
         math.cos(yaw) * math.cos(pitch)]
    return [round(x, 12) + 0.0 for x in q]


def cornell():
    """The Cornell box as measured, in decimetres of the original's millimetres: 5.5 m wide; the light is a ceiling hole."""
    scene = Scene("cornell", [2.78, 2.73, -8.0], [2.78, 2.73, 0], 2 * math.atan(.0125 / .035))
    scene.material("white", (.73, .73, .73))
    scene.material("red", (.63, .065, .05))
    scene.material("green", (.14, .45, .091))
    scene.material("light", (0, 0, 0), (17, 12, 4))

    def quad(material, *corners):
        scene.polygon(material, *[[x / 100 for x in c] for c in corners])

    quad("white", (552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2))
    scene.plane_with_holes("white", lambda x, z: (x / 100, 5.488, z / 100), [0, 556], [0, 559.2],
                           [(213, 343, 227, 332, "light")])
    quad("white", (549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2))
    quad("green", (0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2))
    quad("red", (552.8, 0, 0), (549.6, 0, 559.2), (556, 548.8, 559.2), (556, 548.8, 0))
    for top, height in (((130, 65), (82, 225), (240, 272), (290, 114)), 165), \
                       (((423, 247), (265, 296), (314, 456), (472, 406)), 330):
        quad("white", *[(x, height, z) for x, z in top])
        for (x0, z0), (x1, z1) in zip(top, top[1:] + top[:1]):
            quad("white", (x1, 0, z1), (x1, height, z1), (x0, height, z0), (x0, 0, z0))
    return scene


def furnace():
    """A closed cube, rho 0.5, L_e 1 everywhere: the radiance is 1 / (1 - 0.5) = 2 in every direction."""
    scene = Scene("furnace", [0.1, 0.05, 0.2], [-0.5, -0.3, -1], 1.0)
    scene.material("wall", (.5, .5, .5), (1, 1, 1))
    scene.inward_box(["wall"] * 6, (-1, -1, -1), (1, 1, 1))
    return scene


def plates():
    """Two parallel unit squares at distance 1 that face each other, F = 0.1998249; the lower one emits 1."""
    scene = Scene("plates", [0.5, 0.5, 3], [0.5, 0.5, 0], 0.6)
    scene.material("emitter", (0, 0, 0), (1, 1, 1))
    scene.material("receiver", (.5, .5, .5))
    scene.polygon("emitter", (0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0))
    scene.polygon("receiver", (0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1))
    return scene


def sheet():
    """Two closed chambers that share one wall, a sheet without thickness: the left is lit, the right must be black."""
    scene = Scene("sheet", [1.7, 0.5, 0.9], [1.0, 0.5, 0.3], 1.2)
    scene.material("wall", (.7, .7, .7))
    scene.material("sheet", (.7, .6, .5))
    scene.material("light", (0, 0, 0), (5, 5, 5))
    scene.inward_box(["wall", None, "wall", None, "wall", "wall"], (0, 0, 0), (1, 1, 1))
    scene.plane_with_holes("wall", lambda x, z: (x, 1, z), [0, 1], [0, 1], [(.3, .7, .3, .7, "light")])
    scene.inward_box(["wall", "wall", None, "wall", "wall", "wall"], (1, 0, 0), (2, 1, 1))
    scene.polygon("sheet", (1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0))
    return scene


def emitters_reflect():
    """A closed box: floor and ceiling emit and reflect, the side walls only reflect."""
    scene = Scene("emitters_reflect", [1.6, 0.8, 1.7], [0.3, 0.4, 0.2], 1.0)
    scene.material("floor", (.6, .5, .4), (1, 2, 3))
    scene.material("ceiling", (.8, .8, .8), (4, 3, 2))
    scene.material("wall", (.5, .6, .7))
    scene.inward_box(["floor", "ceiling", "wall", "wall", "wall", "wall"], (0, 0, 0), (2, 1, 2))
    return scene


def point_light():
    """A floor 2 m below a point light of 100 cd: E = 100 / 4 = 25 lux below it, L = rho E / pi."""
    scene = Scene("point_light", [0, 1.5, 4], [0, 0, 0], 0.9)
    scene.material("floor", (.5, .5, .5))
    scene.polygon("floor", (-5, 0, -5), (-5, 0, 5), (5, 0, 5), (5, 0, -5))
    scene.light = [0, 2, 0], {"type": "point", "name": "lamp", "color": [1, 1, 1], "intensity": 100}
    return scene


def plant(scene, rng, x, z, leaves):
    scene.cylinder("pot", (x, 0, z), .13, .18, .3, 16)
    for _ in range(6):
        angle, reach = rng.uniform(0, 2 * math.pi), rng.uniform(.05, .25)
        top = (x + reach * math.cos(angle), rng.uniform(.8, 1.2), z + reach * math.sin(angle))
        side = .008
        scene.polygon("stem", (x - side, .3, z), (x + side, .3, z), top)
        scene.polygon("stem", (x, .3, z - side), (x, .3, z + side), top)
    for _ in range(leaves):
        leaf(scene, rng, (x, .95, z), (.4, .38, .4), (.08, .15))


def leaf(scene, rng, at, crown, lengths, droop=.02):
    """Two triangles that grow outwards in a crown of half axes `crown` around `at`."""
    u = normalized([rng.gauss(0, 1) for _ in range(3)])
    r = rng.uniform(.25, 1) ** .6
    foot = [at[k] + crown[k] * r * u[k] for k in range(3)]
    out = normalized([u[0] + rng.gauss(0, .45), .5 * u[1] - .15 + rng.gauss(0, .45), u[2] + rng.gauss(0, .45)])
    width = normalized(cross(out, [.5 * u[0], 1, .5 * u[2] + .1]))
    length = rng.uniform(*lengths)
    left, right = ([foot[k] + length * (.45 * out[k] + s * .26 * width[k]) for k in range(3)] for s in (1, -1))
    tip = [foot[k] + length * out[k] - (droop if k == 1 else 0) for k in range(3)]
    scene.polygon(rng.choice(["leaf", "young leaf"]), foot, right, tip)
    scene.polygon("leaf", foot, tip, left)


def room():
    """A furnished room of 6 x 2.8 x 5 m: ceiling panels, a window that glows like an overcast sky, table, chairs, plant."""
    scene = Scene("room", [5.6, 1.6, 4.6], [1.9, .8, 1.3], math.radians(55))
    for name, rho in {"wall": (.72, .70, .66), "ceiling": (.8, .8, .8), "floor": (.30, .25, .20),
                      "wood": (.46, .30, .16), "chair": (.12, .20, .45), "metal": (.45, .45, .46),
                      "pot": (.52, .25, .15), "stem": (.20, .28, .08), "leaf": (.10, .33, .06),
                      "young leaf": (.22, .42, .10), "paper": (.80, .78, .72), "book": (.55, .10, .08)}.items():
        scene.material(name, rho)
    scene.material("panel", (0, 0, 0), (10, 9.5, 8.5))
    scene.material("window", (0, 0, 0), (6, 7.5, 9.5))
    width, height, depth = 6.0, 2.8, 5.0
    scene.inward_box(["floor", None, None, "wall", "wall", "wall"], (0, 0, 0), (width, height, depth))
    panels = [(a, a + 1.2, b, b + .3, "panel") for a in (1.0, 3.8) for b in (1.4, 3.4)]
    scene.plane_with_holes("ceiling", lambda x, z: (x, height, z), [0, width], [0, depth], panels)
    scene.plane_with_holes("wall", lambda u, v: (0, v, -u), [-depth, 0], [0, height], [(-3.6, -1.4, .9, 2.2, "window")])
    scene.box("paper", (0, .84, 1.3), (.16, .89, 3.7))
    scene.box("wood", (1.6, .71, 1.6), (3.2, .75, 2.5))
    for x in (1.65, 3.11):
        for z in (1.65, 2.41):
            scene.box("metal", (x, 0, z), (x + .04, .71, z + .04))
    for x, z, turn in ((2.0, .95, 0), (2.9, 2.95, 170), (3.75, 2.0, 75)):
        scene.box("chair", (x - .21, .43, z - .21), (x + .21, .47, z + .21), turn)
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        back = (x - .2 * s, z - .2 * c)
        scene.box("chair", (back[0] - .2, .47, back[1] - .02), (back[0] + .2, .9, back[1] + .02), turn)
        for a in (-.18, .18):
            for b in (-.18, .18):
                leg = (x + c * a + s * b, z - s * a + c * b)
                scene.box("metal", (leg[0] - .015, 0, leg[1] - .015), (leg[0] + .015, .43, leg[1] + .015), turn)
    scene.box("paper", (2.2, .75, 1.9), (2.41, .76, 2.2), 12)
    scene.box("book", (2.7, .75, 1.8), (2.86, .79, 2.03), -20)
    for shelf in range(4):
        scene.box("wood", (4.4, .1 + .45 * shelf, .0), (5.6, .13 + .45 * shelf, .3))
        for i in range(9 - shelf):
            low = (4.45 + .09 * i, .13 + .45 * shelf, .03)
            scene.box("book" if i % 3 else "paper", low, (low[0] + .05, low[1] + .24 + .02 * (i % 4), .22))
    plant(scene, random.Random(7), .75, 4.2, 320)
    return scene


if __name__ == "__main__":
    for make in (cornell, furnace, plates, sheet, emitters_reflect, point_light, room):
        make().write()
