"""Scenes with what make_scenes.Scene lacks: textures, smooth shapes, vertex colours, lamps and materials beyond Lambert."""
import base64
import json
import math
import struct
import zlib

from make_scenes import (FOLDER, Scene, add_accessor, add_camera, add_material, add_node, bare_gltf, cross, look_rotation, normalized)

DOWN = [-math.sqrt(.5), 0, 0, math.sqrt(.5)]  # turns -z, the way lamps shine, to -y


class EffectScene(Scene):
    def __init__(self, name, eye=(0, 1.5, 4.6), look_at=(0, .75, 0), yfov=.66):
        super().__init__(name, list(eye), list(look_at), yfov)
        self.lights, self.textures, self.placed, self.shapes = [], {}, [], {"sphere": sphere}

    def material(self, name, rho=(.7, .7, .7), emission=None, **options):
        """Lambertian, but for options:
        texture, emission_texture, normal_texture: names; with uv, point -> (u, v); normal_texture with tangent, (x, y, z, w)
        mask: the texture's alpha cuts out; has_colors: polygons bring the colours of their corners
        metallic, roughness, specular: factors, of which specular is 1 in every ordinary dielectric
        extensions: the rest, by name."""
        self.materials[name] = (rho, emission, options)
        self.faces[name] = []

    def polygon(self, material, *corners, uv=None, colors=None):
        uv_of = self.materials[material][2].get("uv")
        uv = uv or (uv_of and [uv_of(c) for c in corners])
        self.faces[material].append(([tuple(map(float, c)) for c in corners], uv, colors))

    def smooth(self, shape, material, at, scale):
        self.placed.append((shape, material, at, scale if isinstance(scale, (tuple, list)) else (scale,) * 3))

    def lamp(self, material, at, target, size):
        """A square that emits towards `target`."""
        d = normalized([b - a for a, b in zip(at, target)])
        right = normalized(cross(d, [0, 1, 0] if abs(d[1]) < .9 else [0, 0, -1]))
        up = cross(right, d)
        self.polygon(material, *[[at[k] + size / 2 * (a * right[k] + b * up[k]) for k in range(3)]
                                 for a, b in ((-1, -1), (-1, 1), (1, 1), (1, -1))])

    def punctual(self, kind, at, intensity, color=(1, 1, 1), target=None, rotation=None, name="lamp", cone=None):
        source = {"type": kind, "name": name, "color": list(color), "intensity": intensity}
        if cone:
            source["spot"] = {"innerConeAngle": cone[0], "outerConeAngle": cone[1]}
        node = {"name": name, "translation": list(at)}
        if target or rotation:
            node["rotation"] = rotation or look_rotation(at, target)
        self.lights.append((node, source))

    def write(self):
        gltf = bare_gltf(self.name, "make_effect_scenes.py")
        data = bytearray()
        self.add_textures(gltf)
        indices = {name: i for i, name in enumerate(self.materials)}
        for name, faces in self.faces.items():
            rho, emission, options = self.materials[name]
            add_material(gltf, name, rho, emission)
            add_options(gltf, list(self.textures), options)
            if faces:
                primitive = add_faces(gltf, data, faces, options)
                gltf["meshes"][0]["primitives"].append(primitive | {"material": indices[name]})
        self.add_placed(gltf, data, indices)
        uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        gltf["buffers"].append({"byteLength": len(data), "uri": uri})
        eye, look_at, yfov = self.camera
        add_camera(gltf, "camera", eye, look_at, {"yfov": yfov, "aspectRatio": 4 / 3, "znear": .01})
        self.add_lights(gltf)
        gltf["extensionsUsed"].sort()
        text = json.dumps(rounded(gltf), indent=1) + "\n"
        assert len(text) < 100_000, (self.name, len(text))
        (FOLDER / "effects" / (self.name + ".gltf")).write_text(text)

    def add_textures(self, gltf):
        if not self.textures:
            return
        gltf["images"] = [{"name": name, "uri": "data:image/png;base64," + base64.b64encode(png(rows)).decode()}
                          for name, rows in self.textures.items()]
        gltf["textures"] = [{"source": i} for i in range(len(self.textures))]

    def add_placed(self, gltf, data, indices):
        primitives, meshes = {}, {}
        for shape, material, at, scale in self.placed:
            if shape not in primitives:
                primitives[shape] = add_smooth(gltf, data, *self.shapes[shape]())
            if (shape, material) not in meshes:
                meshes[shape, material] = len(gltf["meshes"])
                gltf["meshes"].append({"name": f"{material} {shape}",
                                       "primitives": [primitives[shape] | {"material": indices[material]}]})
            add_node(gltf, {"name": f"{material} {shape}", "mesh": meshes[shape, material], "translation": list(at),
                            "scale": list(scale)})

    def add_lights(self, gltf):
        if not self.lights:
            return
        gltf["extensionsUsed"].append("KHR_lights_punctual")
        gltf["extensions"] = {"KHR_lights_punctual": {"lights": [source for _, source in self.lights]}}
        for i, (node, _) in enumerate(self.lights):
            add_node(gltf, node | {"extensions": {"KHR_lights_punctual": {"light": i}}})


