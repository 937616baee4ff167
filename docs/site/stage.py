#!/usr/bin/python3
"""Copies the pages of the repository to a folder, as Sphinx reads them:  stage.py REPOSITORY FOLDER

README.md becomes the first page. Links to folders lead to the page that tells of them, or become plain text; other files
that pages link to are copied beside them. The index of the manual becomes the contents of the site.
"""

import os
import re
import shutil
import sys
from pathlib import Path

FENCE = re.compile(r"(^```.*?^```$)", re.M | re.S)
LINK = re.compile(r"(!?)\[((?:[^][]|\[[^]]*\]|!\[[^]]*\]\([^)]*\))*)\]\(([^)\s]+)\)")
FIRST = {"README.md": "index.md"}


def pages(root):
    single = "README.md CONTRIBUTING.md CHANGELOG.md output/README.md packaging/README.md studio/README.md"
    named = [root / name for name in single.split()]
    return named + sorted((root / "docs").rglob("*.md"))


class Stage:
    def __init__(self, root, folder):
        self.root, self.folder = root, folder
        self.pages = {page.relative_to(root).as_posix() for page in pages(root)}

    def place_of(self, target):
        """Where a link leads within the site; None: nowhere."""
        path = os.path.relpath(target, self.root)
        if path in self.pages:
            return FIRST.get(path, path)
        if target.is_dir():
            parts = Path(path).parts
            return f"docs/models.md#{parts[1]}" if parts[0] == "models" and len(parts) == 2 else None
        if not target.is_file() or path.startswith(".."):
            return None
        copy = self.folder / path
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(target, copy)
        return path

    def links_of(self, text, page):
        def replaced(match):
            picture, words, link = match.groups()
            words = LINK.sub(replaced, words)
            if link.startswith(("http", "#", "mailto:")):
                return f"{picture}[{words}]({link})"
            file, _, heading = link.partition("#")
            place = self.place_of((page.parent / file).resolve())
            if place is None:
                return words
            staged = FIRST.get(page.relative_to(self.root).as_posix(), page.relative_to(self.root).as_posix())
            place, _, own = place.partition("#")
            relative = os.path.relpath(place, os.path.dirname(staged) or ".")
            heading = heading or own
            return f"{picture}[{words}]({relative}{'#' + heading if heading else ''})"

        parts = FENCE.split(text)
        return "".join(part if part.startswith("```") else LINK.sub(replaced, part) for part in parts)

    def write(self):
        for name in sorted(self.pages):
            page = self.root / name
            text = self.links_of(page.read_text(encoding="utf-8"), page)
            if name == "README.md":
                text += contents_of(self.root)
            elif name in ("docs/reference/README.md", "docs/models.md", "docs/experiments.md"):
                text += children_of(self.root, page)
            self.put(self.folder / FIRST.get(name, name), text)

    @staticmethod
    def put(staged, text):
        """Leaves a page that is the same untouched: Sphinx reads what is new."""
        if staged.is_file() and staged.read_text(encoding="utf-8") == text:
            return
        staged.parent.mkdir(parents=True, exist_ok=True)
        staged.write_text(text, encoding="utf-8")


def tree(caption, links):
    head = f"\n```{{toctree}}\n:hidden:\n" + (f":caption: {caption}\n" if caption else "")
    return head + "\n" + "\n".join(links) + "\n```\n"


def contents_of(root):
    """The sections of the index of the manual, each with its pages in their order."""
    text = (root / "docs/README.md").read_text(encoding="utf-8")
    seen, trees = set(), [tree("", ["docs/README.md"])]
    for section in re.split(r"^## ", text, flags=re.M)[1:]:
        caption, _, body = section.partition("\n")
        links = []
        for _, _, link in LINK.findall(body):
            path = os.path.relpath((root / "docs" / link.partition("#")[0]).resolve(), root)
            if path.endswith(".md") and path not in seen and not path.startswith("docs/experiments/"):
                seen.add(path)
                links.append(path)
        trees.append(tree(caption, links))
    return "".join(trees) + tree("Project", ["CHANGELOG.md", "output/README.md", "studio/README.md"])


def children_of(root, page):
    """The pages that a page is the index of, section by section."""
    seen, trees = set(), []
    for section in re.split(r"^## ", page.read_text(encoding="utf-8"), flags=re.M):
        links = []
        for _, _, link in LINK.findall(section):
            file = link.partition("#")[0]
            below = file.startswith(("reference/models/", "experiments/")) or page.parent.name == "reference"
            if below and file.endswith(".md") and not file.startswith("..") and file not in seen:
                seen.add(file)
                links.append(file)
        if links:
            trees.append(tree("", links))
    return "".join(trees)


def main():
    root, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    stage = Stage(root, folder)
    for page in folder.rglob("*.md"):
        if page.relative_to(folder).as_posix() not in stage.pages | {"index.md"}:
            page.unlink()
    stage.write()
    (folder / "_static").mkdir(exist_ok=True)
    for name, place in (("conf.py", "conf.py"), ("site.css", "_static/site.css")):
        shutil.copy2(root / "docs/site" / name, folder / place)


if __name__ == "__main__":
    main()
