#!/usr/bin/python3
"""The peers' ruler as JSON: reflected_error.py PEERS-FOLDER IMAGE.exr REFERENCE-A.exr REFERENCE-B.exr [EMITTER]

With EMITTER as error.py has it: pixels that see an emitter are left out. Without, the images and the references are ours, and their layer
`emission` is taken off: what is compared is reflected light, as in the audit. Needs python3-numpy and python3-openimageio (the system's /usr/bin/python3).
"""
import json
import sys

import numpy as np
import OpenImageIO as oiio

NO_MASK = 1e30


def reflected(name):
    """RGB without emission that is seen directly."""
    file = oiio.ImageInput.open(name)
    spec = file.spec()
    pixels = np.asarray(file.read_image("float")).reshape(spec.height, spec.width, -1).astype(float)
    channels = list(spec.channelnames)
    file.close()
    rgb, emission = (pixels[..., [channels.index(prefix + c) for c in "RGB"]] for prefix in ("", "emission."))
    return rgb - emission


def main(peers, names, emitter):
    sys.dont_write_bytecode = True
    sys.path.insert(0, peers)
    import error as ruler
    load = ruler.load if emitter else reflected
    error, interval, ratio = ruler.error(*map(load, names), float(emitter[0]) if emitter else NO_MASK)
    print(json.dumps({"error": error, "ci95": interval, "ratio": ratio}))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:5], sys.argv[5:6])
