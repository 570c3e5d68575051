#!/usr/bin/env python3
# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""check_links.py SITE: every link, picture, script and style sheet of the site's pages leads to a
file of the site, every #anchor to an element, and nothing is loaded from elsewhere."""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {"img", "script", "link", "iframe", "source", "object"}
# Doxygen's pages name anchors that its script makes.
WITHOUT_ANCHORS = ("api",)


class Page(HTMLParser):
    """The links of a page, with their lines, and what can be linked to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[tuple[int, str, str]] = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids.update(v for k, v in attributes if v and (k == "id" or (k == "name" and tag == "a")))
        if tag == "link" and values.get("rel") in ("canonical", "preconnect"):
            return
        for name in ("href", "src", "data"):
            if values.get(name) is not None:
                self.links.append((self.getpos()[0], tag, values[name]))


def check(site: Path) -> tuple[list[str], int]:
    """@returns what is broken, and the number of links"""
    pages = {file.resolve(): Page(file.read_text(errors="replace")) for file in site.rglob("*.html")}
    broken, count = [], 0
    for file, page in pages.items():
        for line, tag, link in page.links:
            place = f"{file.relative_to(site.resolve())}:{line}: {link}"
            parts = urlsplit(link)
            if parts.scheme in ("data", "mailto") or link == "javascript:void(0)":
                continue
            if parts.scheme or parts.netloc:
                if tag in LOADED or parts.scheme not in ("http", "https"):
                    broken.append(f"{place}: not of the site")
                continue
            count += 1
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            if parts.path.startswith("/") or not target.is_file():
                broken.append(f"{place}: no such file")
            elif not target.is_relative_to(site.resolve()):
                broken.append(f"{place}: leads out of the site")
            elif (parts.fragment and target in pages
                  and target.relative_to(site.resolve()).parts[0] not in WITHOUT_ANCHORS
                  and unquote(parts.fragment) not in pages[target].ids):
                broken.append(f"{place}: no such anchor")
    return broken, count


def main() -> int:
    site = Path(sys.argv[1])
    broken, count = check(site)
    for line in sorted(broken):
        print(line)
    pages = len(list(site.rglob("*.html")))
    print(f"{pages} pages, {count} links, {len(broken)} broken")
    return 1 if broken or count < 1000 else 0


if __name__ == "__main__":
    sys.exit(main())
