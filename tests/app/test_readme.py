"""The commands and snippets of README and of the first pages, run as they stand in a copy of the folders that they name."""
import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest

from cli import HOLDFAST, PATIENCE, SEED_LAYOUT, SOURCE, CliTest, layout_text, TOWER

NOT_HERE = ("make", "git", "sudo", "apt", "apt-get", "cd")  # what builds or installs


def blocks(document, *languages):
    """The fenced blocks of a document in one of the languages."""
    text = (SOURCE / document).read_text()
    found = re.findall(r"^```(\w+)[^\n]*\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    return [content for language, content in found if language in languages]


def indented_blocks(document):
    """What stands four spaces in, between lines that do not."""
    found = re.findall(r"(?:(?<=\n)    .*\n)+", (SOURCE / document).read_text())
    return [re.sub(r"^    ", "", content, flags=re.MULTILINE) for content in found]


def commands(document):
    """The command lines of its shell blocks; of a console block, those behind a prompt; and those above a table."""
    found = [content.splitlines()[0] for content in indented_blocks(document) if content.startswith("holdfast ")]
    for content in blocks(document, "sh", "bash", "shell"):
        found += content.replace("\\\n", " ").splitlines()
    for content in blocks(document, "console"):
        found += [line[2:] for line in content.replace("\\\n", " ").splitlines() if line.startswith("$ ")]
    return [line for line in (line.strip() for line in found)
            if line and not line.startswith("#") and shlex.split(line)[0] not in NOT_HERE]


# What a newcomer reads, in this order.
FIRST_PAGES = ["README.md", "docs/start/install.md", "docs/start/first_screening.md", "docs/start/loads.md"]

# What the snippets of README and docs leave to the reader.
AROUND = """
struct { void operator()(std::size_t) const {} } reject;
std::vector<holdfast::Layout> layouts;
std::vector<holdfast::Acceleration> accelerations;
std::vector<bool> holds;
std::vector<int> out_of_place;
"""
AROUND_C = """
static const double segments[5] = {0, 1, 1, 0, 0};
static holdfast_layouts layouts;
"""


class Snippets(CliTest):
    """C and C++ in README and docs compile as they stand, without a warning."""

    def compiled(self, compiler, name, text):
        self.write(name, text)
        done = subprocess.run([*compiler, "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", "-I", SOURCE / "include", name],
                              cwd=self.folder, text=True, capture_output=True, timeout=PATIENCE, check=False)
        self.assertEqual(done.returncode, 0, f"{text}\n{done.stderr}")

    def test_snippets_compile(self):
        count = 0
        for path in [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]:
            for content in blocks(path.relative_to(SOURCE), "cpp", "c++"):
                body = "".join(line for line in content.splitlines(True) if not line.startswith("#include"))
                self.compiled(["g++", "-std=c++20"], "snippet.cpp",
                              f"#include <holdfast/holdfast.hpp>\n#include <vector>\n{AROUND}\nvoid f() {{\n{body}\n}}\n")
                count += 1
            for content in blocks(path.relative_to(SOURCE), "c"):
                body = "".join(line for line in content.splitlines(True) if not line.startswith("#include"))
                self.compiled(["gcc", "-std=c11"], "snippet.c",
                              f"#include <holdfast/holdfast.h>\n#include <stdio.h>\n{AROUND_C}\nvoid f(void);\nvoid f(void) {{\n{body}\n}}\n")
                count += 1
        self.assertGreaterEqual(count, 3)

    def test_layouts_may_be_a_list(self):
        self.compiled(["g++", "-std=c++20"], "list.cpp", """#include <holdfast/holdfast.hpp>
void f(holdfast::Screen& screen, const holdfast::Layout& layout) {
  screen.evaluate({layout});
  screen.holds({layout, layout});
  screen.margins({layout});
  screen.indicators({layout});
}
""")


class Readme(CliTest):
    """A folder like that of the sources, with the program built and a small demo run."""

    def setUp(self):
        super().setUp()
        for name in ("configs", "examples"):
            shutil.copytree(SOURCE / name, self.folder / name)
        programs = self.folder / "build/release/bin"
        programs.mkdir(parents=True)
        (programs / "holdfast").symlink_to(HOLDFAST)
        self.environment = {**os.environ, "PATH": f"{programs}:/usr/bin:/bin"}
        # The README speaks of a container of this name.
        self.write("few/BR15_077_ep.txt", layout_text(TOWER))
        done = self.run_here("screen", "-c", "configs/demo.ini", "--layouts", "few", "configs/layouts/seed_example.txt",
                             "--accelerations", "configs/accelerations", "-o", "demo/results.h5", "--quiet")
        self.assert_exit(done, 0)

    def run_command(self, command):
        done = subprocess.run(command, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, text=True,
                              capture_output=True, timeout=PATIENCE, check=False)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}\n{done.stderr}")
        return done

    def test_the_demo_asks_nothing_marginal(self):
        """That its table is the one shown, tools/evidence.py checks."""
        command = re.search(r"^demo:.*\n\t@mkdir.*\n\t((?:.*\\\n)*.*)\n", (SOURCE / "Makefile").read_text(), re.MULTILINE).group(1)
        self.assertIn("-c configs/demo.ini", command)
        done = self.run_command(["bash", "-c", command.replace("\\\n", " ")])
        self.assertIn("layouts that", done.stdout)
        self.assertNotIn("marginal", done.stdout)

    def test_commands(self):
        for page in FIRST_PAGES:
            lines = commands(page)
            self.assertGreater(len(lines), 0, f"{page} shows no command")
            for results in self.folder.glob("*.h5"):
                results.unlink()  # of another page
            for line in lines:
                with self.subTest(page=page, command=line):
                    self.run_command(["bash", "-c", line])

    def test_shown_files_are_good(self):
        """One file to a block, of which each can be copied as it stands."""
        kinds = []
        for number, content in enumerate(indented_blocks("docs/start/first_screening.md")):
            if not re.match(r"3 boxes|#", content):
                continue
            self.write(f"shown_{number}.txt", content)
            kinds += re.findall(r": ok: (\w+)", self.run_command(["holdfast", "check", f"shown_{number}.txt"]).stdout)
        self.assertEqual(kinds, ["layout", "acceleration"])

    def test_packages_of_python_snippets_are_named(self):
        page, tools = ((SOURCE / name).read_text() for name in ("docs/start/first_screening.md", "tools/install_dependencies.sh"))
        for snippet in blocks("docs/start/first_screening.md", "python"):
            for module in set(re.findall(r"^import (\w+)", snippet, re.MULTILINE)) & {"h5py", "pandas", "matplotlib"}:
                self.assertRegex(page, rf"apt install[^`]* python3-{module}\b")
                self.assertIn(f"  python3-{module} ", tools)

    def test_examples_of_the_help_pages(self):
        for layout in (self.folder / "configs/layouts").iterdir():
            if layout.name != "seed_example.txt":
                layout.unlink()  # one layout is enough
        for command in ("", "screen", "summary", "run", "check", "bench", "engines", "norms"):  # validate takes minutes
            page = self.run_command(["bash", "-c", f"holdfast {command} --help"]).stdout
            examples = re.findall(r"^  (holdfast .*)", page[page.index("\nExample:\n"):], re.MULTILINE)
            self.assertGreater(len(examples), 0, command)
            for example in examples:
                with self.subTest(example=example):
                    if "-o results.h5" in example:
                        (self.folder / "results.h5").unlink(missing_ok=True)
                    self.run_command(["bash", "-c", example])

    def test_python_snippets(self):
        shutil.copy(self.folder / "demo/results.h5", self.folder / "mine.h5")
        snippets = blocks("docs/start/first_screening.md", "python")
        self.assertGreater(len(snippets), 0, "the page shows no Python")
        for snippet in snippets:
            with self.subTest(snippet=snippet):
                self.run_command([sys.executable, "-c", snippet])

    def test_python_snippets_about_the_results_file(self):
        shutil.copy(self.folder / "demo/results.h5", self.folder / "results.h5")
        snippets = blocks("docs/reference/results_file.md", "python")
        self.assertGreater(len(snippets), 0)
        for snippet in snippets:
            with self.subTest(snippet=snippet):
                self.run_command([sys.executable, "-c", snippet])

    def test_examples(self):
        done = self.run_command([sys.executable, "examples/summary_table.py", "demo/results.h5", "--csv", "table.csv"])
        self.assertIn("seed_example.txt", done.stdout)
        self.assertTrue((self.folder / "table.csv").exists())
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("no matplotlib")
        self.run_command([sys.executable, "examples/plot_box.py", "demo/results.h5", "-o", "box.png"])
        self.assertGreater((self.folder / "box.png").stat().st_size, 1000)
        self.run_command([sys.executable, "examples/plot_verdicts.py", "-o", "verdicts.svg"])
        self.assertIn("MoveThreshold", (self.folder / "verdicts.svg").read_text())


