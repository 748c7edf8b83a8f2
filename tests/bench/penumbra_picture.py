#!/usr/bin/python3
"""The picture and the table of penumbra.py: penumbra_picture.py OUT.png '[{"row": ..., "gather": ..., "file": ..., "mean": ...}, ...]'

Needs python3-numpy and python3-openimageio (the system's /usr/bin/python3).
"""
import json
import sys

import numpy as np
import OpenImageIO as oiio

GAP = 4  # pixels between pictures


def layers(name):
    """Channel name -> pixels."""
    file = oiio.ImageInput.open(name)
    spec = file.spec()
    pixels = np.asarray(file.read_image("float")).reshape(spec.height, spec.width, -1)
    channels = {channel: pixels[..., k] for k, channel in enumerate(spec.channelnames)}
    file.close()
    return channels


def luminance(image):
    return .2126 * image["R"] + .7152 * image["G"] + .0722 * image["B"]


def displayed(image):
    """sRGB, 90 % of the pixels below 0.7."""
    rgb = np.stack([image[c] for c in "RGB"], 2).astype(float)
    rgb = np.clip(.7 * rgb / np.percentile(luminance(image), 90), 0, 1)
    return np.where(rgb <= .0031308, 12.92 * rgb, 1.055 * rgb ** (1 / 2.4) - .055)


def samples(image):
    """Visibility samples a pixel; None where the image has no such layer."""
    return next((pixels for name, pixels in image.items() if name.startswith("samples.visibility")), None)


def penumbra(image, bare):
    """Pixels of the floor that have neither all of the light that they have without blockers nor what is left in the shadow's core."""
    ratio = luminance(image) / np.maximum(luminance(bare), 1e-9)
    is_floor = np.abs(image["depth.Z"] / bare["depth.Z"] - 1) < .01
    core = np.percentile(ratio[is_floor], .2)
    return is_floor & (ratio > core + .2 * (1 - core)) & (ratio < core + .8 * (1 - core))


def strip(images, white):
    """The images of a row side by side, and their samples where they are known."""
    parts = []
    for image in images:
        parts.append(displayed(image))
        if samples(image) is not None:
            parts.append(np.repeat(np.clip(samples(image) / white, 0, 1)[..., None], 3, 2))
    gap = np.ones((parts[0].shape[0], GAP, 3))
    return np.concatenate([p for part in parts for p in (part, gap)][:-1], 1)


def write_png(name, rgb):
    spec = oiio.ImageSpec(rgb.shape[1], rgb.shape[0], 3, "uint8")
    spec.attribute("png:compressionLevel", 9)
    file = oiio.ImageOutput.create(name)
    file.open(name, spec)
    file.write_image(np.ascontiguousarray((255 * rgb + .5).astype(np.uint8)))
    file.close()


def print_table(files, images):
    print("| view | gather | visibility samples a pixel | in the penumbra | of its pixels 5 % to 95 % |\n|---|---|---|---|---|")
    bare = {file["row"]: image for file, image in zip(files, images) if file["gather"] == "bare"}
    for file, image in zip(files, images):
        if file["gather"] == "bare":
            continue
        inside = None if samples(image) is None else samples(image)[penumbra(image, bare[file["row"]])]
        known = "- | -" if inside is None else "{:.0f} | {:.0f}..{:.0f}".format(inside.mean(), *np.percentile(inside, (5, 95)))
        print(f"| {file['row']} | {file['gather']} | {file['mean']:.1f} | {known} |")


def main(out, files):
    images = [layers(file["file"]) for file in files]
    white = max(np.percentile(samples(image), 99) for image in images if samples(image) is not None)
    rows = list(dict.fromkeys(file["row"] for file in files))
    strips = [strip([image for file, image in zip(files, images) if file["row"] == row and file["gather"] != "bare"], white) for row in rows]
    gap = np.ones((GAP, strips[0].shape[1], 3))
    write_png(out, np.concatenate([s for one in strips for s in (one, gap)][:-1], 0))
    print_table(files, images)


if __name__ == "__main__":
    main(sys.argv[1], json.loads(sys.argv[2]))
