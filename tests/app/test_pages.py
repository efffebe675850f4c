"""The manual page and the completion of bash: all commands and options, from the program's own table."""
import re
import shutil
import subprocess
import unittest

from cli import CliTest, run


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
