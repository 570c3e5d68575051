#!/usr/bin/env python3
# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""finish_site.py SITE API: what the theme of a Debian package lacks on a page without a server, and
Doxygen's pages as a part of the site, with a link back to it."""

import re
import shutil
import sys
from pathlib import Path

site, api = map(Path, sys.argv[1:])


def in_one_file(match: re.Match) -> str:
    """A style sheet that the package imports from the server's /javascript."""
    return Path("/usr/share" + match[1]).read_text()


def finish_style(file: Path) -> None:
    style = re.sub(r"@import url\((/javascript/[^)]*)\);", in_one_file, file.read_text())
    if "prefers-color-scheme" not in style:  # lost where the package compiles the style
        dark = re.search(r'body\[data-theme="dark"\] (\{[^}]*\})', style)[1]
        style += ("\n@media not print { @media (prefers-color-scheme: dark) "
                  f'{{ body:not([data-theme="light"]) {dark} }} }}\n')
    file.write_text(style)


def finish_script(folder: Path) -> None:
    """The package has the theme's script as a module, which a page does not load from a file."""
    script = (folder / "furo.js").read_text()
    module = re.match(r'import Gumshoe from "\./([\w.-]+)";', script)
    if module:
        script = (folder / module[1]).read_text() + script[module.end():]
        (folder / "furo.js").write_text(script)


def copy_api() -> None:
    shutil.rmtree(site / "api", ignore_errors=True)
    shutil.copytree(api, site / "api")
    title = '<div id="projectname">libtransillum'
    for page in (site / "api").glob("*.html"):
        text = page.read_text(errors="replace")
        page.write_text(text.replace(
            title, '<div id="projectname"><a href="../index.html">transillum</a> · libtransillum'))


finish_style(site / "_static/styles/furo.css")
finish_script(site / "_static/scripts")
copy_api()
