#!/usr/bin/env python3
"""make.py ROOT OUT STUDIO: lays out the pages of the project for mkdocs and starts it. docs/site/build calls it.

Pages keep their places, so a link that works in the repository works in the site. A link to a folder leads to its README,
a link to a header to its reference, a link to another file to a page that shows the file. A name of the library in backticks
becomes a link to the reference.
"""

import json
import logging
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import mkdocs.commands.build
import mkdocs.config
import yaml

import reference

MARK = ".hf-site"  # in a folder that make.py wrote and may write again
LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\])\(([^)\s]+)\)|`(hf_\w+)(\([^`]*\))?`")
PICTURES = {".png", ".jpg", ".svg", ".gif", ".webp"}
LANGUAGES = {".c": "c", ".h": "c", ".hpp": "c++", ".cpp": "c++", ".py": "python", ".json": "json", ".js": "js",
    ".mjs": "js", ".rs": "rust", ".cs": "csharp", ".yml": "yaml", ".txt": "text", ".sh": "bash", ".wgsl": "text", ".glsl": "glsl"}


def slug(title, separator="-"):
    """The anchor of a heading as hosts of repositories make it."""
    return re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", separator)


def drawing(text):
    """A flowchart of Mermaid as SVG by Graphviz, since the browser has no network to load Mermaid from."""
    lines = ['digraph {bgcolor=none; node [shape=box, style=rounded, fontname="sans-serif", fontsize=11]; ranksep=0.3;']
    for name, label in re.findall(r'(\w+)\["([^"]*)"\]', text):
        lines.append('%s [label="%s"];' % (name, label.replace(": ", ":\\n").replace(", ", ",\\n")))
    lines += [f"{a} -> {b};" for a, b in re.findall(r'(\w+)(?:\["[^"]*"\])? --> (\w+)', text)]
    svg = subprocess.run(["dot", "-Tsvg"], input="\n".join(lines + ["}"]), capture_output=True, text=True, check=True).stdout
    svg = re.sub(r'(stroke|fill)="black"', r'\1="currentColor"', svg[svg.index("<svg"):])
    return '<div class="drawing">' + re.sub(r"\s*\n\s*", "", re.sub(r"<!--.*?-->|<title>.*?</title>", "", svg, flags=re.S)) + "</div>"


class Layout:
    """A folder for mkdocs with the pages that are wanted and all that they link to."""

    def __init__(self, root, folder):
        self.root, self.folder, self.made, self.queue = root, folder, {}, []
        self.api = json.loads((root / "bindings/api.json").read_text())
        self.sources = {path.name: path.read_text() for path in sorted((root / "include/hf").glob("*.h"))}
        self.names = reference.anchors(self.api, self.sources)
        self.tracked = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True).stdout.split("\n")

    def need(self, path):
        """The page or picture that stands for a file or folder of the project."""
        path = os.path.normpath(path)
        if path not in self.made:
            self.made[path] = self.place(path)
            self.queue.append(path)
        return self.made[path]

    def place(self, path):
        at = self.root / path
        if not at.exists():
            raise SystemExit(f"{path} does not exist, to which a page leads")
        if at.is_dir():
            return f"{path}/README.md"
        if at.suffix == ".md" or at.suffix in PICTURES:
            return path
        if path.startswith("include/hf/") and at.suffix == ".h" and any(header == at.name for header in self.names.values()):
            return path[:-2] + ".md"
        return path + ".md" if at.suffix in LANGUAGES or not at.suffix else path

    def write(self, path):
        at, to = self.root / path, self.folder / self.made[path]
        to.parent.mkdir(parents=True, exist_ok=True)
        if at.is_dir() and (at / "README.md").exists():
            self.need(f"{path}/README.md")
        elif at.is_dir():
            to.write_text(self.page(self.listing(path), f"{path}/README.md"))
        elif self.made[path] == path and at.suffix != ".md":
            shutil.copyfile(at, to)
        elif at.suffix == ".md":
            to.write_text(self.page(at.read_text(), path))
        elif self.made[path] == path[:-2] + ".md":
            to.write_text(self.page(reference.page(at.name, self.sources[at.name], self.api, self.names), path, linked=False))
        else:
            language = LANGUAGES.get(at.suffix, "text")
            to.write_text(f"# {at.name}\n\n`{path}`\n\n````{language}\n{at.read_text()}\n````\n")

    def listing(self, path):
        inside = sorted({line[len(path) + 1:].split("/")[0] for line in self.tracked if line.startswith(path + "/")}) or sorted(os.listdir(self.root / path))
        out = f"# {path}\n\n"
        for name in inside:
            at = self.root / path / name
            shown = at.suffix in {".md", *LANGUAGES} or (at / "README.md").exists()
            use = ": " + reference.use(at.read_text()) if path == "include/hf" and name in self.sources else ""
            out += (f"- [{name}]({name})" if shown else f"- {name}") + use + "\n"
        return out

    def page(self, text, path, linked=True):
        """A page with links that mkdocs follows."""
        out, fence, block, listed = [], "", [], False
        for line in text.split("\n"):
            if fence:
                block.append(line)
                if line.startswith(fence):
                    drawn = block[0] == "```mermaid"
                    out += [drawing("\n".join(block))] if drawn else block
                    fence = ""
                continue
            if re.match(r" {4}", line) and not listed:
                out.append(line)  # code
                continue
            listed = bool(re.match(r" *([-*]|\d+\.) ", line)) or listed and (not line or line.startswith(" "))
            if re.match(r"```+", line):
                fence, block = re.match(r"`+", line).group(), [re.sub(r"[ ,].*", "", line)]
                continue
            item = re.match(r"( *)([-*]|\d+\.) ", line)
            if item and out and out[-1].strip() and not re.match(r" *([-*]|\d+\.) |  ", out[-1]):
                out.append("")  # Python-Markdown begins a list only behind an empty line
            if item and len(item.group(1)) in (2, 3):
                line = "    " + line.lstrip()
            out.append(LINK.sub(lambda m: self.link(m, path, linked and not line.startswith("#")), line))
            for picture in re.findall(r'<img [^>]*src="([^":]+)"', line):
                self.need(os.path.join(os.path.dirname(path), picture))
        return "\n".join(out)

    def link(self, match, path, linked):
        label, target, name, rest = match.groups()
        folder = os.path.dirname(path) or "."
        if name:
            if name not in self.names or not linked:
                return match.group()
            to = self.need("include/hf/" + self.names[name])
            return f"[{match.group()}]({os.path.relpath(to, folder)}#{name})"
        if re.match(r"[a-z]+:|#", target):
            return match.group()
        file, _, anchor = target.partition("#")
        to = self.need(os.path.join(folder, file))
        return f"{label}({os.path.relpath(to, folder)}" + (f"#{anchor})" if anchor else ")")

    def finish(self):
        while self.queue:
            self.write(self.queue.pop())


