"""Scenes whose diffuse surfaces have light from mirrors and glass."""
from effect_parts import BLACK, BLUE, GOLD, GREEN, GREY, RED, WHITE, ceiling_square, glass, square, stage, three_boxes, upright
from effect_scene import EffectScene, hollow, ring


def mirror():
    scene = EffectScene("mirror", (-1.1, 1.4, 4.2), (.5, .8, -.8), .7)
    scene.material("wall", GREY)
    scene.inward_box(["wall"] * 6, (-2, 0, -2), (2, 2.6, 4.6))
    scene.material("panel", BLACK, (20, 20, 20))
    for z in (-.5, 2.5):
        ceiling_square(scene, "panel", -.5, .5, z, z + 1, 2.59)
    scene.material("mirror", (.95, .95, .95), metallic=1, roughness=0, specular=1)
    upright(scene, "mirror", -1.5, 1.5, .3, 2.1, -1.99)
    for name, rho in (("red", RED), ("green", GREEN), ("blue", BLUE)):
        scene.material(name, rho)
    three_boxes(scene, "red", "green", "blue")
    return scene


def caustic():
    """A mirror ring on the floor and a small lamp beside it: two bright arcs that meet in a cusp."""
    scene = EffectScene("caustic", (0, 2.2, 2.6), (0, 0, .05), .55)
    scene.shapes["ring"] = ring
    scene.material("floor", GREY)
    square(scene, "floor", -2, 2, -2, 2, 0)
    scene.material("gold", GOLD, metallic=1, roughness=0, specular=1)
    scene.smooth("ring", "gold", (0, 0, 0), (.6, .28, .6))
    scene.material("lamp", BLACK, (60, 60, 60))
    scene.lamp("lamp", (-2.4, 1.5, .5), (0, .1, 0), .35)
    return scene


def glass_sphere():
    scene = EffectScene("glass_sphere", (0, 1.0, 3.6), (0, .55, 0), .55)
    scene.material("glass", (1, 1, 1), **glass((.35, .85, .70), .6))
    scene.smooth("sphere", "glass", (0, .55, 0), .55)
    stage(scene)
    for name, rho in (("red", RED), ("blue", BLUE)):
        scene.material(name, rho)
    for i in range(20):
        upright(scene, ("red", "wall", "blue", "wall")[i % 4], -2 + .2 * i, -1.8 + .2 * i, 0, 2.5, -1.5)
    return scene


def globe():
    """All light passes a glass globe around its lamp."""
    scene = EffectScene("globe", (-1.1, 1.2, 3.4), (.1, .8, -.4), .8)
    for name, rho in (("wall", GREY), ("red", RED), ("green", GREEN)):
        scene.material(name, rho)
    scene.inward_box(["wall", "wall", "red", "wall", "wall", "wall"], (-1.8, 0, -1.8), (1.8, 2.4, 3.6))
    scene.material("lamp", BLACK, (40, 38, 34))
    scene.box("lamp", (-.18, 1.22, -.18), (.18, 1.58, .18), 0)
    scene.material("glass", (1, 1, 1), **glass((.9, .8, .6), 1))
    scene.shapes["hollow"] = hollow
    scene.smooth("sphere", "glass", (0, 1.4, 0), .45)
    scene.smooth("hollow", "glass", (0, 1.4, 0), .4)
    three_boxes(scene, "green")
    return scene


def mirror_faces_wall():
    """The block hides the lamp from the floor behind it: a mirror that faces the lit wall lights it."""
    scene = EffectScene("mirror_faces_wall", (-1.3, 1.3, 2.6), (.5, .3, -.4), .8)
    for name, rho in (("floor", GREY), ("wall", WHITE), ("screen", (.08, .08, .08))):
        scene.material(name, rho)
    square(scene, "floor", -2, 2, -2, 2, 0)
    upright(scene, "wall", -2, 0, 0, 2, -2)
    scene.material("mirror", (.95, .93, .88), metallic=1, roughness=0, specular=1)
    scene.polygon("mirror", (1.6, 0, .4), (1.6, 0, -1.8), (1.6, 1.6, -1.8), (1.6, 1.6, .4))
    scene.box("screen", (-.3, 0, -1.2), (0, 1.5, .2), 0)
    scene.material("lamp", BLACK, (60, 60, 60))
    scene.lamp("lamp", (-1.6, 1.6, 0), (-1, .6, -1.6), .5)
    return scene


def glowing_box():
    """Closed: five walls glow and reflect half, the sixth is a perfect mirror. Radiance is L / (1 - rho) everywhere."""
    scene = EffectScene("glowing_box", (-.6, .2, .7), (.4, -.1, -1), 1)
    scene.material("glow", (.5, .5, .5), (1, 1, 1))
    scene.material("mirror", (1, 1, 1), metallic=1, roughness=0, specular=1)
    scene.inward_box(["glow", "glow", "glow", "mirror", "glow", "glow"], (-1, -1, -1), (1, 1, 1))
    return scene
