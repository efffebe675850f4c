"""Links of the pages lead somewhere, on a code host and on the site, and every page is in the contents of the site."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unicodedata
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tools"))
import site_source  # noqa: E402


def name_on_a_host(heading):
    """The name of a heading as GitHub and others make it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def name_on_the_site(heading):
    """As Python-Markdown makes it."""
    text = unicodedata.normalize("NFKD", heading).encode("ascii", "ignore").decode()
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", text).strip().lower())


def places(page):
    """Names that a link to the page may end with: of headings that both call the same, and of anchors."""
    text = re.sub(r"^```.*?^```$", "", (SOURCE / page).read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    headings = [re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip() for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE)]
    names = [name_on_a_host(heading) for heading in headings if name_on_a_host(heading) == name_on_the_site(heading)]
    return {name for name in names if names.count(name) == 1} | set(re.findall(r'<a id="([\w-]+)">', text))


class Links(unittest.TestCase):
    def test_files_are_there(self):
        """No folders: a site has no page for them."""
        count = 0
        for page in site_source.pages():
            for path, _ in site_source.links(page):
                self.assertTrue((SOURCE / path).is_file(), f"{page}: {path}")
                count += 1
        self.assertGreater(count, 100)

    def test_pages_elsewhere_link_to_what_is_there(self):
        for name in ("configs/README.md", "bench/peers/README.md"):
            for path, place in site_source.links(pathlib.Path(name)):
                self.assertTrue((SOURCE / path).exists(), f"{name}: {path}")
                if place:
                    self.assertIn(place, places(path), f"{name}: {path}#{place}")

    def test_places_in_pages_are_there(self):
        count = 0
        for page in site_source.pages():
            for path, place in site_source.links(page):
                if place and path.suffix == ".md":
                    self.assertIn(place, places(path), f"{page}: {path}#{place}")
                    count += 1
        self.assertGreater(count, 50)

    def test_every_page_is_in_the_contents_once(self):
        """Entries of the notebook have contents of their own."""
        contents = re.findall(r"[\w/-]+\.md", (SOURCE / "mkdocs.yml").read_text(encoding="utf-8").partition("\nnav:\n")[2])
        notebook = pathlib.Path("docs/develop/notebook/README.md")
        contents += [str(path) for path, _ in site_source.links(notebook) if path.parent == notebook.parent]
        self.assertEqual(sorted(contents), sorted(map(str, site_source.pages())))

    def test_the_copy_for_the_site_has_what_pages_link_to(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, SOURCE / "tools/site_source.py", f"{folder}/source"], check=True)
            for page in site_source.pages():
                for path, _ in site_source.links(page):
                    self.assertTrue((pathlib.Path(folder) / "source" / path).is_file(), f"{page}: {path}")

    def test_what_is_a_link(self):
        text = "[a](b.md#c) `[no](no.md)` [`code`](d.md) and `other`\n```\n[no](no.md)\n```\n[`e`]: f.md\n"
        found = [match[1] or match[2] for match in site_source.LINK.finditer(site_source.prose(text))]
        self.assertEqual(found, ["b.md#c", "d.md", "f.md"])

    def test_names_of_headings(self):
        for heading, host, site in (("From t = 0 on", "from-t--0-on", "from-t-0-on"), ("What `holds` says", "what-holds-says", "what-holds-says"),
                                    ("Load, and μ", "load-and-μ", "load-and")):
            self.assertEqual(name_on_a_host(heading), host)
            self.assertEqual(name_on_the_site(heading), site)


if __name__ == "__main__":
    unittest.main()
