# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Settings of Sphinx for the site. The pages are written by make_pages.py; CMakeLists.txt runs
both, and passes the version on."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from pages.markdown import anchor_of  # noqa: E402

pages = Path(os.environ["TRANSILLUM_PAGES"])
project = "transillum"
author = "the authors of transillum"
version = release = os.environ.get("TRANSILLUM_VERSION", "")
extensions = ["myst_parser"]
html_theme = "furo"
html_title = f"transillum {version}"
html_favicon = str(pages / "_extra/icon.svg")
html_static_path = [str(pages / "_static")]
html_css_files = ["katex.css", "site.css"]
html_js_files = ["site.js"]
html_extra_path = [str(pages / "_extra")]
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
html_theme_options = {
    "light_logo": "icon.svg",
    "dark_logo": "icon.svg",
    "light_css_variables": {
        "color-brand-primary": "#0b5cad",
        "color-brand-content": "#0b5cad",
    },
    "dark_css_variables": {
        "color-brand-primary": "#6cb2ff",
        "color-brand-content": "#6cb2ff",
    },
}
exclude_patterns = ["_extra", "_static"]
highlight_language = "none"
pygments_style = "friendly"
pygments_dark_style = "github-dark"
add_function_parentheses = True
python_use_unqualified_type_names = True
html_math_renderer = "katex"
suppress_warnings = ["myst.header"]


myst_heading_anchors = 6
myst_heading_slug_func = anchor_of
myst_enable_extensions = ["dollarmath"]
myst_dmath_allow_space = False
myst_dmath_allow_digits = False


def setup(app):
    """Formulas stay TeX in the pages; site.js typesets them by KaTeX, which is part of the site."""

    def visit(block):
        def write(writer, node):
            tag = "div" if block else "span"
            writer.body.append(writer.starttag(node, tag, "", CLASS="math notranslate"))
            writer.body.append(writer.encode(node.astext()) + f"</{tag}>" + "\n" * block)
            from docutils.nodes import SkipNode

            raise SkipNode

        return write

    app.add_html_math_renderer("katex", (visit(False), None), (visit(True), None))

    def add_katex(app, page, template, context, doctree):
        if doctree is not None and "math_block" in {n.tagname for n in doctree.findall()}:
            app.add_js_file("katex.js", priority=100)

    app.connect("html-page-context", add_katex)
