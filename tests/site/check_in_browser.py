#!/usr/bin/env python3
# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""check_in_browser.py SITE BROWSER: opens every page of the site from the file system in a headless
Chromium, at the widths of a desktop and of a phone. Fails on an error in the console, a formula that
was not typeset, a picture that is not shown, and what is cut off at the edge of the window. Of the
API, which Doxygen makes, only errors count, and of some pages."""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

WIDTHS = (1280, 390)
API_PAGES = ("index.html", "namespacetransillum.html", "classtransillum_1_1Scene.html", "files.html")

# Loads one page after another in a frame; the results go to the title. The browser's time is virtual:
# the script must wait for nothing but loading.
DRIVER = """<!doctype html><meta charset="utf-8"><title>running</title><body style="margin:0"><script>
const pages = PAGES, widths = WIDTHS, found = [];
let formulas = 0, pictures = 0;
const frame = document.createElement('iframe');
document.body.append(frame);
const load = url => new Promise(done => { frame.onload = done; frame.src = url; });
const wait = ms => new Promise(done => setTimeout(done, ms));
function look(page, width) {
  const inner = frame.contentDocument, view = frame.contentWindow;
  for (const part of inner.querySelectorAll('article *')) {
    if (part.getBoundingClientRect().right <= width + 1 || part.closest('.katex-mathml')) continue;
    let box = part.parentElement;
    while (box.tagName !== 'ARTICLE' && !/auto|scroll/.test(view.getComputedStyle(box).overflowX))
      box = box.parentElement;
    if (box.tagName === 'ARTICLE') {
      found.push(page + ': ' + part.tagName + ' is cut off in a window of ' + width);
      break;
    }
  }
  for (const formula of inner.querySelectorAll('.math')) {
    ++formulas;
    if (!formula.querySelector('.katex') || formula.querySelector('.katex-error'))
      found.push(page + ': formula not typeset: ' + formula.textContent);
  }
  for (const picture of inner.images) {
    ++pictures;
    if (!picture.complete || !picture.naturalWidth)
      found.push(page + ': ' + picture.src + ' is not shown');
  }
}
(async () => {
  for (const width of widths) {
    frame.style = 'border:0;height:900px;width:' + width + 'px';
    for (const page of pages) {
      await load('file://SITE/' + page);
      await wait(20);
      if (!page.startsWith('api/'))
        look(page, width);
    }
  }
  document.title = JSON.stringify({found, formulas, pictures, pages: pages.length});
})();
</script>"""


def run(browser: str, page: Path, folder: str, options: list[str]) -> tuple[str, list[str]]:
    """@returns the document after its scripts, and the lines of the console"""
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
               "--host-resolver-rules=MAP * ~NOTFOUND",  # no network
               "--virtual-time-budget=3600000", f"--user-data-dir={folder}/profile", *options,
               "--dump-dom", page.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=1500)
    console = [line for line in done.stderr.split("\n") if "CONSOLE" in line]
    return done.stdout, console


def main() -> int:
    site, browser = Path(sys.argv[1]).resolve(), sys.argv[2]
    pages = sorted(str(f.relative_to(site)) for f in site.rglob("*.html") if "api" not in f.parts)
    pages += [f"api/{name}" for name in API_PAGES]
    with tempfile.TemporaryDirectory() as folder:
        driver = Path(folder) / "driver.html"
        driver.write_text(DRIVER.replace("PAGES", json.dumps(pages), 1)
                          .replace("WIDTHS", json.dumps(WIDTHS), 1).replace("SITE", str(site)))
        # The driver reads what is in the frame; the pages by themselves do without the option.
        document, console = run(browser, driver, folder, ["--allow-file-access-from-files"])
        alone = [site / name for name in ("index.html", "libtransillum/ALGORITHM.html",
                                          "lessons/index.html", "search.html", "api/index.html")]
        for page in alone:
            console += run(browser, page, folder, [])[1]
    title = re.search(r"<title>(.*?)</title>", document, re.DOTALL)
    if not title or title[1] == "running":
        print("the browser did not reach the end of the pages")
        return 1
    result = json.loads(title[1].replace("&amp;", "&").replace("&lt;", "<").replace("&gt;", ">"))
    for line in console + result["found"]:
        print(line)
    print(f"{result['pages']} pages at {len(WIDTHS)} widths, {result['formulas']} formulas, "
          f"{result['pictures']} pictures, {len(console)} errors in the console, "
          f"{len(result['found'])} other faults")
    return 1 if console or result["found"] or not result["formulas"] else 0


if __name__ == "__main__":
    sys.exit(main())
