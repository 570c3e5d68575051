# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Documents of the source tree as pages: links between them lead to pages, blocks of commands get a
language, and names such as A_i their subscripts."""

from __future__ import annotations

import html
import os
import re
from pathlib import Path, PurePosixPath

LINK = re.compile(r"(!?)\[((?:[^\[\]]|!\[[^\]]*\]\([^)]*\))*)\]\(([^()\s]+)\)")
COMMANDS = ("transillum", "./demo", "./check", "apt ", "cmake ", "ctest ", "mpirun ", "srun ",
            "pip ", "#!/bin/bash", "E=", "S=", "build/")
WIDEST = 84  # characters of a line of code that a page shows
SYMBOL = r"(?<![\w`\\/.])([A-Za-zρφωψδεθ])"
SUBSCRIPT = re.compile(SYMBOL + r"_(\{[^{}]*\}|[a-z0-9]{1,3})(?![\w.(])")
SUPERSCRIPT = re.compile(r"(?<![\w`\\/.])([A-Za-z0-9]{1,2})\^(\([^()]*\)|[a-z0-9]+(?:\.[0-9]+)?)")


def anchor_of(title: str) -> str:
    """The anchor of a heading, as conf.py makes it."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


class Tree:
    """The files that become pages, and their places."""

    def __init__(self, source: Path, out: Path) -> None:
        self.source = source
        self.out = out
        self.pages: dict[str, str] = {}  # path in the source tree → page, without .md
        self.wanted_sources: set[str] = set()  # files that pages link to

    def write(self, page: str, text: str) -> None:
        """Writes a page where it has changed."""
        write_changed(self.out / f"{page}.md", text)

    def target(self, document: str, link: str, page: str) -> str:
        """A link of a document, as one from the page that it becomes; a file becomes a page of its
        own.

        Raises FileNotFoundError where it leads nowhere."""
        path, _, anchor = link.partition("#")
        if not path and document in self.pages:
            return link
        file = os.path.normpath(os.path.join(os.path.dirname(document), path)) if path else document
        place = self.pages.get(file)
        if place is None:
            if not (self.source / file).exists():
                raise FileNotFoundError(f"{document}: {link}")
            if (self.source / file).is_dir():
                raise FileNotFoundError(f"{document}: {link} is a folder without a page")
            self.wanted_sources.add(file)
            place = source_page(file)
        where = os.path.relpath(f"{place}.md", os.path.dirname(page) or ".")
        if place == page and anchor:
            return "#" + anchor
        return PurePosixPath(where).as_posix() + (f"#{anchor}" if anchor else "")


def source_page(file: str) -> str:
    return "source/" + re.sub(r"[^A-Za-z0-9_]+", "-", file).strip("-")


def write_changed(path: Path, content: str | bytes) -> None:
    data = content.encode() if isinstance(content, str) else content
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_bytes() != data:
        path.write_bytes(data)


def page_of(tree: Tree, document: str, text: str, page: str, symbols: bool = False) -> str:
    """The text of a document, or of a part of it, as the page `page`."""
    lines = []
    for kind, block in blocks(text):
        if kind == "math":
            lines += ["```{math}", *block[1:-1], "```"]
        elif kind == "indented":
            lines += fenced(block)
        elif kind == "fence":
            lines += block
        else:
            for line in block:
                lines.append(prose(tree, document, line, page, symbols))
    return "\n".join(lines).rstrip() + "\n"


def blocks(text: str):
    """Pairs of a kind (math, fence, indented or prose) and lines."""
    lines, k = text.split("\n"), 0
    while k < len(lines):
        begin = k
        if lines[k].startswith("```"):
            k += 1
            while not lines[k].startswith("```"):
                k += 1
            k += 1
            yield "math" if lines[begin] == "```math" else "fence", lines[begin:k]
        elif is_code(lines, k):
            while k < len(lines) and (lines[k].startswith("    ") or not lines[k].strip()):
                k += 1
            while not lines[k - 1].strip():
                k -= 1
            yield "indented", lines[begin:k]
        else:
            k += 1
            yield "prose", lines[begin:k]


