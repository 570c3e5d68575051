#!/usr/bin/env python3
# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Writes what Sphinx makes the site of: the documents of the source tree at their places, lessons, manual pages, examples, the Python module, and plots of the studies."""

from __future__ import annotations

import argparse
import base64
import re
import subprocess
import tempfile
from pathlib import Path

from pages import lessons, manual, plots, reference
from pages.lessons import raw
from pages.markdown import Tree, page_of, sections, write_changed

CARDS = [
    ("lessons/index", "Lessons", "The method in lessons, with questions and maps to step through"),
    ("viewer/USER_GUIDE", "User guide", "The viewer: solving, inspecting, stepping, comparing"),
    ("command-line", "Command line", "The cookbook of tasks, and the manual page of every command"),
    ("libtransillum/ALGORITHM", "Algorithm", "The equations, what is promised, and how it is tested"),
    ("data/studies/plots", "Results", "Error against passes and against time, plotted"),
    ("library", "Library", "C++ and Python, with examples and the whole API"),
]

NAVIGATION = {
    "Use": ["viewer/USER_GUIDE", "lessons/index", "libtransillum/COOKBOOK", "command-line",
            "data/README", "data/FILES"],
    "Understand": ["libtransillum/ALGORITHM", "libtransillum/GLOSSARY", "libtransillum/RESULTS",
                   "data/studies/README", "data/studies/plots"],
    "Program": ["library", "libtransillum/api", "python", "figure-5"],
    "Develop": ["libtransillum/ARCHITECTURE", "libtransillum/FOLDERS", "libtransillum/decisions/README",
                "CONTRIBUTING", "tests/README", "viewer/LESSON_FORMAT", "CHANGELOG"],
}
WITH_SYMBOLS = ("libtransillum/", "data/studies/")


def plan(tree: Tree) -> list[str]:
    """Says which page each document becomes. @returns documents that become a page each"""
    listed = subprocess.run(["git", "-C", tree.source, "ls-files", "*.md"], capture_output=True, text=True)
    documents = listed.stdout.split() if listed.returncode == 0 else sorted(
        str(p.relative_to(tree.source)) for p in tree.source.rglob("*.md")
        if not {"build", ".git"} & set(p.relative_to(tree.source).parts))
    documents.remove("README.md")
    for document in documents:
        tree.pages[document] = document[:-3]
    tree.pages["README.md"] = "index"
    tree.pages["data/lessons"] = "lessons/index"
    tree.pages["libtransillum/decisions"] = "libtransillum/decisions/README"
    tree.pages["libtransillum/examples"] = "library"
    for example in sorted((tree.source / "libtransillum/examples").glob("*.cpp")):
        tree.pages[f"libtransillum/examples/{example.name}"] = f"examples/{example.stem}"
    tree.pages["libtransillum/python/notebooks/figure_5.ipynb"] = "figure-5"
    return documents


def toctree(pages, caption: str = "") -> str:
    lines = ["```{toctree}", ":hidden:"] + ([f":caption: {caption}"] if caption else [])
    return "\n".join([*lines, "", *("/" + page for page in pages), "```"])


def write_start(tree: Tree) -> None:
    """README without its list of documents, which the navigation has, and cards below its first
    lines."""
    readme = sections((tree.source / "README.md").read_text())
    introduction = page_of(tree, "README.md", readme.pop(""), "index")
    cards = "".join(f'<a class="card" href="{page}.html"><strong>{title}</strong><span>{words}</span></a>'
                    for page, title, words in CARDS)
    parts = [introduction, raw(f'<div class="cards start">{cards}</div>'), ""]
    readme.pop("Documents", None)
    parts += [page_of(tree, "README.md", section, "index") for section in readme.values()]
    parts += [toctree(pages, caption) for caption, pages in NAVIGATION.items()]
    tree.write("index", "\n".join(parts))


def write_command_line(tree: Tree, man_pages: list[str]) -> None:
    links = "\n".join(f"- [{Path(page).name}]({page}.md)" for page in man_pages)
    tree.write("command-line", "# The command line\n\nTasks with their commands and outputs: the "
               "[cookbook](libtransillum/COOKBOOK.md). What `man transillum-solve` and so on show:"
               f"\n\n{links}\n\n" + toctree(man_pages) + "\n")


def write_documents(tree: Tree, documents: list[str]) -> None:
    for document in documents:
        text = (tree.source / document).read_text()
        page = tree.pages[document]
        body = page_of(tree, document, text, page, document.startswith(WITH_SYMBOLS))
        if document == "libtransillum/decisions/README.md":
            notes = sorted(d for d in documents if re.search(r"decisions/\d{4}-", d))
            body += "\n" + toctree([note[:-3] for note in notes]) + "\n"
        if document == "viewer/USER_GUIDE.md":
            guide = sorted(d for d in documents if d.startswith("viewer/guide/"))
            body += "\n" + toctree([one[:-3] for one in guide]) + "\n"
        tree.write(page, body)


def write_static(tree: Tree, katex: Path) -> None:
    """Style, script, and KaTeX with its fonts inside the style sheet: a browser may refuse fonts
    from files."""
    here = Path(__file__).parent / "static"
    for file in here.iterdir():
        write_changed(tree.out / "_static" / file.name, file.read_bytes())
    style = (katex / "katex.min.css").read_text()

    def inside(match: re.Match) -> str:
        data = base64.b64encode((katex / match[1]).read_bytes()).decode()
        return f'src:url(data:font/woff2;base64,{data}) format("woff2")'

    style = re.sub(r'src:url\((fonts/[^)]+\.woff2)\)[^;}]*', inside, style)
    write_changed(tree.out / "_static/katex.css", style)
    write_changed(tree.out / "_static/katex.js", (katex / "katex.min.js").read_bytes())
    icon = tree.source / "viewer/desktop/icons/transillum-viewer.svg"
    for folder in ("_static", "_extra"):
        write_changed(tree.out / folder / "icon.svg", icon.read_bytes())


def notebook_map(program: str) -> str:
    """The map that the notebook's last cell draws, as SVG."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "map.svg"
        subprocess.run([program, "map", "cornell-box", "--patches", "150", "--direction", "0.4,0.3,1",
                        "--size", "640", "--out", file], check=True, stdout=subprocess.DEVNULL)
        return re.sub(r"<\?xml.*?\?>|<!DOCTYPE.*?>", "", file.read_text(), flags=re.DOTALL)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("source", "out", "lessons", "manual", "katex", "mandoc", "program", "api"):
        parser.add_argument(f"--{name}", required=True)
    given = parser.parse_args()
    tree = Tree(Path(given.source), Path(given.out))
    documents = plan(tree)
    write_start(tree)
    write_documents(tree, documents)
    write_command_line(tree, manual.write(tree, Path(given.manual), given.mandoc))
    lessons.write(tree, Path(given.lessons))
    reference.write_library(tree)
    reference.write_api(tree, Path(given.api))
    reference.write_python(tree)
    reference.write_notebook(tree, plots.notebook_plot(tree.source), notebook_map(given.program))
    reference.write_sources(tree)
    plots.write(tree)
    write_static(tree, Path(given.katex))


if __name__ == "__main__":
    main()
