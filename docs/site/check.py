#!/usr/bin/env python3
"""check.py DIR: every link, picture and anchor of the site in DIR leads somewhere inside it, and nothing is loaded from elsewhere."""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlparse

LOADED = {"img": "src", "script": "src", "link": "href", "source": "src", "iframe": "src"}


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.loads, self.anchors = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors |= {values[key] for key in ("id", "name") if values.get(key)}
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag in LOADED and values.get(LOADED[tag]) and values.get("rel") != "canonical":
            self.loads.append(values[LOADED[tag]])


def main():
    root = Path(sys.argv[1]).resolve()
    files = [path for path in sorted(root.rglob("*.html")) if "studio" not in path.relative_to(root).parts[:1]]
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in files}
    wrong, count = [], 0
    for path, page in pages.items():
        for link in page.links + page.loads:
            where, url = path.relative_to(root), urlparse(link)
            if url.scheme or url.netloc:
                if link in page.loads and url.scheme != "data":
                    wrong.append(f"{where}: loads {link} from elsewhere")
                continue
            count += 1
            if path.name == "404.html" and link.startswith("/"):
                continue
            to = (path.parent / unquote(url.path)).resolve() if url.path else path
            if to.is_dir():
                to /= "index.html"
            if not to.exists():
                wrong.append(f"{where}: {link} does not exist")
            elif url.fragment and to in pages and unquote(url.fragment) not in pages[to].anchors | {"__comments", "__toc"}:
                wrong.append(f"{where}: {link} has no such anchor")
    print("\n".join(sorted(set(wrong))) or f"{count} links of {len(pages)} pages lead somewhere")
    return 1 if wrong or count < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
