"""The manual page, the page of commands and the completion of bash: all commands and options, from the program's own table."""
import re
import shutil
import subprocess
import sys
import unittest

from cli import HOLDFAST, SOURCE, CliTest, run, schedulers


class Pages(CliTest):
    def setUp(self):
        super().setUp()
        self.commands = re.findall(r"^  ([a-z]+) {2,}", run("--help").stdout.split("Subcommands:")[1], re.MULTILINE)
        self.assertIn("screen", self.commands)
        self.options = {command: set(re.findall(r"^  (?:-\w,)?(--[a-z-]+)", run(command, "--help").stdout, re.MULTILINE))
                        for command in self.commands}
        self.assertIn("--accuracy", self.options["screen"])

    def test_the_manual_page_has_every_command_and_option(self):
        page = run("--man-page").stdout.replace("\\-", "-")
        sections = dict(re.findall(r"\.SS holdfast (\w+)\n(.*?)(?=\.SS|\.SH)", page, re.DOTALL))
        self.assertEqual(set(sections), set(self.commands))
        for command, options in self.options.items():
            named = set(re.findall(r"--[a-z-]+", "\n".join(re.findall(r"^\.B (.*)", sections[command], re.MULTILINE))))
            self.assertEqual(named, options, command)

    def test_the_page_of_commands_is_up_to_date(self):
        made = subprocess.run([sys.executable, SOURCE / "tools/commands_page.py", HOLDFAST], capture_output=True, text=True, check=True)
        page = (SOURCE / "docs/reference/commands.md").read_text(encoding="utf-8")
        self.assertTrue(made.stdout == page, "docs/reference/commands.md differs from the program; run: make docs")

    def test_the_page_of_containers_is_up_to_date(self):
        page = (SOURCE / "docs/reference/containers.md").read_text(encoding="utf-8")
        self.assertTrue(run("--containers-page").stdout == page, "docs/reference/containers.md differs from the program; run: make docs")

    def test_the_page_of_commands_has_every_command_and_option(self):
        page = (SOURCE / "docs/reference/commands.md").read_text(encoding="utf-8")
        sections = dict(re.findall(r"^## holdfast (\w+)\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL))
        self.assertEqual(set(sections), set(self.commands))
        for command, options in self.options.items():
            self.assertEqual(set(re.findall(r"^\| `(?:-\w,)?(--[a-z-]+)", sections[command], re.MULTILINE)), options, command)

    @unittest.skipUnless(shutil.which("groff"), "without groff")
    def test_groff_has_nothing_to_say_about_it(self):
        done = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z"], input=run("--man-page").stdout, capture_output=True, text=True,
                              check=True)
        self.assertEqual(done.stderr, "")

    def complete(self, *words):
        """What bash offers for the last word."""
        script = self.write("completion.bash", run("--bash-completion").stdout)
        line = " ".join(f"'{word}'" for word in ("holdfast", *words))
        command = f"source {script}; COMP_WORDS=({line}); COMP_CWORD={len(words)}; _holdfast; printf '%s\\n' \"${{COMPREPLY[@]}}\""
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        return set(done.stdout.split())

    def test_bash_completes_values(self):
        engines = {line.split()[0] for line in run("engines").stdout.splitlines() if not line.startswith(" ")}
        self.assertEqual(self.complete("screen", "--engine", ""), engines)
        self.assertEqual(self.complete("screen", "--engine", "nat"), {"native", "native-plain"})
        self.assertEqual(self.complete("screen", "--engine", "=", "nat"), {"native", "native-plain"})
        self.assertEqual(self.complete("bench", "--engine", "native", "bullet-s"), {"bullet-stock"})
        self.assertEqual(self.complete("screen", "--accuracy", ""), {"screening", "standard", "reference"})
        norms = set(re.findall(r"^([a-z][\w-]*:?)K?$", run("norms").stdout, re.MULTILINE))
        self.assertIn("road", norms)
        self.assertEqual(self.complete("margins", "--norm", ""), norms)
        self.assertEqual(self.complete("run", "--walls", "en"), {"en12642-l", "en12642-xl", "en283"})
        self.assertEqual(self.complete("screen", "--stop-when", ""), {"end", "moved", "fallen"})
        self.assertEqual(self.complete("screen", "--scheduler", ""), set(schedulers()))
        self.assertEqual(self.complete("validate", "--suite", "ti"), {"tip"})
        self.assertEqual(self.complete("validate", "--suite", "tip,re"), {"tip,rebound"})
        self.assertIn("real_loads", self.complete("validate", "--case", ""))

    def test_what_bash_offers_is_accepted(self):
        """Each value of the options that a run checks before anything else."""
        for option in ("--engine", "--accuracy", "--norm", "--walls", "--stop-when", "--scheduler"):
            for value in self.complete("screen", option, ""):
                value += "0.5" if value.endswith(":") else ""
                done = self.run_here("screen", option, value, "--layouts", "none", "--accelerations", "none")
                self.assertIn("no such file", done.stderr, (option, value))

    def test_every_option_with_a_name_has_values(self):
        for command in self.commands:
            for option in re.findall(r"(--[a-z-]+) NAME", run(command, "--help").stdout):
                self.assertNotEqual(self.complete(command, option, ""), set(), f"{command} {option}")

    def test_bash_offers_files_where_files_are_meant(self):
        self.write("results.h5", "")
        self.write("results/one.txt", "")
        for words in (("view", ""), ("screen", "-c", ""), ("screen", "--layouts", ""), ("screen", "--layouts", "results.h5", ""),
                      ("check", "--config", "a.ini", ""), ("merge", "--overwrite", "")):
            self.assertEqual(self.complete(*words), {"completion.bash", "results", "results.h5"}, words)
        self.assertEqual(self.complete("summary", "--csv", ""), {"results"})
        self.assertEqual(self.complete("screen", "--threads", ""), set())
        # These take options alone.
        self.assertEqual(self.complete("engines", ""), self.options["engines"])
        self.assertIn("--norm", self.complete("screen", ""))

    def test_bash_completes_commands_options_and_files(self):
        self.assertEqual(self.complete("scr"), {"screen"})
        self.assertEqual(self.complete(""), set(self.commands))
        self.assertEqual(self.complete("screen", "--acc"), {"--accelerations", "--accuracy"})
        for command, options in self.options.items():
            self.assertEqual(self.complete(command, "--"), options, command)
        self.write("results.h5", "")
        self.assertEqual(self.complete("view", "res"), {"results.h5"})


if __name__ == "__main__":
    unittest.main()
