#!/usr/bin/env python3
"""Writes tests/scenes/effects/*.gltf, one scene for each effect: python3 tests/scenes/make_effect_scenes.py

The table of scenes is effects/README.md. Metres, Y up, exactly Lambertian but for what a scene is about. Standard library
only; the same bytes on every machine.
"""
from effect_parts import (BLACK, BLUE, GLASS, GREEN, GREY, RED, WHITE, add_leaves, ceiling_square, leaf,
                          screen, square, stage, studs, three_boxes, tiles, upright)
from effect_room import all_effects
from effect_scene import DOWN, EffectScene, image
from make_scenes import FOLDER, cornell
from specular_scenes import caustic, glass_sphere, globe, glowing_box, mirror, mirror_faces_wall


def none():
    scene = EffectScene("none", (0, 2.3, 2.9), (0, 0, .15), .7)
    scene.material("floor", GREY)
    square(scene, "floor", -2, 2, -2, 2, 0)
    scene.material("panel", BLACK, (20, 20, 20))
    ceiling_square(scene, "panel", -.5, .5, -.5, .5, 2.6)
    return scene


def cornell_of(name, red, green, light):
    source = cornell()
    scene = EffectScene(name, *source.camera)
    for material, rho, emission in (("white", (.73, .73, .73), None), ("red", red, None), ("green", green, None),
                                    ("light", BLACK, light)):
        scene.material(material, rho, emission)
        for corners in source.faces[material]:
            scene.polygon(material, *corners)
    return scene


def grey_cornell():
    return cornell_of("grey_cornell", (.25, .25, .25), (.35, .35, .35), (17, 12, 4))


def colour_cornell():
    return cornell_of("colour_cornell", (.63, .065, .05), (.14, .45, .091), (17, 12, 4))


def one_channel():
    return cornell_of("one_channel", (.63, .065, .05), (.14, .45, .091), (17, 0, 0))


def interreflection():
    """A closed white room whose only lamp shines at the ceiling."""
    scene = EffectScene("interreflection", (.3, 1.4, 4.7), (2.4, 1.0, 0), 1.0)
    scene.material("white", (.8, .8, .8))
    scene.material("lamp", BLACK, (20, 20, 20))
    scene.inward_box(["white"] * 6, (0, 0, 0), (4, 2.6, 5))
    scene.box("white", (.8, 0, .8), (1.6, 1.3, 1.6), 25)
    scene.box("white", (2.6, 0, 1.5), (3.2, .6, 2.1), -10)
    scene.box("white", (2.9, 0, .2), (3.7, 1.48, .8))
    square(scene, "lamp", 2.95, 3.65, .25, .75, 1.485)
    return scene


def low_interreflection():
    scene = EffectScene("low_interreflection")
    scene.material("soot", (.01, .01, .01))
    stage(scene, "soot", "soot", 1000)
    three_boxes(scene, "soot")
    return scene


def convex_object():
    scene = EffectScene("convex_object", (1.6, 1.5, 2.6), (0, .4, 0), .6)
    scene.material("block", WHITE)
    scene.material("lamp", BLACK, (30, 30, 30))
    scene.box("block", (-.5, 0, -.4), (.5, .9, .4), 20)
    scene.lamp("lamp", (2.2, 2.4, .8), (0, .4, 0), 1)
    return scene


def point_light():
    scene = EffectScene("point_light")
    stage(scene, panel=0)
    scene.material("box", WHITE)
    three_boxes(scene, "box")
    scene.punctual("point", (.3, 2, 1.2), 15)
    return scene


def spot_light():
    scene = EffectScene("spot_light")
    stage(scene, panel=0)
    scene.material("box", WHITE)
    scene.box("box", (-.25, 0, -.25), (.25, .5, .25), 30)
    for i, (x, cone) in enumerate(((-1.2, (.05, .35)), (0, (.3, .32)), (1.2, (0, .5)))):
        color = [(1, .7, .5), (1, 1, 1), (.5, .7, 1)][i]
        scene.punctual("spot", (x, 2.4, 1), 25, color, target=(x * .9, .1, -.4), name=f"spot {i}", cone=cone)
    return scene