def title(path):
    return re.search(r"^# (.*)", path.read_text(), re.M).group(1).replace("`", "")


def sidebar(layout, nav):
    """The nav of mkdocs.yml; an entry that ends with a slash becomes the pages of that folder."""
    out = []
    for entry in nav:
        (name, value), = entry.items()
        if isinstance(value, list):
            out.append({name: sidebar(layout, value)})
        elif value == "include/hf/":
            headers = sorted(set(layout.names.values()))
            out.append({name: [{header: layout.need(value + header)} for header in headers]})
        elif value.endswith("/"):
            pages = sorted(layout.root.glob(value + "*.md")) + sorted(layout.root.glob(value + "*/README.md"))
            out.append({name: [{title(page): layout.need(str(page.relative_to(layout.root)))} for page in pages]})
        else:
            out.append({name: layout.need(value)})
    return out


def main():
    root, out, studio = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3]
    if out.exists() and any(out.iterdir()) and not (out / MARK).exists():
        raise SystemExit(f"{out} has files that docs/site/build did not write; name another folder")
    here = Path(__file__).parent
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "docs"
        folder.mkdir()
        layout = Layout(root, folder)
        settings = yaml.safe_load((here / "mkdocs.yml").read_text())
        settings["nav"] = sidebar(layout, settings["nav"])
        layout.finish()
        shutil.copyfile(here / "site.css", folder / "site.css")
        if studio:
            shutil.copytree(studio, folder / "studio")
            settings["nav"].append({"Studio": "studio/index.html"})
        (Path(scratch) / "mkdocs.yml").write_text(yaml.safe_dump(settings))
        logging.getLogger("mkdocs").setLevel(logging.WARNING)
        logging.getLogger("mkdocs").addHandler(logging.StreamHandler())
        config = mkdocs.config.load_config(str(Path(scratch) / "mkdocs.yml"), docs_dir=str(folder), site_dir=str(out), strict=True)
        config["mdx_configs"]["toc"]["slugify"] = slug
        mkdocs.commands.build.build(config)
        unlisted = {made[:-3] + ".html" for path, made in layout.made.items() if made == path + ".md"}
        index = out / "search/search_index.json"  # without the pages that show a file
        found = json.loads(index.read_text())
        found["docs"] = [entry for entry in found["docs"] if entry["location"].partition("#")[0] not in unlisted]
        index.write_text(json.dumps(found, separators=(",", ":")))
    (out / MARK).write_text("")


main()
