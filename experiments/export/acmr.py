"""How well the order of triangles suits a graphics card: `python3 experiments/export/acmr.py FILE.glb ...`.

Prints corners fetched per triangle for each material, with a first-in-first-out cache of 16 corners
(Hoppe 1999): 3 is the worst, 0.5 the limit for large grids, and corners per triangle the least that
any order can reach.
"""

import json
import struct
import sys
from array import array
from collections import deque

CACHE = 16


def fetched(indices):
    cache, misses = deque(maxlen=CACHE), 0
    for index in indices:
        if index not in cache:
            misses += 1
            cache.append(index)
    return misses


for path in sys.argv[1:]:
    with open(path, "rb") as file:
        content = file.read()
    (length,) = struct.unpack_from("<I", content, 12)
    scene = json.loads(content[20:20 + length])
    for primitive in scene["meshes"][0]["primitives"]:
        accessor = scene["accessors"][primitive["indices"]]
        start = 28 + length + scene["bufferViews"][accessor["bufferView"]]["byteOffset"]
        indices = array("I", content[start:start + 4 * accessor["count"]])
        triangles = len(indices) // 3
        least = scene["accessors"][primitive["attributes"]["POSITION"]]["count"] / triangles
        name = scene["materials"][primitive["material"]]["name"]
        print(f"{path}: {name}: {fetched(indices) / triangles:.3f} fetched a triangle, at least {least:.3f}")