def rounded(value):
    """JSON with numbers that do not depend on the last bits of a machine's sines."""
    if isinstance(value, dict):
        return {key: rounded(v) for key, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(v) for v in value]
    return round(value, 9) + 0.0 if isinstance(value, float) else value


def add_options(gltf, textures, options):
    material = gltf["materials"][-1]
    pbr = material["pbrMetallicRoughness"]
    pbr["metallicFactor"] = options.get("metallic", 0)
    pbr["roughnessFactor"] = options.get("roughness", 1)
    if options.get("specular"):
        material["extensions"]["KHR_materials_specular"]["specularFactor"] = options["specular"]
    for key, place, field in (("texture", pbr, "baseColorTexture"), ("emission_texture", material, "emissiveTexture"),
                              ("normal_texture", material, "normalTexture")):
        if key in options:
            place[field] = {"index": textures.index(options[key])}
    if options.get("mask"):
        material |= {"alphaMode": "MASK", "alphaCutoff": .5, "doubleSided": True}
    for name, value in options.get("extensions", {}).items():
        material["extensions"]["KHR_materials_" + name] = value
    gltf["extensionsUsed"] += [e for e in material["extensions"] if e not in gltf["extensionsUsed"]]


def add_vectors(gltf, data, vectors, **more):
    width = len(vectors[0])
    blob = b"".join(struct.pack(f"<{width}f", *v) for v in vectors)
    return add_accessor(gltf, data, blob, 5126, f"VEC{width}", len(vectors), **more)


def add_points(gltf, data, points):
    points = [struct.unpack("<3f", struct.pack("<3f", *p)) for p in points]
    return add_vectors(gltf, data, points, min=[min(p[k] for p in points) for k in range(3)],
                       max=[max(p[k] for p in points) for k in range(3)])


def add_indices(gltf, data, indices):
    return add_accessor(gltf, data, struct.pack(f"<{len(indices)}H", *indices), 5123, "SCALAR", len(indices))


def add_faces(gltf, data, faces, options):
    points, indices, uvs, colors, normals = [], [], [], [], []
    for corners, uv, color in faces:
        first = len(points)
        points += corners
        uvs += uv or []
        colors += color or []
        u, v = ([b - a for a, b in zip(corners[0], corners[i])] for i in (1, 2))
        normals += [normalized(cross(u, v))] * len(corners)
        for i in range(1, len(corners) - 1):
            indices += [first, first + i, first + i + 1]
    attributes = {"POSITION": add_points(gltf, data, points)}
    if any(key in options for key in ("texture", "emission_texture", "normal_texture")):
        assert len(uvs) == len(points)
        attributes["TEXCOORD_0"] = add_vectors(gltf, data, uvs)
    if "normal_texture" in options:
        attributes["NORMAL"] = add_vectors(gltf, data, normals)
        attributes["TANGENT"] = add_vectors(gltf, data, [options["tangent"]] * len(points))
    if options.get("has_colors"):
        assert len(colors) == len(points)
        attributes["COLOR_0"] = add_vectors(gltf, data, colors)
    return {"attributes": attributes, "indices": add_indices(gltf, data, indices)}


