# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Manual pages as pages, by mandoc."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

from .lessons import raw
from .markdown import Tree

SECTION = re.compile(r'<section class="Sh">\s*<h1[^>]*>(?:<a[^>]*>)?(.*?)(?:</a>)?</h1>(.*?)</section>',
                     re.DOTALL)


def write(tree: Tree, folder: Path, mandoc: str) -> list[str]:
    """@returns the pages, first the pages of programs"""
    names = sorted((file.stem for file in folder.glob("*.1")), key=order)
    for name in names:
        text = subprocess.run([mandoc, "-T", "html", "-O", "fragment", folder / f"{name}.1"],
                              check=True, capture_output=True, text=True).stdout
        tree.write(f"manual/{name}", page_of(name, text, names))
    return [f"manual/{name}" for name in names]


def order(name: str):
    programs = ["transillum", "transillum-viewer", "transillum-mpi"]
    return (programs.index(name), "") if name in programs else (len(programs), name)


def page_of(name: str, text: str, names: list[str]) -> str:
    parts = [f"# {name}", ""]
    for title, body in SECTION.findall(text):
        body = re.sub(r"<b>([a-z-]+)</b>\((\d)\)",
                      lambda m: f'<a href="{m[1]}.html">{m[1]}</a>' if m[1] in names else m[0], body)
        if title == "NAME":
            words = re.sub(r"<[^>]*>", "", body).strip()
            parts += [re.sub(r"^\S+ - ", "", " ".join(words.split())).capitalize() + ".", ""]
        else:
            parts += [f"## {title.capitalize()}", "", raw(f'<div class="man">{body}</div>'), ""]
    return "\n".join(parts)
