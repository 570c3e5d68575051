# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Plots of the studies in data/studies, from their CSV files: error of B against passes, or against
seconds where engines are compared. SVG within the page, in the colors of its theme."""

from __future__ import annotations

import csv
import html
import math
from pathlib import Path

from .lessons import raw
from .markdown import Tree

WIDTH, HEIGHT = 620, 400
LEFT, RIGHT, TOP, BOTTOM = 62, 14, 12, 46
COLORS = ["#2f7ed8", "#e07b00", "#2a9d57", "#d1495b", "#8e63ce", "#8a6d3b", "#1aa3a3", "#c65bb5",
          "#7f8c8d", "#a8a100", "#5b6ee1", "#b04a00"]
DASHES = ["", "7 4", "2 3", "9 3 2 3", "1 5"]
MOST = 12  # series of one plot
KINDS = {
    "sphere-flake": "Figure 5 of the paper, extended",
    "samplings": "Sets of directions, two-way",
    "rotations": "Sets of directions, RMS of eight rotations",
    "schemes": "Schemes of the iteration",
    "normalizations": "Normalizations",
    "engines": "Engines: error against time",
}

Series = dict[str, list[tuple[float, float]]]


def write(tree: Tree) -> None:
    parts = ["# Plots of the studies", "",
             "Drawn from the files of [data/studies](README.md), which has the commands and the tables. "
             "RMS error of B over its RMS; both axes are logarithmic. Point at a mark for its values.", ""]
    files = sorted((tree.source / "data/studies").glob("*.csv"), key=lambda f: f.stem)
    for kind, title in KINDS.items():
        parts += [f"## {title}", ""]
        for file in files:
            if file.stem.startswith(kind):
                parts += section(file, kind)
    tree.write("data/studies/plots", "\n".join(parts))


def section(file: Path, kind: str) -> list[str]:
    scene = file.stem[len(kind):].strip("-") if kind != "sphere-flake" else file.stem
    against = "seconds" if kind == "engines" else "passes"
    parts = [f"### {scene.replace('-levels-', ':levels=')}" + (f", {kind}" if scene != file.stem else ""), ""]
    for title, series, bound in plots(file, against):
        parts += [f"**{title}**", ""] if title else []
        parts += [raw(plot(series, bound, against, f"{kind}, {scene} {title}")), ""]
    return parts


def notebook_plot(source: Path) -> str:
    """The notebook's plot, for the whole sphere-flake."""
    ((_, series, _),) = plots(source / "data/studies/sphere-flake.csv", "passes")
    shown = {name: series[f"{name}/two-way"] for name in ("random", "hammersley", "fibonacci")}
    return plot(shown, [], "passes", "Error of the whole sphere-flake")


def plots(file: Path, against: str) -> list[tuple[str, Series, list]]:
    """Each plot: its title, its series, and the bound of eq. 37."""
    series: Series = {}
    bound = {}
    with open(file, newline="") as rows:
        for row in csv.DictReader(rows):
            point = (float(row[against]), float(row["rms_error"]))
            series.setdefault(row["sampling"], []).append(point)
            if against == "passes":
                bound.setdefault(point[0], float(row["bound"]))
    limit = max(max(e for _, e in points) for points in series.values())
    bounds = sorted((m, b) for m, b in bound.items() if b <= 3 * limit)
    if len(series) <= MOST:
        return [("", series, bounds)]
    groups: dict[str, Series] = {}
    for name, points in series.items():
        first, _, rest = name.partition("/")
        groups.setdefault(first, {})[rest] = points
    return [(title, group, []) for title, group in groups.items()]


