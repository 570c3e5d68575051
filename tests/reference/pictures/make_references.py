#!/usr/bin/env python3
"""Writes references for pictures: radiance by the path tracer Mitsuba 3, in SCENE.npz.

  make_references.py NAME --program build/release/bin/transillum [--minutes 10] [--work FOLDER]

NAME is a key of cameras.json. Needs `pip install mitsuba numpy`, and LLVM (DRJIT_LIBLLVM_PATH names
its library); the variant is llvm_ad_rgb, else scalar_rgb. The faces come from the program: a result
of the scene has their corners, E and rho, and is made with one pass. Lobes do not reflect. Batches
of samples, each with a seed of its own, collect in FOLDER, so a second call adds to them.

NAME.npz has arrays of one row per line of pixels, the upper first:
  radiance  per channel c = 1 + steps log2(radiance / least), rounded, W/(m2 sr); c = 0: none.
            Differences of c from pixel to pixel of a row, modulo 2^16
  least, steps
  noise     1 + 6 log2(noise / 1e-6), rounded, of a pixel's standard error relative to its radiance,
            both as lengths of vectors of the three channels; 0: below 1e-6
  mask      1: meets a lamp; 2: this pixel and all within 2 pixels of it show one face; 4: meets a
            back side or no face
  samples   of a pixel, in all batches
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile
import time

import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent
FINE = 8  # samples along a side of a pixel that tell which faces it shows


def scene_name(camera):
    """A built-in scene, or the path of a file in this folder."""
    return str(FOLDER / camera["scene"]) if "." in camera["scene"] else camera["scene"]


def read_faces(program, scene, work, sky=0):
    """Triangles of a scene: corners (n,3,3), E and rho (n,3), number of the face (n)."""
    path = work / "faces.ply"
    command = [program, "solve", scene, "-m", "1", "--iterations", "1", "--out", path]
    command += ["--sky", str(sky)] if sky else []
    subprocess.run(command, check=True, capture_output=True)
    lines = iter(path.read_text().splitlines())
    counts, columns = {}, {"vertex": [], "face": []}
    for line in lines:
        word = line.split()
        if word[0] == "element":
            counts[word[1]] = int(word[2])
            element = word[1]
        elif word[0] == "property":
            columns[element].append(word[-1])
        elif word[0] == "end_header":
            break
    points = np.array([next(lines).split()[:3] for _ in range(counts["vertex"])], dtype=float)
    corners, exitance, reflectance, numbers = [], [], [], []
    for _ in range(counts["face"]):
        word = next(lines).split()
        size = int(word[0])
        value = dict(zip(columns["face"][1:], word[size + 1 :]))
        for triangle in triangles(points[[int(i) for i in word[1 : size + 1]]]):
            corners.append(triangle)
            exitance.append([float(value["E_" + c]) for c in "rgb"])
            reflectance.append([float(value["rho_" + c]) for c in "rgb"])
            numbers.append(int(value["face"]))
    return np.array(corners), np.array(exitance), np.array(reflectance), np.array(numbers)


def triangles(outline):
    """The triangles of a simple polygon, by cutting ears."""
    normal = sum(np.cross(a, b) for a, b in zip(outline, np.roll(outline, -1, axis=0)))

    def area(a, b, c):
        return np.dot(np.cross(b - a, c - a), normal)

    found, rest = [], list(outline)
    size = np.dot(normal, normal)
    while len(rest) > 3:
        for i in range(len(rest)):
            a, b, c = rest[i - 1], rest[i], rest[(i + 1) % len(rest)]
            others = [p for p in rest if not any(p is q for q in (a, b, c))]
            empty = not any(
                min(area(a, b, p), area(b, c, p), area(c, a, p)) > -1e-12 * size for p in others
            )
            if area(a, b, c) > 1e-12 * size and empty:
                found.append([a, b, c])
                del rest[i]
                break
        else:
            raise ValueError("no ear: the outline is not simple, or corners lie on a line")
    return found + [rest]


def write_ply(path, corners):
    with open(path, "wb") as file:
        file.write(
            b"ply\nformat binary_little_endian 1.0\nelement vertex %d\n"
            b"property float x\nproperty float y\nproperty float z\nelement face %d\n"
            b"property list uchar int vertex_indices\nend_header\n"
            % (3 * len(corners), len(corners))
        )
        file.write(corners.astype("<f4").tobytes())
        faces = np.empty(len(corners), dtype=[("size", "u1"), ("corner", "<i4", 3)])
        faces["size"], faces["corner"] = 3, np.arange(3 * len(corners)).reshape(-1, 3)
        file.write(faces.tobytes())


def make_scene(mi, faces, camera, depth, samples, sampler, work):
    """Mitsuba's scene and, by the id of a shape, the face's number of each of its triangles."""
    corners, exitance, reflectance, numbers = faces
    # Mitsuba's rays start 9e-5 (1 + largest coordinate) off a surface, which darkens penumbras by
    # up to 2 % in a room of 0.5 m; in millimeters about the middle it is a fifth of that.
    middle = (corners.min(axis=(0, 1)) + corners.max(axis=(0, 1))) / 2

    def scaled(point):
        return 1000 * (np.asarray(point) - middle)

    corners = scaled(corners)
    size = camera.get("size", [256, 256])
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": depth},
        "sensor": {
            "type": "perspective",
            "fov_axis": "y",
            "fov": camera["fov"],
            "near_clip": 0.1,
            "far_clip": 1e7,
            "to_world": mi.ScalarTransform4f.look_at(
                origin=list(scaled(camera["eye"])),
                target=list(scaled(camera["target"])),
                up=camera["up"],
            ),
            "film": {
                "type": "hdrfilm",
                "width": size[0],
                "height": size[1],
                "pixel_format": "rgb",
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
            "sampler": {"type": sampler, "sample_count": samples},
        },
    }
    if "sky" in camera:
        scene["sky"] = {
            "type": "constant",
            "radiance": {"type": "rgb", "value": [camera["sky"] / np.pi] * 3},
        }
    materials, of = np.unique(np.hstack([exitance, reflectance]), axis=0, return_inverse=True)
    shown = {}
    for index, material in enumerate(materials):
        path = work / f"material{index}.ply"
        mine = of.ravel() == index
        write_ply(path, corners[mine])
        name = f"shape{index}"
        shown[name] = numbers[mine], material[:3].max() > 0
        shape = {
            "type": "ply",
            "id": name,
            "filename": str(path),
            "face_normals": True,
            "bsdf": {
                "type": "diffuse",
                "reflectance": {"type": "rgb", "value": list(material[3:])},
            },
        }
        if material[:3].max() > 0:
            shape["emitter"] = {
                "type": "area",
                "radiance": {"type": "rgb", "value": list(material[:3] / np.pi)},
            }
        scene[name] = shape
    return mi.load_dict(scene), shown


def make_mask(mi, scene, shown, width, height):
    """Which pixels show lamps, one face with all around them, back sides: see the file's text."""
    x, y = (((np.arange(n * FINE) + 0.5) / (n * FINE)).astype(np.float32) for n in (width, height))
    x, y = np.meshgrid(x, y)
    position = mi.Point2f(mi.Float(x.ravel()), mi.Float(y.ravel()))
    ray, _ = scene.sensors()[0].sample_ray(0, 0.5, position, mi.Point2f(0.5, 0.5))
    hit = scene.ray_intersect(ray)
    valid, triangle = np.array(hit.is_valid()), np.array(hit.prim_index)
    front = np.array(mi.Frame3f.cos_theta(hit.wi)) > 0
    shapes = shape_ids(mi, hit.shape)
    face, lamp = np.full(x.size, -1), np.zeros(x.size, dtype=bool)
    for shape in scene.shapes():
        numbers, emits = shown[shape.id()]
        here = valid & (shapes == shape_ids(mi, mi.ShapePtr(shape)))
        face[here] = numbers[triangle[here]]
        lamp |= here & emits
    fine = (height * FINE, width * FINE)
    tiles = (height, FINE, width, FINE)
    face = face.reshape(fine)
    low = face.reshape(tiles).min(axis=(1, 3))
    high = face.reshape(tiles).max(axis=(1, 3))
    for axis in (0, 1):
        low, high = over_neighbors(low, np.min, axis), over_neighbors(high, np.max, axis)
    lit = over_margin(lamp.reshape(fine)).reshape(tiles).any(axis=(1, 3))
    other = (~(valid & front)).reshape(tiles).any(axis=(1, 3))
    return (lit + 2 * ((low == high) & (low >= 0)) + 4 * other).astype(np.uint8)