def is_code(lines: list[str], k: int) -> bool:
    """Whether an indented block of code begins at line k: indented, after an empty line, outside of
    lists."""
    if not lines[k].startswith("    ") or (k > 0 and lines[k - 1].strip()):
        return False
    before = next((line for line in reversed(lines[:k]) if line.strip()), "")
    return not re.match(r"\s*([-*]|\d+\.)\s|\s", before) or before.startswith("    ")


def fenced(block: list[str]) -> list[str]:
    code = [line[4:] for line in block]
    first = code[0]
    language = "text"
    if first.startswith(COMMANDS) or first.startswith("sudo "):
        language = "bash"
    elif first.startswith("import "):
        language = "python"
    if language != "text" and max(map(len, code)) > WIDEST:
        code = with_comments_above(code)
    return [f"```{language}", *code, "```"]


def with_comments_above(code: list[str]) -> list[str]:
    """Moves comments at the ends of wide lines above them, where they are in sight."""
    lines = []
    for line in code:
        command, _, comment = re.sub(r" {2,}# ", "\n", line).partition("\n")
        lines += ([f"# {comment}"] if comment else []) + [command.rstrip()]
    return lines


def prose(tree: Tree, document: str, line: str, page: str, symbols: bool) -> str:
    def relinked(match: re.Match) -> str:
        image, text, link = match.groups()
        if "://" in link:
            return match[0]
        if image:
            return f"![{text or picture_text(link)}]({picture(tree, document, link, page, '')})"
        inner = LINK.sub(relinked, text)
        if link.endswith((".png", ".svg", ".csv")):
            return f'<a href="{picture(tree, document, link, page, "_extra")}">{inner}</a>'
        return f"[{inner}]({tree.target(document, link, page)})"

    line = LINK.sub(relinked, line)
    return with_symbols(line) if symbols and not line.startswith("#") else line


def picture_text(link: str) -> str:
    return html.escape(PurePosixPath(link).stem.replace("-", " "))


def picture(tree: Tree, document: str, link: str, page: str, folder: str) -> str:
    """Copies a picture to its place in the source tree, below `folder`."""
    file = os.path.normpath(os.path.join(os.path.dirname(document), link))
    write_changed(tree.out / folder / file, (tree.source / file).read_bytes())
    return PurePosixPath(os.path.relpath(file, os.path.dirname(page) or ".")).as_posix()


def with_symbols(line: str) -> str:
    """A_i and 2^p with subscripts and superscripts; code and links stay."""
    parts = re.split(r"(`[^`]*`|\]\([^)]*\)|<[^>]*>)", line)
    for k in range(0, len(parts), 2):
        parts[k] = SUBSCRIPT.sub(lambda m: f"<i>{m[1]}</i><sub>{script(m[2])}</sub>", parts[k])
        parts[k] = SUPERSCRIPT.sub(lambda m: f"{letter(m[1])}<sup>{script(m[2])}</sup>", parts[k])
    return "".join(parts)


def script(text: str) -> str:
    text = text[1:-1] if text[0] in "{(" else text
    return f"<i>{text}</i>" if re.fullmatch(r"[a-z]+", text) else text


def letter(text: str) -> str:
    return f"<i>{text}</i>" if text.isalpha() and len(text) == 1 else text


def sections(text: str, level: str = "## ") -> dict[str, str]:
    """The sections of a document by their titles; "" is what precedes the first one."""
    found, title, in_code = {"": []}, "", False
    for line in text.split("\n"):
        in_code ^= line.startswith("```")
        if line.startswith(level) and not in_code:
            title = line[len(level):]
            found[title] = []
        found[title].append(line)
    return {title: "\n".join(lines) for title, lines in found.items()}
