"""docs/physics/parameters.md: every number of the native engine, from its sources and the program; and who speaks of them."""
import json
import re
import subprocess
import sys
import unittest

from cli import HOLDFAST, SOURCE, CliTest, run

PAGE = SOURCE / "docs/physics/parameters.md"
NATIVE = SOURCE / "src/core/native"
DOCUMENTS = [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]


def power_of_ten(number):
    """10⁻⁴ for 1e-4, as the guide writes it."""
    mantissa, exponent = f"{number:e}".split("e")
    assert float(mantissa) == 1.0, number
    return "10" + str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


class Parameters(CliTest):
    def setUp(self):
        super().setUp()
        self.page = PAGE.read_text()
        self.anchors = re.findall(r'^\| <a id="(\w+)"></a>`\w+` \|', self.page, re.MULTILINE)
        self.names = re.findall(r'^\| <a id="\w+"></a>`(\w+)` \|', self.page, re.MULTILINE)
        self.accuracies = json.loads(run("--accuracies").stdout)

    def test_the_page_is_up_to_date(self):
        made = subprocess.run([sys.executable, SOURCE / "tools/parameters_page.py", HOLDFAST], capture_output=True, text=True, check=True)
        self.assertTrue(made.stdout == self.page, "docs/physics/parameters.md differs from the engine; run: make docs")

    def test_it_has_every_constant_and_every_option_once(self):
        constants = re.findall(r"constexpr[^=;]*\b(k[A-Z]\w*)", (NATIVE / "constants.hpp").read_text())
        self.assertGreater(len(constants), 50)
        options = [*self.accuracies["standard"], *self.accuracies["standard"]["small_island"]]
        options = [name for name in options if name not in ("small_island", "large_island")]
        for name in constants + options:
            self.assertEqual(self.names.count(name), 1, name)
        self.assertEqual(self.anchors, [name.lower() for name in self.names])

    def test_every_constant_with_a_measured_effect_is_in_it(self):
        for path in (SOURCE / "src/core").rglob("*.[ch]pp"):
            for comment, name in re.findall(r"((?:^\s*///.*\n)+).*?\b(k[A-Z]\w*) =", path.read_text(), re.MULTILINE):
                if "@measured" in comment:
                    self.assertIn(name, self.names, path)

    def test_documents_name_only_what_is_there(self):
        for path in DOCUMENTS:
            text = path.read_text()
            for name in re.findall(r"\bk[A-Z][a-z]\w*\b", text):
                self.assertIn(name, self.names, path)
            for anchor in re.findall(r"parameters\.md#(\w+)", text):
                self.assertTrue(anchor in self.anchors or re.search(rf"^#+ {anchor}$", self.page, re.MULTILINE | re.IGNORECASE),
                                f"{path}: {anchor}")

    def test_names_in_the_pages_about_physics_are_links(self):
        for name in ("model", "method", "limits"):
            with self.subTest(page=name):
                self.names_are_links((SOURCE / f"docs/physics/{name}.md").read_text())

    def names_are_links(self, text):
        defined = re.findall(r"^\[`(\w+)`\]: parameters\.md#(\w+)$", text, re.MULTILINE)
        linked = set(re.findall(r"\[`(\w+)`\](?![(:])", text))
        self.assertEqual(sorted(linked), sorted(name for name, _ in defined))
        self.assertEqual([name.lower() for name, _ in defined], [anchor for _, anchor in defined])
        self.assertEqual(re.findall(r"(?<!\[)`k[A-Z]\w*`", text), [])

    def test_the_table_of_accuracies(self):
        large = re.search(r"Islands of more than (\d+) bodies", self.page)[1]
        for name, options in self.accuracies.items():
            small, larger = (options[island]["tolerance"] for island in ("small_island", "large_island"))
            tolerance = power_of_ten(small)
            if larger != small:
                tolerance += f"; {power_of_ten(larger)} for islands of more than {large} boxes"
            row = rf"^\| `{name}`[^|]*\| 1/{options['steps_per_second']:g} s \| {tolerance} \|"
            self.assertRegex((SOURCE / "docs/guide/accuracy.md").read_text(), re.compile(row, re.MULTILINE))


if __name__ == "__main__":
    unittest.main()
