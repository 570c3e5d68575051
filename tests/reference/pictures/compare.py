#!/usr/bin/env python3
"""Compares a picture with the reference of make_references.py.

  compare.py FILE.pfm NAME [--difference FILE.png] [--program transillum OPTIONS…]

NAME is a key of cameras.json. With --program, FILE.pfm is first made by `transillum picture` with
the camera of NAME and the other options. Direct light alone is what surfaces with a millionth of
their reflectance show, times `scale`.

Pixels that meet lamps, back sides, or no light are omitted, and those below the fraction `darkest`
of the brightest, where cameras.json has it. Errors are relative, by pixel: lengths of vectors of
the three channels. They are printed net of the noise of the reference: the squares are subtracted,
or, of the largest errors, four standard errors.
"""

import argparse
import json
import pathlib
import struct
import subprocess
import sys
import zlib

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent


def read_pfm(path):
    """Rows from the upper one."""
    with open(path, "rb") as file:
        kind, size, scale = (file.readline().split() for _ in range(3))
        width, height = int(size[0]), int(size[1])
        channels = {b"PF": 3, b"Pf": 1}[kind[0]]
        values = np.frombuffer(file.read(), dtype="<f4" if float(scale[0]) < 0 else ">f4")
    return values.reshape(height, width, channels)[::-1].astype(float)


def read_camera(name):
    return json.loads((FOLDER / "cameras.json").read_text())[name]


def read_reference(name):
    """Radiance, noise relative to it, mask: the arrays of make_references.py."""
    name = read_camera(name).get("reference", name)
    with np.load(FOLDER / f"{name}.npz") as file:

        def values(code, least, steps):
            return np.where(code > 0, least * 2 ** ((code - 1) / steps), 0)

        code = file["radiance"].cumsum(axis=1, dtype=np.uint16).astype(float)
        radiance = values(code, file["least"], file["steps"])
        return radiance, values(file["noise"].astype(float), 1e-6, 6), file["mask"]


def make_picture(program, path, name, options):
    camera = read_camera(name)
    numbers = {key: ",".join(map(str, camera[key])) for key in ("eye", "target", "up")}
    width, height = camera.get("size", [256, 256])
    scene = str(FOLDER / camera["scene"]) if "." in camera["scene"] else camera["scene"]
    command = [program, "picture", scene, "--eye", numbers["eye"]]
    command += ["--target", numbers["target"], "--camera-up", numbers["up"]]
    command += ["--fov", str(camera["fov"]), "--size", f"{width}x{height}"]
    command += ["--sky", str(camera["sky"])] if "sky" in camera else []
    command += camera.get("options", []) + options + ["--out", path]
    print(*command)
    subprocess.run(command, check=True)


def blocks(values, side=8):
    """All squares of `side` pixels; the last two axes are those of a square."""
    return np.lib.stride_tricks.sliding_window_view(values, (side, side), axis=(0, 1))


def write_png(path, pixels):
    def chunk(kind, data):
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels.astype(np.uint8))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + data)


def difference_picture(picture, reference, omitted, white=0.05):
    """Red: brighter than the reference, by at least `white` at full red; blue: darker."""
    length = np.maximum(reference.sum(axis=-1), 1e-30)
    share = np.clip((picture.sum(axis=-1) - reference.sum(axis=-1)) / length / white, -1, 1)
    colors = 255 * (1 - np.stack([np.maximum(-share, 0), np.abs(share), np.maximum(share, 0)], -1))
    colors[omitted] = 128
    return colors


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file")
    parser.add_argument("name")
    parser.add_argument("--difference", metavar="FILE.png", help="red: brighter, blue: darker")
    parser.add_argument("--program", help="makes FILE first, with the options that follow")
    arguments, options = parser.parse_known_args()
    if arguments.program:
        make_picture(arguments.program, arguments.file, arguments.name, options)
    elif options:
        parser.error(f"unknown: {' '.join(options)}")
    reference, noise, mask = read_reference(arguments.name)
    picture = read_pfm(arguments.file)
    if picture.shape != reference.shape or not np.isfinite(picture).all():
        sys.exit(f"{arguments.file}: not {reference.shape} finite numbers, but {picture.shape}")
    camera = read_camera(arguments.name)
    picture *= camera.get("scale", 1)
    report(picture, reference, noise, mask, camera.get("darkest", 0))
    if arguments.difference:
        omitted = (mask & 5) != 0
        write_png(arguments.difference, difference_picture(picture, reference, omitted))


def report(picture, reference, noise, mask, darkest):
    length = np.linalg.norm(reference, axis=-1)
    counted = (mask & 5) == 0
    seen = counted & (length > darkest * length[counted].max())
    black = counted & (length == 0)
    error = np.zeros_like(length)
    error[seen] = np.linalg.norm(picture - reference, axis=-1)[seen] / length[seen]

    def percent(value):
        return f"{100 * value:.3f} %"

    def net(error, noise):
        square = np.mean(error**2) - np.mean(noise**2)
        return percent(np.sign(square) * np.sqrt(abs(square)))

    weight = length[seen]
    print("RMS of error / radiance   ", net(error[seen], noise[seen]), "net of noise",
          percent(np.sqrt(np.mean(noise[seen] ** 2))))  # fmt: skip
    print("RMS of error / RMS of all ",
          net(error[seen] * weight / np.sqrt(np.mean(weight**2)),
              noise[seen] * weight / np.sqrt(np.mean(weight**2))))  # fmt: skip
    print("mean radiance             ", percent(picture[seen].sum() / reference[seen].sum() - 1))
    far = seen & ((mask & 2) != 0)
    print("RMS, farther than 2 pixels from edges", net(error[far], noise[far]), "net of noise",
          percent(np.sqrt(np.mean(noise[far] ** 2))))  # fmt: skip
    sure = np.where(far, error - 4 * noise, 0)
    row, column = np.unravel_index(sure.argmax(), sure.shape)
    print(f"largest there, net of 4 noise: {percent(sure.max())} at "
          f"row {row}, column {column}; {(sure > 0.05).sum()} of {far.sum()} pixels above 5 %")
    inner = blocks(far).all(axis=(-2, -1))
    if inner.any():
        # The noise of a mean is an eighth: pixels are independent.
        middle = np.linalg.norm(blocks(reference).mean(axis=(-2, -1)), axis=-1)[inner]
        means = np.linalg.norm(blocks(picture - reference).mean(axis=(-2, -1)), axis=-1)[inner]
        square = blocks((noise * length) ** 2).mean(axis=(-2, -1))[inner] / 64
        means, noises = means / middle, np.sqrt(square) / middle
        print("RMS of the means of 8 by 8 such pixels", net(means, noises), "net of noise",
              percent(np.sqrt(np.mean(noises**2))),
              f"largest, net of 4 noise: {percent((means - 4 * noises).max())}")  # fmt: skip
    if black.any():
        print(f"without light in the reference: {black.sum()} pixels, "
              f"radiance at most {np.linalg.norm(picture[black], axis=-1).max():.3g}")  # fmt: skip


if __name__ == "__main__":
    main()
