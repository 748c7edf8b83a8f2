"""The scene that calls for every effect, for make_effect_scenes.py."""
from effect_parts import BLACK, GLASS, GOLD, RED, WHITE, add_leaves, glass, leaf, screen, studs, tiles
from effect_scene import DOWN, EffectScene, image, ring


def all_effects():
    """A living room of 6 x 2.8 x 5 m."""
    scene = EffectScene("all", (5.3, 1.6, 4.6), (2.2, .85, .9), .95)
    scene.shapes["ring"] = ring
    scene.textures |= {"tiles": image(32, tiles), "screen": image(32, screen), "leaf": image(32, leaf),
                       "studs": image(24, lambda u, v: studs(u / 3, v / 3))}
    for name, rho in (("wall", WHITE), ("red wall", RED), ("wood", (.42, .27, .15)), ("trunk", (.30, .20, .12))):
        scene.material(name, rho)
    scene.material("floor", (.8, .8, .8), texture="tiles", uv=lambda p: (p[0] / 4, p[2] / 4))
    scene.material("studded wall", WHITE, normal_texture="studs", uv=lambda p: (3 * p[0], -3 * p[1]), tangent=(1, 0, 0, 1))
    scene.material("panel", BLACK, (9, 8.5, 7))
    scene.material("screen", BLACK, (6, 6, 6), emission_texture="screen")
    scene.material("leaf", (1, 1, 1), texture="leaf", mask=True)
    scene.material("mirror", (.95, .95, .95), metallic=1, roughness=0, specular=1)
    scene.material("gold", GOLD, metallic=1, roughness=0, specular=1)
    scene.material("rough metal", (.85, .80, .72), metallic=1, roughness=.3, specular=1)
    scene.material("lacquer", (.05, .05, .06), roughness=.15, specular=1)
    scene.material("glass", (1, 1, 1), **glass((.35, .85, .70), .4))
    scene.material("glazing", (1, 1, 1), **GLASS, extensions={"transmission": {"transmissionFactor": 1}})
    scene.material("car paint", (.55, .04, .05),
                   extensions={"clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0}})
    scene.material("velvet", (.05, .07, .18),
                   extensions={"sheen": {"sheenColorFactor": [.9, .8, .7], "sheenRoughnessFactor": .35}})
    scene.material("painted", (1, 1, 1), has_colors=True)
    add_room(scene)
    add_furniture(scene)
    scene.punctual("point", (1.5, 2.3, .7), 6, (1, .95, .85), rotation=DOWN, name="downlight")
    scene.punctual("spot", (4.4, 2.7, .5), 25, (1, .9, .8), target=(4.4, 0, 1.2), name="spot", cone=(.15, .35))
    scene.punctual("directional", (0, 0, 0), 6, (1, .9, .75), target=(1, -.75, -.35), name="sun")
    return scene


def add_room(scene):
    width, height, depth = 6, 2.8, 5
    scene.inward_box(["floor", None, None, "red wall", None, "wall"], (0, 0, 0), (width, height, depth))
    scene.plane_with_holes("wall", lambda x, z: (x, height, z), [0, width], [0, depth], [(2.4, 3.6, 2.2, 2.8, "panel")])
    scene.plane_with_holes("wall", lambda u, v: (0, v, -u), [-depth, 0], [0, height], [(-3.6, -1.6, .9, 2.2, "glazing")])
    scene.plane_with_holes("wall", lambda x, y: (x, y, 0), [0, width], [0, height],
                           [(.5, 1.7, .6, 2.3, "studded wall"), (2.2, 3.4, .9, 2.1, "mirror")])
    scene.polygon("screen", (3.8, 1.2, .02), (4.9, 1.2, .02), (4.9, 1.9, .02), (3.8, 1.9, .02),
                  uv=[(0, 1), (1, 1), (1, 0), (0, 0)])


def add_furniture(scene):
    scene.box("wood", (1.8, .55, 1.5), (3.6, .6, 2.4))
    for x in (1.85, 3.47):
        for z in (1.55, 2.27):
            scene.box("rough metal", (x, 0, z), (x + .08, .55, z + .08))
    scene.smooth("sphere", "glass", (2.15, .8, 2.05), .2)
    scene.smooth("ring", "gold", (2.75, .601, 1.95), (.2, .1, .2))
    scene.smooth("sphere", "car paint", (3.3, .75, 1.95), .15)
    scene.smooth("sphere", "velvet", (1.4, .3, 3.1), .3)
    scene.box("rough metal", (3.8, 0, .3), (4.9, .6, .9))
    scene.box("lacquer", (4.4, 0, 1.6), (5.0, .45, 2.2), 20)
    scene.polygon("painted", (2.0, .61, 2.18), (2.0, .61, 2.37), (3.4, .61, 2.37), (3.4, .61, 2.18),
                  colors=[(.8, .05, .05), (.05, .7, .1), (.05, .1, .8), (.8, .7, .1)])
    scene.cylinder("trunk", (.8, 0, 1.2), .05, .03, .9, 6)
    add_leaves(scene, (.8, 1.1, 1.2), .42, 70, 11, .26)