def directional_light():
    scene = EffectScene("directional_light")
    stage(scene, panel=0)
    scene.material("box", WHITE)
    three_boxes(scene, "box")
    scene.punctual("directional", (0, 0, 0), 4, target=(-.7, -1, -.55), name="sun")
    return scene


def lamp_over_boxes(name, at, size, radiance):
    scene = EffectScene(name)
    stage(scene, panel=0)
    scene.material("box", WHITE)
    three_boxes(scene, "box")
    scene.material("lamp", BLACK, (radiance,) * 3)
    scene.lamp("lamp", at, (0, .3, 0), size)
    return scene


def small_distant_light():
    return lamp_over_boxes("small_distant_light", (14, 20, 12), .03, 3e6)


def large_near_light():
    return lamp_over_boxes("large_near_light", (1.4, 2.0, 1.2), .9, 20)


def textured_room(name, texture):
    """Closed, low and wide: its ceiling takes the colour of the floor under it. The lamps are above the camera."""
    scene = EffectScene(name, (0, 1.0, 1.5), (0, .72, -.5), 1.25)
    scene.textures["tiles"] = texture
    scene.material("floor", (.9, .9, .9), texture="tiles", uv=lambda p: (p[0] / 3 + .5, p[2] / 3 + .5))
    scene.material("white", WHITE)
    scene.material("lamp", BLACK, (9, 9, 9))
    scene.inward_box(["floor", None, "white", "white", "white", "white"], (-1.5, 0, -1.5), (1.5, 1.5, 1.6))
    scene.plane_with_holes("white", lambda x, z: (x, 1.5, z), [-1.5, 1.5], [-1.5, 1.6],
                           [(a, a + .8, .6, 1.4, "lamp") for a in (-1.2, .4)])
    scene.box("white", (-.2, .0, -.9), (.2, .7, -.5), 30)
    return scene


def textured_reflectance():
    return textured_room("textured_reflectance", image(64, tiles))


def textured_reflectance_constant():
    return textured_room("textured_reflectance_constant", image(64, lambda u, v: (170, 150, 140)))


def screen_scene(name, texture):
    scene = EffectScene(name, (.9, 1.3, 3.8), (-.2, .6, -.3), .7)
    scene.textures["screen"] = texture
    stage(scene, panel=0)
    scene.material("screen", BLACK, (30, 30, 30), emission_texture="screen")
    # Close above the floor and tilted, so that the panes print their colours on it.
    scene.polygon("screen", (-1.2, .08, -.9), (1.2, .08, -.9), (1.2, 1.5, -1.5), (-1.2, 1.5, -1.5),
                  uv=[(0, 1), (1, 1), (1, 0), (0, 0)])
    scene.material("box", WHITE)
    scene.box("box", (.6, 0, .1), (1.0, .4, .5), 30)
    return scene


def textured_emission():
    return screen_scene("textured_emission", image(48, screen))


def textured_emission_constant():
    return screen_scene("textured_emission_constant", image(48, lambda u, v: (90, 60, 80)))


def foliage(name, texture):
    scene = EffectScene(name, (0, 1.4, 4.6), (0, .85, 0), .66)
    stage(scene, panel=0)
    scene.textures["leaf"] = texture
    scene.material("leaf", (1, 1, 1), texture="leaf", mask=True)
    scene.material("trunk", (.30, .20, .12))
    scene.cylinder("trunk", (0, 0, 0), .06, .03, 1.2, 8)
    add_leaves(scene, (0, 1.3, 0), .6, 110, 5, .36)
    scene.material("lamp", BLACK, (400, 390, 360))
    scene.lamp("lamp", (2.2, 3.6, 2.2), (0, .5, 0), .3)
    return scene


def alpha_mask():
    return foliage("alpha_mask", image(32, leaf))


def alpha_mask_opaque():
    return foliage("alpha_mask_opaque", image(32, lambda u, v: (*leaf(u, v)[:3], 255)))


def studded(name, texture):
    scene = EffectScene(name)
    scene.textures["studs"] = texture
    scene.material("wall", WHITE, normal_texture="studs", uv=lambda p: (p[0], -p[1]), tangent=(1, 0, 0, 1))
    scene.material("floor", GREY)
    stage(scene, panel=0)
    scene.material("lamp", BLACK, (60, 60, 60))
    scene.lamp("lamp", (-2.2, 3.2, -1.2), (0, 1, -2), .5)
    return scene


