"""Compares pictures of what moves with those of Cycles, Blender's renderer: a table as agree.py's.

Lambert's surfaces and one point light, no bounces, a round lens. The camera moves, or a ball (as a
node) and a card (as a shape), or all; clshear gets the closed shutter's scene by --to and
--camera-to. scripts/agreement --motion runs it.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import mitsuba as mi

mi.set_variant("scalar_rgb")

import numpy as np

from agree import HEAD, REPLICATES, ROOT, row
from gltf import write_gltf
from renderers import EYE, FOCUS, FOV, LENS, TARGET, run_clshear
from shapes import ball, card, ground
from surfaces import diffuse

# Cycles looks times up in a table of 256 entries, the inverse of a distribution function that has
# 255 steps: of a box it is u (255 / 256)^2. So its shutter closes that early, and so does ours.
CLOSES = (255 / 256) ** 2
LIGHT = ([2.0, 4.0, 1.0], [30.0, 25.0, 20.0])
CAMERA_MOVE, BALL_MOVE = [0.5, -0.3, 0.2], [0.6, 0.5, -0.4]
COLOURS = [(0.5, 0.4, 0.3), (0.8, 0.2, 0.4), (0.2, 0.5, 0.8)]
SCENES = {"moving camera": (True, False), "moving objects": (False, True),
          "both": (True, True)}


def parts_of(objects_move):
    """Geometries where the shutter opens and where it closes. The card tilts and grows."""
    still = [ground(), ball(0.7, (0.5, 1.0, 0.0)), card(0.9, 0.5)]
    for positions, *_ in still[2:]:
        positions[:, 0] -= 1.2
    closed = [(positions.copy(), *rest) for positions, *rest in still]
    if objects_move:
        closed[1][0][:] += np.float32(BALL_MOVE)
        closed[2][0][:] = closed[2][0] * np.float32([1.4, 1, 1.2]) + np.float32([0.7, 0.3, 0.2])
        closed[2][0][:2, 1] += 0.5
    return still, closed


def of_clshear(options, folder, name, moves):
    still, closed = parts_of(moves[1])
    surfaces = [diffuse(*colour) for colour in COLOURS]
    numbers = ",".join(map(str, [*LIGHT[0], *LIGHT[1]]))
    flags = ["--spp", options.spp, "--replicates", REPLICATES, "--seed", 11]
    if moves[0]:
        step = CLOSES * np.array(CAMERA_MOVE)
        flags += ["--camera-to", ",".join(map(str, [*(step + EYE), *(step + TARGET)]))]
    if moves[1]:
        flags += ["--to", folder / "closed.gltf"]
        early = [(opened[0] + np.float32(CLOSES) * (place - opened[0]), *rest)
                 for opened, (place, *rest) in zip(still, closed)]
        write_gltf(folder / "closed.gltf", list(zip(early, surfaces)), [])
    scene = (list(zip(still, surfaces)), [(["--light", numbers], None)], 0)
    planes, _ = run_clshear(options, folder, "open", scene, flags, {})
    return (np.stack([planes[c] for c in "RGB"], axis=-1),
            np.stack([planes["Variance." + c] for c in "RGB"], axis=-1))


def of_cycles(options, folder, name, moves):
    still, closed = parts_of(moves[1])
    parts = [{"positions": positions.tolist(), "triangles": triangles.tolist(), "colour": colour}
             for (positions, triangles, _), colour in zip(still, COLOURS)]
    if moves[1]:
        parts[1]["move"] = BALL_MOVE
        parts[2]["positions_to"] = closed[2][0].tolist()
    camera = {"eye": EYE, "target": TARGET, "move": CAMERA_MOVE if moves[0] else [0, 0, 0],
              "fov": FOV, "lens": LENS, "focus": FOCUS}
    picture = str(folder / "cycles")
    given = {"parts": parts, "light": {"position": LIGHT[0], "intensity": LIGHT[1]},
             "camera": camera, "size": options.size, "spp": options.spp // REPLICATES,
             "seeds": REPLICATES, "picture": picture}
    (folder / "scene.json").write_text(json.dumps(given))
    script = pathlib.Path(__file__).with_name("cycles.py")
    subprocess.run([options.blender, "-b", "--factory-startup", "--python-exit-code", "1",
                    "--python", script, "--", folder / "scene.json"], check=True,
                   stdout=subprocess.DEVNULL)
    stack = np.stack([np.array(mi.Bitmap(f"{picture}-{seed}.exr"), dtype=np.float64)[:, :, :3]
                      for seed in range(REPLICATES)])
    return stack.mean(axis=0), stack.var(axis=0, ddof=1) / REPLICATES


def main():
    """Exits with 1 if a scene differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=48, help="pixels along a side")
    parser.add_argument("--spp", type=int, default=1024, help="of both, in 16 renders")
    parser.add_argument("--keep", help="folder for pictures of both")
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--program", default=str(ROOT / "build" / "clshear"))
    options = parser.parse_args()
    print(HEAD.replace("Mitsuba", "Cycles"), flush=True)
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for name, moves in SCENES.items():
            ours = of_clshear(options, pathlib.Path(folder), name, moves)
            theirs = of_cycles(options, pathlib.Path(folder), name, moves)
            results.append(row(options, name, ours, theirs))
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
