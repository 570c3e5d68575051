# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""The library as pages: examples with their source, the public headers with links into Doxygen's
pages, the Python module from its docstrings, its notebook, and files that documents refer to."""

from __future__ import annotations

import ast
import html
import json
import re
from pathlib import Path

from .lessons import raw
from .markdown import Tree

LANGUAGES = {".cpp": "cpp", ".h": "cpp", ".py": "python", ".cff": "yaml", ".json": "json"}
EXAMPLE = re.compile(r"@example (\S+)\n(.*?)\n\n", re.DOTALL)


LIBRARY = """# The library

The library computes what the programs show: scenes, visibility, maps, solves, and files. It is for
C++20 ([API](libtransillum/api.md)) and for Python ([module](python.md)); the
[cookbook](libtransillum/COOKBOOK.md) has a first program in each. Its examples:

"""


def write_library(tree: Tree) -> None:
    """A page about the library, and one for each of its examples."""
    folder = "libtransillum/examples"
    comments = (tree.source / "libtransillum/libdoc.dox").read_text().replace("*/", "\n")
    names, rows = [], []
    for name, words in EXAMPLE.findall(comments):
        text = (tree.source / folder / name).read_text()
        page = tree.pages[f"{folder}/{name}"]
        tree.write(page, f"# {name}\n\n{' '.join(words.split())}\n\n```cpp\n{text}```\n")
        names.append("/" + page)
        rows.append(f"- [{name}]({page}.md)")
    tree.write("library", LIBRARY + "\n".join(rows) + "\n\n```{toctree}\n:hidden:\n\n" + "\n".join(names) + "\n```\n")


def write_api(tree: Tree, api: Path) -> None:
    """The public headers by layer, as the table in FOLDERS has them, and what they declare."""
    architecture = (tree.source / "libtransillum/FOLDERS.md").read_text()
    table = architecture[architecture.index("## Public headers"):].split("\n## ")[0]
    places = re.findall(r'class="el" href="(namespacetransillum\.html#\w+)">(\w+)</a>',
                        (api / "namespacetransillum.html").read_text())
    functions = {name: place for place, name in reversed(places)}
    parts = ["# API", "", raw(
        '<p>The declarations of <code>transillum/transillum.h</code>, by layer and header. Everything, with search: '
        '<a href="../api/index.html">the API documentation</a>, '
        '<a href="../api/namespacetransillum.html">namespace transillum</a>, '
        '<a href="../api/annotated.html">classes</a>.</p>'), ""]
    for layer, headers in re.findall(r"^\| `(\w+)` \| ([^|]*) \|", table, re.M):
        parts += [f"## {layer}", "", raw('<dl class="headers">' + "".join(
            entry(tree.source, header, api, functions)
            for header in re.findall(r"`([^`]+)`", headers)) + "</dl>"), ""]
    tree.write("libtransillum/api", "\n".join(parts))


def entry(source: Path, header: str, api: Path, functions: dict[str, str]) -> str:
    text = (source / "libtransillum/include/transillum" / header).read_text()
    names = re.findall(r"^(?:class|struct|enum class) (?:TRANSILLUM_API )?(\w+)(?: final)?[^;]*?\{", text, re.M)
    declared = [re.search(r"(?<![\w:])(\w+)\(", line) for line in text.split("\n") if line[:1].isalpha()]
    names += [found[1] for found in declared if found]
    links = [link(api, functions, name) for name in dict.fromkeys(names)]
    page = header.replace("_", "__").replace(".", "_8") + "_source.html"
    return (f'<dt><a href="../api/{page}"><code>{header}</code></a></dt>'
            f"<dd>{', '.join(filter(None, links))}</dd>")


def link(api: Path, functions: dict[str, str], name: str) -> str:
    """To Doxygen's page; empty where it has none."""
    for kind in ("class", "struct"):
        page = f"{kind}transillum_1_1{name}.html"
        if (api / page).exists():
            return f'<a href="../api/{page}">{name}</a>'
    place = functions.get(name)
    return f'<a href="../api/{place}">{name}</a>' if place else ""


