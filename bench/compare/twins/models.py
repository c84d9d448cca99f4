"""Compares pictures of model files with those of Cycles, Blender's renderer: a row of a table each.

Each program reads the file by itself, so that what the format means is compared: materials,
textures and their coordinates, normals, nodes. An even white sky, a pinhole, the camera that
clshear chooses. Lights of the file are left out in Blender, but kept by clshear. Blender reads
OBJ, glTF, Collada, FBX, PLY and STL. Its surfaces are not those of glTF and MTL, so that means
differ by some per cent; *look* marks those that differ by more than --within. Objects without a
material have clshear's plain one in both.
scripts/agreement --models runs it.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import mitsuba as mi

mi.set_variant("scalar_rgb")

import numpy as np

from agree import ROOT
from renderers import planes_of

BLOCKS = 8  # along each side of the picture


def colours_of(bitmap):
    planes = planes_of(bitmap)
    return np.stack([planes[colour] for colour in "RGB"], axis=-1)


def of_clshear(options, model, picture):
    """The picture, and the camera that was chosen."""
    subprocess.run([options.program, model, "--environment", "1,1,1", "--lens-radius", "0",
                    "--width", str(options.size), "--height", str(options.size), "--spp",
                    str(options.spp), "--quiet", "--out", picture], check=True)
    bitmap = mi.Bitmap(str(picture))
    metadata = bitmap.metadata()
    camera = {name: [float(number) for number in str(metadata[f"clshear.{name}"]).split(",")]
              for name in ("eye", "target", "up")}
    return colours_of(bitmap), dict(camera, fov=float(metadata["clshear.fov"]))


def of_cycles(options, model, camera, picture):
    given = {"model": str(model.resolve()), "camera": camera, "size": options.size,
             "spp": options.spp, "picture": str(picture)}
    words = picture.with_suffix(".json")
    words.write_text(json.dumps(given))
    script = pathlib.Path(__file__).with_name("models_cycles.py")
    subprocess.run([options.blender, "-b", "--factory-startup", "--python-exit-code", "1",
                    "--python", script, "--", words], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return colours_of(mi.Bitmap(str(picture)))


def blocks(image):
    """Means over square parts of the picture."""
    side = len(image) // BLOCKS
    return image.reshape(BLOCKS, side, BLOCKS, side, 3).mean(axis=(1, 3))


def row(options, model, ours, theirs):
    """Prints a row of the table; whether the means are near each other."""
    apart = abs(blocks(ours) - blocks(theirs)).max()
    ratio = ours.mean() / theirs.mean()
    is_near = bool(abs(ratio - 1) <= options.within)
    print(f"| {model.name} | {ours.mean():.4f} | {theirs.mean():.4f} | {ratio:.3f} | "
          f"{apart:.2f} | {'' if is_near else 'look'} |", flush=True)
    return is_near


def keep(folder, model, ours, theirs):
    """Both pictures beside each other."""
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    both = np.concatenate([ours, theirs], axis=1).astype(np.float32)
    mi.Bitmap(both).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, True).write(
        str(pathlib.Path(folder) / f"{model.name}.png"))


def main():
    """Exits with 1 if a program cannot read a file, or means differ by more than was asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+", type=pathlib.Path, metavar="FILE")
    parser.add_argument("--size", type=int, default=128, help=f"of a side, N times {BLOCKS}")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--within", type=float, default=0.05, help="difference of means, relative")
    parser.add_argument("--keep", help="folder for pictures of both, side by side")
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--program", default=str(ROOT / "build" / "clshear"))
    options = parser.parse_args()
    if options.size < BLOCKS or options.size % BLOCKS:
        parser.error(f"--size has to be a multiple of {BLOCKS}")
    if shutil.which(options.blender) is None:
        parser.error(f"there is no program {options.blender}; install it, or name it by --blender")
    apart = 0
    print("| model | mean of clshear | of Cycles | ratio | largest difference of a block | |")
    print("|---|---|---|---|---|---|", flush=True)
    for model in options.models:
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            try:
                ours, camera = of_clshear(options, model, folder / "ours.exr")
                theirs = of_cycles(options, model, camera, folder / "theirs.exr")
            except subprocess.CalledProcessError as error:
                print(f"| {model.name} | {pathlib.Path(error.cmd[0]).name} failed | | | | |",
                      flush=True)
                apart += 1
                continue
        apart += not row(options, model, ours, theirs)
        if options.keep:
            keep(options.keep, model, ours, theirs)
    return 1 if apart else 0


if __name__ == "__main__":
    sys.exit(main())
