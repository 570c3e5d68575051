#!/usr/bin/env python3
# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Error of B as a function against the number of patches: constant and linear functions, even
division and rounds of refinement.

    patches.py               draws patches-*.svg from patches.csv, both in this folder
    patches.py TRANSILLUM    measures patches.csv first, with that program

Errors are relative L2 norms on the faces that emit nothing, against linear functions on many
patches, with the same directions in both (`transillum compare --functions`).
"""

import csv
import html
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
COLUMNS = ["scene", "basis", "refine", "patches", "error"]

# A floor of 1 by 1 m and a lamp of 0.6 by 0.6 m, 0.8 m above it: no shadow edges.
SQUARE = """mtllib square.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0.2 0.2 0.8
v 0.2 0.8 0.8
v 0.8 0.8 0.8
v 0.8 0.2 0.8
usemtl floor
f 1 2 3 4
usemtl lamp
f 5 6 7 8
"""
MATERIALS = """newmtl floor
Kd 0.5 0.5 0.5
newmtl lamp
Kd 0 0 0
Ke 1 1 1
"""

# The room of the cornell-box with nothing in it: a box of 0.55 by 0.55 by 0.56 m, whose ceiling
# surrounds the lamp.
ROOM = """mtllib empty-box.mtl
v 0 0 0
v 0.55 0 0
v 0 0.55 0
v 0.55 0.55 0
v 0 0 0.56
v 0.55 0 0.56
v 0 0.55 0.56
v 0.55 0.55 0.56
v 0.213 0.55 0
v 0.343 0.55 0
v 0.213 0.55 0.56
v 0.343 0.55 0.56
v 0.213 0.55 0.227
v 0.343 0.55 0.227
v 0.213 0.55 0.332
v 0.343 0.55 0.332
usemtl white
f 1 5 6 2
f 5 7 8 6
f 3 9 11 7
f 10 4 8 12
f 9 10 14 13
f 15 16 12 11
usemtl green
f 1 3 7 5
usemtl red
f 2 6 8 4
usemtl black
f 1 2 4 3
usemtl light
f 13 14 16 15
"""
ROOM_MATERIALS = """newmtl white
Kd 0.725 0.71 0.68
newmtl green
Kd 0.14 0.45 0.091
newmtl red
Kd 0.63 0.065 0.05
newmtl black
Kd 0 0 0
newmtl light
Kd 0 0 0
Ke 17 12 4
"""


def solved(program, scene, options, out):
    subprocess.run([program, "solve", scene, "--quiet", "--out", out, *map(str, options)], check=True)


def compared(program, reference, result):
    """Patches of the result and its error."""
    text = subprocess.run([program, "compare", reference, result, "--functions"], check=True,
                          capture_output=True, text=True).stdout
    patches = re.search(r"^patches\s+\d+ and (\d+)", text, re.M)
    error = re.search(r"([-+.\de]+) without sources", text)
    return int(patches[1]), float(error[1])


def study(program, scene, name, passes, reference, runs, folder):
    """One row for each run: (refine, options). Both bases."""
    fine = folder / "reference.vtp"
    solved(program, scene, ["-m", passes, "--basis", "linear", *reference], fine)
    for basis in ("constant", "linear"):
        for refine, options in runs:
            out = folder / "run.vtp"
            solved(program, scene, ["-m", passes, "--basis", basis, *options], out)
            patches, error = compared(program, fine, out)
            print(name, basis, refine, patches, f"{error:.4g}", flush=True)
            yield [name, basis, refine, patches, f"{error:.5g}"]


def measure(program):
    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "square.obj").write_text(SQUARE)
        (folder / "square.mtl").write_text(MATERIALS)
        areas = [1, 0.25, 0.0625, 0.015625]
        rows += study(program, folder / "square.obj", "square", 32768, ["--max-patch-area", 0.004],
                      [("even", ["--max-patch-area", a]) for a in areas], folder)
        (folder / "empty-box.obj").write_text(ROOM)
        (folder / "empty-box.mtl").write_text(ROOM_MATERIALS)
        rows += study(program, folder / "empty-box.obj", "empty-box", 16384, ["--patches", 1600],
                      [("even", ["--patches", n]) for n in (25, 50, 100, 200, 400)], folder)
        counts = [50, 100, 200, 400, 800]
        for scene in ("cornell-box", "rooms:rooms=1,n=0"):
            runs = [("even", ["--patches", n]) for n in (*counts, 1600)]
            runs += [(by, ["--refine-by", by, "--patches", n]) for by in ("jump", "error") for n in counts]
            rows += study(program, scene, scene.partition(":")[0], 2048, ["--patches", 4000], runs, folder)
    with open(FOLDER / "patches.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows)


WIDTH, HEIGHT = 640, 440
LEFT, RIGHT, TOP, BOTTOM = 70, 18, 44, 104
COLORS = {"constant": "#d1495b", "linear": "#2f6fc4"}
EXPONENTS = {"constant": 1, "linear": 2}  # exponents of h where B is smooth
DASHES = {"even": "", "jump": "7 4", "error": "2 4"}
TITLES = {
    "square": "A square below a lamp, without shadow edges",
    "empty-box": "The room of the cornell-box, empty: without shadow edges",
    "cornell-box": "cornell-box",
    "rooms": "An empty room",
}


class Axis:
    """Logarithmic, from values to pixels."""

    def __init__(self, values, begin, end):
        self.low, self.high = math.log10(min(values)) - 0.08, math.log10(max(values)) + 0.08
        self.begin, self.end = begin, end

    def place(self, value):
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.begin + share * (self.end - self.begin)

    def ticks(self):
        powers = range(math.floor(self.low), math.ceil(self.high) + 1)
        return [m * 10.0**k for k in powers for m in (1, 2, 5)
                if self.low <= math.log10(m * 10.0**k) <= self.high]


def text(x, y, string, anchor="middle", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {more}>{html.escape(string)}</text>'


def line(points, color, dash, width=2):
    d = "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in points)
    return (f'<path d="{d}" fill="none" stroke="{color}" stroke-width="{width}" '
            f'stroke-dasharray="{dash}" stroke-linejoin="round"/>')


def slope_ends(points, exponent):
    (n0, e0), (n1, _) = points[1], points[3]
    return [(n, 0.72 * e0 * (n / n0)**(-exponent / 2)) for n in (n0, n1)]


def slope(points, exponent, x, y):
    """A line of error ~ h^exponent, drawn below `points`; h² is the area of a patch."""
    a, b = [(x.place(n), y.place(e)) for n, e in slope_ends(points, exponent)]
    label = "h" if exponent == 1 else "h²"
    return [line([a, b], "#777", "", 1.2),
            text((a[0] + b[0]) / 2, (a[1] + b[1]) / 2 + 17, label, "end", 'font-style="italic"')]


def drawn(scene, rows):
    series = {}
    for row in rows:
        series.setdefault((row["basis"], row["refine"]), []).append(
            (int(row["patches"]), float(row["error"])))
    points = [p for all_of in series.values() for p in all_of]
    for basis, exponent in EXPONENTS.items():
        points += slope_ends(series[basis, "even"], exponent)
    x = Axis([p[0] for p in points], LEFT, WIDTH - RIGHT)
    y = Axis([p[1] for p in points], HEIGHT - BOTTOM, TOP)
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" '
           f'height="{HEIGHT}" font-family="sans-serif" font-size="13" fill="#1a1a1f">',
           f"<title>{html.escape(TITLES[scene])}: error of B against patches</title>",
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
           text(WIDTH / 2, 26, TITLES[scene], more='font-size="16"')]
    for tick in x.ticks():
        p = x.place(tick)
        svg += [line([(p, TOP), (p, HEIGHT - BOTTOM)], "#dbdee3", "", 1),
                text(p, HEIGHT - BOTTOM + 18, f"{tick:,.0f}")]
    for tick in y.ticks():
        p = y.place(tick)
        svg += [line([(LEFT, p), (WIDTH - RIGHT, p)], "#dbdee3", "", 1),
                text(LEFT - 8, p + 4, f"{100 * tick:g} %", "end")]
    svg.append(text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - BOTTOM + 38, "patches"))
    middle = (TOP + HEIGHT - BOTTOM) / 2
    svg.append(text(18, middle, "L2 error of B", more=f'transform="rotate(-90 18 {middle})"'))
    for (basis, refine), points in series.items():
        if refine == "even":
            svg += slope(points, EXPONENTS[basis], x, y)
        places = [(x.place(a), y.place(b)) for a, b in points]
        svg.append(line(places, COLORS[basis], DASHES[refine]))
        for (n, e), (a, b) in zip(points, places):
            svg.append(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3.2" fill="{COLORS[basis]}"><title>'
                       f"{basis}, {refine}: {n} patches, {100 * e:.3g} %</title></circle>")
    return "\n".join(svg + legend(series) + ["</svg>", ""])


def legend(series):
    parts = []
    refinements = list(dict.fromkeys(refine for _, refine in series))
    for row, basis in enumerate(("constant", "linear")):
        top = HEIGHT - 40 + 22 * row
        parts.append(text(LEFT, top + 4, basis, "start"))
        for column, refine in enumerate(refinements):
            left = LEFT + 80 + 140 * column
            names = {"even": "even division", "jump": "by jump", "error": "by error"}
            parts += [line([(left, top), (left + 34, top)], COLORS[basis], DASHES[refine]),
                      text(left + 42, top + 4, names[refine], "start")]
    return parts


def main():
    if len(sys.argv) > 1:
        measure(sys.argv[1])
    with open(FOLDER / "patches.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for scene in dict.fromkeys(row["scene"] for row in rows):
        picture = drawn(scene, [row for row in rows if row["scene"] == scene])
        (FOLDER / f"patches-{scene}.svg").write_text(picture)


if __name__ == "__main__":
    main()
