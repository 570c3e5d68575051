#!/usr/bin/env python3
# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""The cornell-box with constant functions on patches (above) and with linear ones (below): whole
faces, an even division, and patches that are divided in rounds by jumps.

    functions.py TRANSILLUM    writes functions.png in this folder
"""

import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

DIVISIONS = [[], ["--max-patch-area", "0.01"], ["--refine-by", "jump", "--patches", "600"]]
CAMERA = ["--eye", "0.278,0.273,-0.8", "--target", "0.278,0.273,0.28", "--exposure", "0.9"]
SHRINK = 3  # pixels of a picture per pixel of the table, in both directions
GAP = 6


def chunks(data):
    place = 8
    while place < len(data):
        length, kind = struct.unpack(">I4s", data[place:place + 8])
        yield kind, data[place + 8:place + 8 + length]
        place += 12 + length


def unfiltered(raw, width, height):
    """Rows of a PNG of 8 bits per channel, RGB."""
    rows, before, size = [], bytes(3 * width), 3 * width
    for y in range(height):
        kind, line = raw[y * (size + 1)], bytearray(raw[y * (size + 1) + 1:(y + 1) * (size + 1)])
        for x in range(size):
            left = line[x - 3] if x >= 3 else 0
            above, corner = before[x], before[x - 3] if x >= 3 else 0
            if kind == 1:
                guess = left
            elif kind == 2:
                guess = above
            elif kind == 3:
                guess = (left + above) // 2
            elif kind == 4:
                near = left + above - corner
                guess = min((left, above, corner), key=lambda value: abs(near - value))
            else:
                break
            line[x] = (line[x] + guess) & 255
        rows.append(line)
        before = line
    return rows


def read(path):
    parts = list(chunks(path.read_bytes()))
    width, height, depth, color = struct.unpack(">IIBB", dict(parts)[b"IHDR"][:10])
    assert (depth, color) == (8, 2)
    raw = zlib.decompress(b"".join(data for kind, data in parts if kind == b"IDAT"))
    return unfiltered(raw, width, height)


def shrunk(rows):
    """Each pixel is the mean of SHRINK times SHRINK; the dark left and right are cut off."""
    height, width = len(rows) // SHRINK, len(rows[0]) // 3 // SHRINK
    side = max(0, (width - height) // 2)
    small = []
    for y in range(height):
        block = rows[SHRINK * y:SHRINK * (y + 1)]
        line = bytearray()
        for x in range(side, width - side):
            for channel in range(3):
                total = sum(row[3 * (SHRINK * x + k) + channel] for row in block for k in range(SHRINK))
                line.append(round(total / SHRINK**2))
        small.append(line)
    return small


def write(path, rows):
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    # Each row as differences from the one above, which compresses best here.
    raw, before = bytearray(), bytes(len(rows[0]))
    for line in rows:
        raw += bytes([2]) + bytes((value - above) & 255 for value, above in zip(line, before))
        before = line
    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(bytes(raw), 9)) + chunk(b"IEND", b""))


def main():
    program = sys.argv[1]
    table = []
    with tempfile.TemporaryDirectory() as temporary:
        for basis in ("constant", "linear"):
            row = None
            for division in DIVISIONS:
                picture = Path(temporary) / "picture.png"
                subprocess.run([program, "solve", "cornell-box", "--quiet", "-m", "4096", "--basis", basis,
                                *division, *CAMERA, "--out", picture], check=True)
                small = shrunk(read(picture))
                gap = bytes([255] * (3 * GAP))
                row = small if row is None else [a + gap + b for a, b in zip(row, small)]
            table += row if not table else [bytearray([255] * len(row[0]))] * GAP + row
    write(Path(__file__).resolve().parent / "functions.png", table)


if __name__ == "__main__":
    main()
