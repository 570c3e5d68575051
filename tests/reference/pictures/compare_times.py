#!/usr/bin/env python3
"""Compares the time of a picture with the one that a path tracer needs for the same error.

  compare_times.py --program build/release/bin/transillum [--name cornell-box] [OPTIONS …]

In one run: `transillum picture OPTIONS` with its solve, its error against the reference (RMS by
pixel, relative, net of noise), and batches of Mitsuba, whose variance falls with the number of
samples. Times are processor seconds, so that other work on the machine changes little.
"""

import argparse
import os
import pathlib
import resource
import tempfile
import time

import compare
import make_references
import numpy as np


def children_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default="transillum")
    parser.add_argument("--name", default="cornell-box")
    parser.add_argument("--batches", type=int, default=4)
    parser.add_argument("--batch-samples", type=int, default=64, help="samples a pixel of a batch")
    arguments, options = parser.parse_known_args()
    reference, noise, mask = compare.read_reference(arguments.name)
    length = np.linalg.norm(reference, axis=-1)
    seen = ((mask & 5) == 0) & (length > 0)
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        path = str(work / "picture.pfm")
        start = children_seconds()
        compare.make_picture(arguments.program, path, arguments.name, ["-q", *options])
        ours = children_seconds() - start
        error = np.linalg.norm(compare.read_pfm(path) - reference, axis=-1)[seen] / length[seen]
        square = np.mean(error**2) - np.mean(noise[seen] ** 2)
        print(f"transillum: {ours:.2f} s, error {100 * np.sqrt(max(square, 0)):.3f} %")
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", "/usr/lib/x86_64-linux-gnu/libLLVM-14.so.1")
        import mitsuba as mi

        mi.set_variant("llvm_ad_rgb" if "llvm_ad_rgb" in mi.variants() else "scalar_rgb")
        camera = compare.read_camera(arguments.name)
        faces = make_references.read_faces(
            arguments.program, make_references.scene_name(camera), work, camera.get("sky", 0)
        )
        scene, _ = make_references.make_scene(
            mi, faces, camera, camera.get("depth", -1), arguments.batch_samples, "multijitter", work
        )
        np.array(mi.render(scene, spp=arguments.batch_samples, seed=1))  # compiles
        start = time.process_time()
        images = [
            np.array(mi.render(scene, spp=arguments.batch_samples, seed=2 + k), dtype=float)
            for k in range(arguments.batches)
        ]
        seconds = (time.process_time() - start) / arguments.batches
    variance = np.var(images, axis=0, ddof=1).sum(axis=-1)[seen] / length[seen] ** 2
    needed = seconds * variance.mean() / square
    print(f"Mitsuba: {seconds:.2f} s for {arguments.batch_samples} samples a pixel, error "
          f"{100 * np.sqrt(variance.mean()):.2f} %; {needed:.0f} s for the same error, "
          f"{needed / ours:.0f} times as long")  # fmt: skip


if __name__ == "__main__":
    main()