def add_smooth(gltf, data, points, normals, indices):
    position = add_points(gltf, data, points)
    normal = position if normals is points else add_vectors(gltf, data, normals)
    return {"attributes": {"POSITION": position, "NORMAL": normal}, "indices": add_indices(gltf, data, indices)}


def sphere(rings=16, sides=32):
    """Radius 1, 960 triangles; its points are its normals."""
    points = [(0, 1, 0)]
    for r in range(1, rings):
        t = math.pi * r / rings
        points += [(math.sin(t) * math.cos(2 * math.pi * s / sides), math.cos(t),
                    math.sin(t) * math.sin(2 * math.pi * s / sides)) for s in range(sides)]
    points.append((0, -1, 0))
    last, indices = len(points) - 1, []
    for s in range(sides):
        k = (s + 1) % sides
        indices += [0, 1 + k, 1 + s, last, last - sides + s, last - sides + k]
        for r in range(rings - 2):
            a, b = 1 + r * sides, 1 + (r + 1) * sides
            indices += [a + s, a + k, b + k, a + s, b + k, b + s]
    return points, points, indices


def hollow():
    """A sphere seen from inside: the inner face of a shell."""
    points, normals, indices = sphere()
    turned = [indices[i + k] for i in range(0, len(indices), 3) for k in (0, 2, 1)]
    return points, [tuple(-c for c in n) for n in normals], turned


def ring(sides=96):
    """A band around the y axis: radius 1, y from 0 to 1, without thickness; faces outwards."""
    around = [(math.cos(2 * math.pi * s / sides), math.sin(2 * math.pi * s / sides)) for s in range(sides)]
    points = [(c, y, s) for y in (0, 1) for c, s in around]
    indices = []
    for s in range(sides):
        k = (s + 1) % sides
        indices += [s, sides + s, sides + k, s, sides + k, k]
    return points, [(c, 0, s) for _ in (0, 1) for c, s in around], indices


def png(rows):
    """8 bits; rows of (r, g, b) or (r, g, b, a) from the top. Stored, not compressed: compressors differ between machines."""
    width, height = len(rows[0]), len(rows)
    colors = sorted({c for row in rows for c in row})
    if len(colors) <= 256:
        index = {c: i for i, c in enumerate(colors)}
        kind, raw = 3, b"".join(b"\0" + bytes(index[c] for c in row) for row in rows)
    else:
        kind, raw = 2, b"".join(b"\0" + b"".join(bytes(c[:3]) for c in row) for row in rows)
    blocks = [raw[i:i + 65535] for i in range(0, len(raw), 65535)]
    stored = b"".join(struct.pack("<BHH", block is blocks[-1], len(block), 65535 - len(block)) + block for block in blocks)
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0))]
    if kind == 3:
        chunks.append((b"PLTE", b"".join(bytes(c[:3]) for c in colors)))
        if len(colors[0]) == 4:
            chunks.append((b"tRNS", bytes(c[3] for c in colors)))
    chunks += [(b"IDAT", b"\x78\x01" + stored + struct.pack(">I", zlib.adler32(raw))), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body)) for name, body in chunks)


def image(size, color_at):
    """Rows of color_at(u, v) at texel centres; v runs down."""
    return [[color_at((x + .5) / size, (y + .5) / size) for x in range(size)] for y in range(size)]