class Axis:
    """Logarithmic, from values to units of the picture."""

    def __init__(self, values, begin: float, end: float) -> None:
        self.low = math.log10(min(values)) - 0.05
        self.high = math.log10(max(values)) + 0.05
        self.begin, self.end = begin, end

    def place(self, value: float) -> float:
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.begin + share * (self.end - self.begin)

    def ticks(self) -> list[float]:
        decades = [10.0**k for k in range(math.ceil(self.low), math.floor(self.high) + 1)]
        if len(decades) > 2:
            return decades
        return [m * 10.0**k for k in range(math.floor(self.low), math.ceil(self.high) + 1)
                for m in (1, 2, 5) if self.low <= math.log10(m * 10.0**k) <= self.high]

    def powers_of_two(self) -> list[float]:
        all_of = range(math.ceil(self.low / math.log10(2)), math.floor(self.high / math.log10(2)) + 1)
        return [2.0**k for k in all_of if len(all_of) <= 8 or k % 2 == 0]


def plot(series: Series, bound: list, against: str, title: str) -> str:
    points = [p for all_of in series.values() for p in all_of if p[1] > 0] + bound
    x = Axis([p[0] for p in points], LEFT, WIDTH - RIGHT)
    y = Axis([p[1] for p in points], HEIGHT - BOTTOM, TOP)
    svg = [f'<div class="plot"><svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{html.escape(title)}">']
    for tick in x.powers_of_two() if against == "passes" else x.ticks():
        p = x.place(tick)
        svg.append(f'<path class="grid" d="M{p:.1f} {TOP}V{HEIGHT - BOTTOM}"/><text x="{p:.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{tick:g}</text>')
    for tick in y.ticks():
        p = y.place(tick)
        svg.append(f'<path class="grid" d="M{LEFT} {p:.1f}H{WIDTH - RIGHT}"/><text x="{LEFT - 8}" y="{p + 4:.1f}" text-anchor="end">{100 * tick:g} %</text>')
    svg.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 8}" text-anchor="middle">{"passes M" if against == "passes" else "seconds of processor time"}</text>')
    legend = []
    if bound:
        svg.append(f'<path class="bound" d="{path(bound, x, y)}"/>')
        legend.append(key("currentColor", "1 4", "bound (eq. 37)"))
    for name, (color, dash) in zip(series, looks(list(series))):
        line = [p for p in sorted(series[name]) if p[1] > 0]
        svg.append(f'<g stroke="{color}" fill="{color}"><path class="line" stroke-dasharray="{dash}" d="{path(line, x, y)}"/>')
        for p in line:
            value = f"{name}: {p[0]:g} {against}, {100 * p[1]:.3g} %"
            svg.append(f'<circle cx="{x.place(p[0]):.1f}" cy="{y.place(p[1]):.1f}" r="2.6"><title>{html.escape(value)}</title></circle>')
        svg.append("</g>")
        legend.append(key(color, dash, name.replace("/", ", ")))
    return "".join(svg) + f'</svg><div class="legend">{"".join(legend)}</div></div>'


def path(points: list, x: Axis, y: Axis) -> str:
    return "M" + "L".join(f"{x.place(a):.1f} {y.place(b):.1f}" for a, b in points)


def looks(names: list[str]) -> list[tuple[str, str]]:
    """A color for each first part of the names, a dash for each rest; where the first parts are all
    the same, a color for each rest."""
    firsts = list(dict.fromkeys(name.partition("/")[0] for name in names))
    if len(firsts) == 1:
        return [(COLORS[k % len(COLORS)], "") for k in range(len(names))]
    rests = list(dict.fromkeys(name.partition("/")[2] for name in names))
    return [(COLORS[firsts.index(name.partition("/")[0]) % len(COLORS)],
             DASHES[rests.index(name.partition("/")[2]) % len(DASHES)]) for name in names]


def key(color: str, dash: str, name: str) -> str:
    return (f'<span><svg viewBox="0 0 30 10" width="30" height="10" aria-hidden="true"><path d="M0 5H30" stroke="{color}" '
            f'stroke-width="2.4" stroke-dasharray="{dash}"/></svg>{html.escape(name)}</span>')
