#!/usr/bin/env python3
"""Copies the pages of the documentation, and every file that they link to, into a folder from which mkdocs makes a site.

    tools/site_source.py build/site_source

Links are relative, so that the pages are read on a code host and as files too. Files keep their places to each other in the
copy: a link to a header or an example leads to it on the site as well.
"""
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^)\s]+)\)|^\[[^\]]*\]: (\S+)$", re.MULTILINE)


def pages():
    """Paths of all pages, from the root."""
    found = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [path.relative_to(ROOT) for path in found]


def prose(text):
    """The text without code, in which nothing is a link."""
    return re.sub(r"^```.*?^```$|`[^`\n]+`", "", text, flags=re.MULTILINE | re.DOTALL)


def links(page):
    """Links of a page within the sources: the path from the root, and the name of a place in it or ""."""
    found = []
    for match in LINK.finditer(prose((ROOT / page).read_text(encoding="utf-8"))):
        path, _, place = (match[1] or match[2]).partition("#")
        if "://" not in path and not path.startswith("mailto:"):
            target = (ROOT / page.parent / path).resolve() if path else ROOT / page
            found.append((target.relative_to(ROOT), place))
    return found


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    for path in {*pages(), *(path for page in pages() for path, _ in links(page))}:
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / path, folder / path)


if __name__ == "__main__":
    main()