class Checkout(CliTest):
    """Commands of all pages leave nothing in a checkout that git does not ignore."""

    def setUp(self):
        super().setUp()
        for name in ("configs", "bench/layouts"):
            shutil.copytree(SOURCE / name, self.folder / name)
        for name in ("configs/layouts", "bench/layouts"):  # one layout is enough
            for layout in (self.folder / name).iterdir():
                layout.unlink()
            self.write(f"{name}/seed_example.txt", SEED_LAYOUT.read_text())
        shutil.copytree(self.folder / "configs/layouts", self.folder / "layouts")  # the reader's own
        shutil.copy(SOURCE / ".gitignore", self.folder)
        self.git("init", "--quiet")
        self.git("add", ".")
        self.git("-c", "user.name=a", "-c", "user.email=a@b", "commit", "--quiet", "--message=all")

    def git(self, *words):
        return subprocess.run(["git", *words], cwd=self.folder, text=True, capture_output=True, timeout=PATIENCE, check=True).stdout

    def pages(self):
        return [path.relative_to(SOURCE) for path in (SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md")))]

    def command_lines(self, page):
        """Of fenced and of indented blocks."""
        text = "\n".join([*blocks(page, "sh"), *indented_blocks(page)]).replace("\\\n", " ")
        return [line.split("#")[0].strip() for line in text.splitlines()]

    @unittest.skipUnless(shutil.which("git"), "without git")
    def test_commands_leave_nothing(self):
        count = 0
        for page in self.pages():
            for line in self.command_lines(page):
                # Those that take minutes, a device, other layouts, a browser, or the results of a run that is not repeated here.
                if not re.match(r"holdfast (screen|margins|merge|report)", line) or re.search(r"opencl|demo/results|seed_example|mine\.h5", line):
                    continue
                with self.subTest(page=page, command=line):
                    overwrite = "" if re.search("merge|report|--part", line) else " --overwrite"
                    done = self.run_here(*shlex.split(line)[1:], *overwrite.split())
                    if "report.pdf" not in line:  # takes WeasyPrint
                        self.assertIn(done.returncode, (0, 1), f"{line}\n{done.stderr}")
                    self.assertEqual(self.git("status", "--porcelain"), "")
                    count += 1
        self.assertGreater(count, 5)

    @unittest.skipUnless(shutil.which("git"), "without git")
    def test_what_commands_write_is_ignored(self):
        """Also what takes too long to be run here."""
        count = 0
        for page in self.pages():
            for line in self.command_lines(page):
                for path in re.findall(r"(?:-o|--output|--out|--csv|--json|--keep|>) +([\w./]+)", line):
                    with self.subTest(page=page, command=line):
                        ignored = subprocess.run(["git", "check-ignore", "--no-index", path], cwd=self.folder, capture_output=True,
                                                 check=False)
                        self.assertEqual(ignored.returncode, 0, path)
                        count += 1
        self.assertGreater(count, 10)


if __name__ == "__main__":
    unittest.main()
