"""Scenes of any number of triangles, written as NAME.gltf and NAME.bin, with textures and several cameras."""
import json
from array import array

from effect_scene import EffectScene, add_options, rounded
from make_scenes import add_accessor, add_camera, add_material, bare_gltf


class Part:
    """Flat arrays of one primitive: an object a triangle would not fit into memory."""

    def __init__(self, material):
        self.material, self.points, self.uvs, self.indices = material, array("f"), array("f"), array("I")

    def add(self, points, triangles):
        first = len(self.points) // 3
        for p in points:
            self.points.extend(p)
        for t in triangles:
            self.indices.extend([first + i for i in t])


class BigScene(EffectScene):
    def __init__(self, name):
        super().__init__(name)
        self.cameras, self.meshes = {}, []

    def material(self, name, rho=(.7, .7, .7), emission=None, **options):
        """As of EffectScene; without normal maps and colours of corners."""
        self.materials[name] = (rho, emission, options)
        self.faces[name] = Part(name)

    def polygon(self, material, *corners):
        """A convex polygon, seen counter-clockwise from its front. Those of one material are one primitive."""
        part, uv_of = self.faces[material], self.materials[material][2].get("uv")
        part.add(corners, [(0, i, i + 1) for i in range(1, len(corners) - 1)])
        for corner in corners if uv_of else ():
            part.uvs.extend(uv_of(corner))

    def mesh(self, material, points, triangles):
        """A mesh and a node of its own, corners shared."""
        self.meshes.append(Part(material))
        self.meshes[-1].add(points, triangles)

    def triangles(self):
        return sum(len(part.indices) for part in [*self.faces.values(), *self.meshes]) // 3

    def write(self, folder):
        gltf, data = bare_gltf(self.name, "big_scene.py"), bytearray()
        self.add_textures(gltf)
        for name, (rho, emission, options) in self.materials.items():
            add_material(gltf, name, rho, emission)
            add_options(gltf, list(self.textures), options)
        names = list(self.materials)
        faces = [part for part in self.faces.values() if part.indices]
        gltf["meshes"][0]["primitives"] = [add_part(gltf, data, part, names) for part in faces]
        if not faces:
            gltf["meshes"], gltf["nodes"] = [], []
        for part in self.meshes:
            gltf["meshes"].append({"primitives": [add_part(gltf, data, part, names)]})
            gltf["nodes"].append({"mesh": len(gltf["meshes"]) - 1})
        gltf["scenes"][0]["nodes"] = list(range(len(gltf["nodes"])))
        for name, (eye, look_at, yfov) in self.cameras.items():
            add_camera(gltf, name, list(eye), list(look_at), {"yfov": yfov, "znear": .01})
        gltf["extensionsUsed"].sort()
        gltf["buffers"].append({"uri": self.name + ".bin", "byteLength": len(data)})
        (folder / (self.name + ".bin")).write_bytes(data)
        path = folder / (self.name + ".gltf")
        path.write_text(json.dumps(rounded(gltf)) + "\n")
        return path


def add_part(gltf, data, part, materials):
    bounds = {name: [of(part.points[k::3]) for k in range(3)] for name, of in (("min", min), ("max", max))}
    attributes = {"POSITION": add_accessor(gltf, data, part.points.tobytes(), 5126, "VEC3", len(part.points) // 3, **bounds)}
    if part.uvs:
        attributes["TEXCOORD_0"] = add_accessor(gltf, data, part.uvs.tobytes(), 5126, "VEC2", len(part.uvs) // 2)
    indices = add_accessor(gltf, data, part.indices.tobytes(), 5125, "SCALAR", len(part.indices))
    return {"attributes": attributes, "indices": indices, "material": materials.index(part.material)}