def shape_ids(mi, shapes):
    import drjit

    return np.array(drjit.reinterpret_array_v(mi.UInt32, shapes))


def over_neighbors(values, reduce, axis, reach=2):
    pad = [(reach, reach) if a == axis else (0, 0) for a in (0, 1)]
    wide = np.pad(values, pad, "edge")
    return reduce(np.lib.stride_tricks.sliding_window_view(wide, 2 * reach + 1, axis), axis=-1)


def over_margin(flags):
    """A sample more on each side: a lamp's corner may lie between the samples."""
    for axis in (0, 1):
        flags = over_neighbors(flags, np.max, axis, 1)
    return flags


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("name")
    parser.add_argument("--program", default="transillum")
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--samples", type=int, default=256, help="samples a pixel of a batch")
    parser.add_argument("--sampler", default="multijitter")
    parser.add_argument("--work", type=pathlib.Path, help="folder of the batches")
    arguments = parser.parse_args()
    os.environ.setdefault("DRJIT_LIBLLVM_PATH", "/usr/lib/x86_64-linux-gnu/libLLVM-14.so.1")
    import mitsuba as mi

    mi.set_variant("llvm_ad_rgb" if "llvm_ad_rgb" in mi.variants() else "scalar_rgb")
    camera = json.loads((FOLDER / "cameras.json").read_text())[arguments.name]
    with tempfile.TemporaryDirectory() as folder:
        work = arguments.work or pathlib.Path(folder)
        work.mkdir(parents=True, exist_ok=True)
        faces = read_faces(arguments.program, scene_name(camera), pathlib.Path(folder),
                           camera.get("sky", 0))  # fmt: skip
        scene, shown = make_scene(
            mi, faces, camera, camera.get("depth", -1), arguments.samples, arguments.sampler,
            pathlib.Path(folder),
        )  # fmt: skip
        width, height = camera.get("size", [256, 256])
        mask = make_mask(mi, scene, shown, width, height)
        end = time.time() + 60 * arguments.minutes
        pattern = f"{arguments.name}-{arguments.samples}-*.npy"
        seed = len(list(work.glob(pattern)))
        while time.time() < end or seed < 8:
            image = np.array(mi.render(scene, spp=arguments.samples, seed=1000 + seed))
            np.save(work / pattern.replace("*", f"{seed:05d}"), image)
            seed += 1
        batches = np.array([np.load(path) for path in sorted(work.glob(pattern))], dtype=float)
    write(arguments.name, batches, arguments.samples, mask)