def normal_map():
    return studded("normal_map", image(48, studs))


def normal_map_flat():
    return studded("normal_map_flat", image(48, lambda u, v: (128, 128, 255)))


def glossy_floor():
    """Left rough metal, right lacquer; a bright wall with coloured columns that both show again."""
    scene = EffectScene("glossy_floor", (0, .8, 4.6), (0, .55, 0), .62)
    scene.material("metal", (.85, .80, .72), metallic=1, roughness=.25, specular=1)
    scene.material("lacquer", (.03, .03, .04), roughness=.2, specular=1)
    scene.material("wall", WHITE)
    square(scene, "metal", -2, 0, -2, 2, 0)
    square(scene, "lacquer", 0, 2, -2, 2, 0)
    upright(scene, "wall", -2, 2, 0, 2.5, -2)
    for i, (name, rho) in enumerate((("red", RED), ("green", GREEN), ("blue", BLUE), ("yellow", (.7, .55, .06)))):
        scene.material(name, rho)
        x = -1.35 + .9 * i
        scene.cylinder(name, (x, 0, -1.1), .16, .16, 1.1, 16)
    scene.material("lamp", BLACK, (25, 24, 21))
    for x in (-.9, .9):
        scene.polygon("lamp", (x - .1, 1.35, -1.9), (x + .1, 1.35, -1.9), (x + .1, 2.3, -1.9), (x - .1, 2.3, -1.9))
    scene.material("panel", BLACK, (14, 14, 14))
    ceiling_square(scene, "panel", -1, 1, .4, 1.4, 2.8)
    return scene


def window():
    """No lamp inside: what enters is the sky."""
    scene = EffectScene("window", (3.6, 1.5, 4.7), (.9, 1.05, .9), .95)
    for name, rho in (("wall", (.7, .7, .68)), ("floor", (.35, .28, .2)), ("box", WHITE)):
        scene.material(name, rho)
    scene.material("glazing", (1, 1, 1), **GLASS, extensions={"transmission": {"transmissionFactor": 1}})
    scene.inward_box(["floor", "wall", None, "wall", "wall", "wall"], (0, 0, 0), (4, 2.6, 5))
    scene.plane_with_holes("wall", lambda u, v: (0, v, -u), [-5, 0], [0, 2.6], [(-3.4, -1.2, .8, 2.2, "glazing")])
    scene.box("box", (1.3, 0, 1.6), (2.1, .7, 2.4), 20)
    return scene


def open_plane_sky():
    scene = EffectScene("open_plane_sky", (0, 1.5, 5.2), (0, .8, 0), .66)
    for name, rho in (("ground", GREY), ("box", WHITE)):
        scene.material(name, rho)
    square(scene, "ground", -10, 10, -10, 10, 0)
    three_boxes(scene, "box")
    scene.smooth("sphere", "box", (-.3, .3, 1.5), .3)
    return scene


def closed_box_env():
    scene = EffectScene("closed_box_env", (.4, 1.4, 2.6), (-.3, .8, -1), .9)
    for name, rho in (("white", WHITE), ("red", RED), ("lamp", BLACK)):
        scene.material(name, rho, (15, 15, 15) if name == "lamp" else None)
    scene.inward_box(["white", None, "red", "white", "white", "white"], (-1.5, 0, -1.5), (1.5, 2.2, 2.8))
    scene.plane_with_holes("white", lambda x, z: (x, 2.2, z), [-1.5, 1.5], [-1.5, 2.8], [(-.4, .4, -.4, .4, "lamp")])
    scene.box("white", (-.8, 0, -.8), (-.1, .9, -.1), 30)
    return scene


def depth_of_field():
    scene = EffectScene("depth_of_field", (0, .7, 3.0), (0, .5, 0), .62)
    stage(scene)
    names = [("red", RED), ("gold", (.7, .5, .1)), ("green", GREEN), ("blue", BLUE), ("white", WHITE)]
    for i, (name, rho) in enumerate(names):
        scene.material(name, rho)
        for k in range(5):  # columns of thin stripes from 1.3 to 4.7 m before the lens
            x, z = (.15 * i - .3) * (1.3 + .85 * i), 1.7 - .85 * i
            scene.box(name if k % 2 == 0 else "wall", (x - .09, .16 * k, z - .09), (x + .09, .16 * (k + 1), z + .09), 25)
    scene.material("lamp", BLACK, (25, 25, 25))
    scene.lamp("lamp", (.8, 2.2, 3.6), (0, .4, 0), .7)
    for i in range(8):
        upright(scene, "blue", -1.9 + .5 * i, -1.75 + .5 * i, .1, 2.4, -1.99)
    return scene