def write_python(tree: Tree) -> None:
    folder = tree.source / "libtransillum/python/transillum"
    module = ast.parse((folder / "__init__.py").read_text())
    public = next(ast.literal_eval(node.value) for node in module.body
                  if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
    parts = ["# Python module", ""]
    parts += docstring(ast.get_docstring(module)) + [""]
    parts += ["## Functions and classes", ""]
    found = {}
    for file in sorted(folder.glob("_*.py")):
        for node in ast.parse(file.read_text()).body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name in public:
                found[node.name] = node
    parts += ["````````{py:module} transillum", "````````", ""]
    for name in sorted(found, key=lambda n: (isinstance(found[n], ast.ClassDef), n.lower())):
        parts += described(found[name], 8) + [""]
    tree.write("python", "\n".join(parts))


def described(node, depth: int, method: bool = False) -> list[str]:
    """A directive of Sphinx's Python domain, with the directives of the members of a class."""
    fence = "`" * depth
    inner: list[str] = docstring(ast.get_docstring(node) or "")
    if isinstance(node, ast.ClassDef):
        init = next((n for n in node.body if getattr(n, "name", "") == "__init__"), None)
        public = init is not None and not any("_core" in ast.unparse(a) for a in init.args.args)
        signature = node.name + (arguments(init, True) if public else "")
        if public:
            inner += [""] + docstring(ast.get_docstring(init) or "")
        for member, after in zip(node.body, [*node.body[1:], None]):
            if isinstance(member, ast.FunctionDef) and not member.name.startswith("_"):
                inner += [""] + described(member, depth - 1, True)
            elif isinstance(member, ast.AnnAssign) and is_text(after):
                inner += ["", "`" * (depth - 1) + f"{{py:attribute}} {member.target.id}",
                          f":type: {ast.unparse(member.annotation)}", "",
                          *docstring(ast.literal_eval(after.value)), "`" * (depth - 1)]
        return [f"{fence}{{py:class}} {signature}", *inner, fence]
    decorators = [ast.unparse(d) for d in node.decorator_list]
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    if "property" in decorators:
        return [f"{fence}{{py:attribute}} {node.name}", f":type: {returns[4:]}", "", *inner, fence]
    kind = "method" if method else "function"
    return [f"{fence}{{py:{kind}}} {node.name}{arguments(node, method)}{returns}", *inner, fence]


def is_text(node) -> bool:
    return isinstance(node, ast.Expr) and isinstance(getattr(node.value, "value", None), str)


def arguments(node: ast.FunctionDef, method: bool) -> str:
    args = ast.parse(ast.unparse(node)).body[0].args
    if method and args.args:
        args.args = args.args[1:]
    return f"({ast.unparse(args)})"


def docstring(text: str) -> list[str]:
    """Lines of Markdown: parameters as a list, sessions as code, ``names`` as code."""
    lines: list[str] = []
    in_code = False
    for line in text.split("\n"):
        is_session = line.lstrip().startswith((">>>", "..."))
        if is_session != in_code:
            lines.append("```python" if is_session else "```")
            in_code = is_session
        if is_session:
            lines.append(line.strip()[4:])
            continue
        line = line.replace("``", "`")
        parameter = re.match(r"(\w+(?:, \w+)*): (.*)", line)
        lines.append(f"- **{parameter[1]}**: {parameter[2]}" if parameter else
                     re.sub(r"^ {4}", "  ", line))
    return lines + ["```"] * in_code


def write_notebook(tree: Tree, plot: str, map_svg: str) -> None:
    """The notebook's cells with a plot of the studies, and a map that the program has drawn."""
    file = "libtransillum/python/notebooks/figure_5.ipynb"
    cells = json.loads((tree.source / file).read_text())["cells"]
    parts = []
    for cell in cells:
        text = "".join(cell["source"])
        parts += [text if cell["cell_type"] == "markdown" else f"```python\n{text}\n```", ""]
        if "plt.subplots" in text:
            parts += ["For the whole sphere-flake, from the [studies](data/studies/plots.md):", "",
                      raw(plot), ""]
    parts += [raw(f'<div class="map">{map_svg}</div>'), ""]
    tree.write(tree.pages[file], "\n".join(parts))


def write_sources(tree: Tree) -> None:
    for file in sorted(tree.wanted_sources):
        text = (tree.source / file).read_text()
        language = LANGUAGES.get(Path(file).suffix, "text")
        tree.write("source/" + re.sub(r"[^A-Za-z0-9_]+", "-", file).strip("-"),
                   f"---\norphan: true\n---\n# {file}\n\n`````{language}\n{text}\n`````\n")
