# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Lessons as pages: what transillum-viewer --export-lesson has written, with its pictures as files
and its maps to step through."""

from __future__ import annotations

import base64
import html
import json
import re
from pathlib import Path

from .markdown import Tree, write_changed

SECTION = re.compile(r"<section><h2>(.*?)</h2>\n(.*?)</section>", re.DOTALL)
PICTURE = re.compile(r'<img alt="[^"]*" src="data:image/png;base64,([^"]*)">')
RULES = ("svg.map", ".steps", ".question")


def write(tree: Tree, exported: Path) -> list[str]:
    """@returns the pages"""
    pages, cards = [], []
    for file in sorted((tree.source / "data/lessons").glob("*.json"),
                       key=lambda file: int(file.stem.split("-")[0])):
        lesson = json.loads(file.read_text())
        page = f"lessons/{file.stem}"
        text = (exported / f"{file.stem}.html").read_text()
        tree.write(page, page_of(tree, page, lesson, text, file))
        pages.append(page)
        number, _, title = lesson["title"].partition(" · ")
        cards.append(card(file.stem, number, title, lesson))
    tree.write("lessons/index", index(pages, cards))
    return pages


def page_of(tree: Tree, page: str, lesson: dict, exported: str, file: Path) -> str:
    parts = [f"# {lesson['title']}", ""]
    for k, (title, body) in enumerate(SECTION.findall(exported), 1):
        def as_file(match: re.Match, k=k, title=title) -> str:
            name = f"{page}-{k}.png"
            write_changed(tree.out / "_extra" / name, base64.b64decode(match[1]))
            return f'<img class="scene" alt="The scene: {title}" src="{Path(name).name}">'

        parts += [f"## {html.unescape(title)}", "", raw(PICTURE.sub(as_file, body)), ""]
    style = re.search(r"<style>(.*?)</style>", exported, re.DOTALL)[1]
    rules = "\n".join(line for line in style.split("\n") if line.startswith(RULES))
    script = re.search(r"<script>(.*?)</script>", exported, re.DOTALL)[1]
    parts += [raw(f"<style>\n{rules}\n</style>\n<script>{{\n{script}\n}}</script>"), ""]
    parts += ["In the program, with everything to turn and to change:", "",
              f"```bash\ntransillum-viewer --lesson {int(file.stem.split('-')[0])}\n```", ""]
    return "\n".join(parts)


def raw(text: str) -> str:
    return f"~~~~~{{raw}} html\n{text}\n~~~~~"


def card(stem: str, number: str, title: str, lesson: dict) -> str:
    count, questions = len(lesson["pages"]), sum("question" in p for p in lesson["pages"])
    return (f'<a class="card" href="{stem}.html"><img alt="" src="{stem}-1.png">'
            f"<strong>{number}. {html.escape(title)}</strong>"
            f"<span>{count} pages, {questions} questions</span></a>")


def index(pages: list[str], cards: list[str]) -> str:
    entries = "\n".join("/" + page for page in pages)
    return f"""# Lessons

The lessons explain the method, from the light that one patch receives to the error of a solution.
Here you can read them, answer their questions and step through their maps. In the program
(`transillum-viewer --lesson 1`), each page also sets up the scene and the solve.

{raw('<div class="cards">' + "".join(cards) + '</div>')}

To write a lesson: [its format](../viewer/LESSON_FORMAT.md).

```{{toctree}}
:hidden:

{entries}
```
"""