def vertex_colours():
    scene = EffectScene("vertex_colours")
    scene.material("floor", (1, 1, 1), has_colors=True)
    scene.material("wall", WHITE)
    scene.polygon("floor", (-2, 0, -2), (-2, 0, 2), (2, 0, 2), (2, 0, -2),
                  colors=[(.8, .05, .05), (.05, .7, .1), (.05, .1, .8), (.8, .7, .1)])
    upright(scene, "wall", -2, 2, 0, 2.5, -2)
    scene.box("wall", (-.4, 0, -.4), (.4, .8, .4), 30)
    scene.material("panel", BLACK, (20, 20, 20))
    ceiling_square(scene, "panel", -.5, .5, -.3, .7, 2.6)
    return scene


def pair_of_spheres(name, plain, layered):
    """The same base without and with a layer."""
    scene = EffectScene(name, (0, 1.1, 3.6), (0, .55, 0), .5)
    stage(scene)
    scene.material("plain", **plain)
    scene.material("layered", **layered)
    for x, material in ((-.65, "plain"), (.65, "layered")):
        scene.smooth("sphere", material, (x, .5, 0), .5)
    scene.material("lamp", BLACK, (30, 28, 24))
    scene.lamp("lamp", (-1.5, 1.9, 2.0), (0, .5, 0), .5)
    return scene


def clearcoat():
    base = {"rho": (.55, .04, .05)}
    return pair_of_spheres("clearcoat", base, base | {
        "extensions": {"clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0}}})


def sheen():
    base = {"rho": (.05, .07, .18)}
    return pair_of_spheres("sheen", base, base | {
        "extensions": {"sheen": {"sheenColorFactor": [.9, .8, .7], "sheenRoughnessFactor": .35}}})


def ies_lamp():
    scene = EffectScene("ies_lamp")
    stage(scene, panel=0)
    scene.material("box", WHITE)
    scene.box("box", (-.9, 0, -.6), (-.4, .6, -.1), 25)
    scene.punctual("point", (.3, 2.1, -.9), 12, (1, .95, .85), rotation=DOWN, name="downlight")
    return scene


def write_ies():
    """A narrow beam with a ring around it: candela by the angle from straight down, the same all around."""
    angles = list(range(0, 95, 5)) + [180]
    table = [60, 58, 50, 38, 24, 12, 5, 3, 3, 12, 16, 12, 4, 2, 1, 1, .5, 0, 0, 0]
    lines = ["IESNA:LM-63-2002", "[TEST] radfarm tests/scenes/make_effect_scenes.py", "[MANUFAC] none", "[LUMCAT] downlight",
             "[LUMINAIRE] synthetic downlight, beam and ring", "TILT=NONE",
             f"1 -1 1 {len(angles)} 1 1 2 0 0 0", "1 1 10",
             " ".join(map(str, angles)), "0", " ".join(map(str, table))]
    assert len(angles) == len(table)
    (FOLDER / "effects" / "downlight.ies").write_bytes(("\r\n".join(lines) + "\r\n").encode())


SCENES = (none, grey_cornell, colour_cornell, one_channel, interreflection, low_interreflection, convex_object, point_light,
          spot_light, directional_light, small_distant_light, large_near_light, textured_reflectance,
          textured_reflectance_constant, textured_emission, textured_emission_constant, alpha_mask, alpha_mask_opaque,
          normal_map, normal_map_flat, glossy_floor, mirror, caustic, glass_sphere, globe, mirror_faces_wall, glowing_box, window, open_plane_sky, closed_box_env,
          depth_of_field, vertex_colours, clearcoat, sheen, ies_lamp, all_effects)

if __name__ == "__main__":
    (FOLDER / "effects").mkdir(exist_ok=True)
    write_ies()
    for make in SCENES:
        make().write()