def logarithmic(values, least, steps):
    return np.round(1 + steps * np.log2(np.maximum(values, least / 2) / least)).clip(0)


def write(name, batches, samples, mask):
    mean = batches.mean(axis=0)
    error = np.sqrt(batches.var(axis=0, ddof=1).sum(axis=-1) / len(batches))
    length = np.linalg.norm(mean, axis=-1)
    noise = np.divide(error, length, out=np.zeros_like(error), where=length > 0)
    seen = ((mask & 5) == 0) & (length > 0)
    # Rounding is an eighth of the noise, or less.
    steps = 2.0 ** np.ceil(np.log2(1.6 / np.median(noise[seen]))).clip(0, 11)
    least = max(mean[mean > 0].min(), mean.max() * 2 ** (-65000 / steps))
    np.savez_compressed(
        FOLDER / f"{name}.npz",
        radiance=np.diff(
            logarithmic(mean, least, steps).astype(np.uint16), axis=1, prepend=np.uint16(0)
        ),
        least=least,
        steps=steps,
        noise=logarithmic(noise, 1e-6, 6).astype(np.uint8),
        mask=mask,
        samples=len(batches) * samples,
    )
    print(f"{name}: {len(batches)} batches of {samples} samples, noise "
          f"{100 * np.sqrt(np.mean(noise[seen] ** 2)):.3f} % RMS")  # fmt: skip


if __name__ == "__main__":
    main()
