"""Engines that are not built: the program says what builds them."""
import shutil
import unittest

from cli import HOLDFAST, SEED_ACCELERATION, SEED_LAYOUT, SOURCE, CliTest, run

COMMAND = "cmake --build build/release --target holdfast_plugins"


class WithoutPlugins(CliTest):
    def setUp(self):
        super().setUp()
        # As after `make demo`: the program looks beside itself.
        self.program = self.folder / "bin/holdfast"
        self.program.parent.mkdir()
        shutil.copy(HOLDFAST, self.program)

    def test_engines_says_what_builds_them(self):
        done = run("engines", program=self.program)
        self.assert_exit(done, 0)
        lines = {line.split()[0]: line for line in done.stdout.splitlines()}
        for name in ("bullet", "bullet-f64", "bullet-stock", "bullet-opencl"):
            self.assertIn("missing: ", lines[name])
            self.assertIn(COMMAND, lines[name])
        for name in ("native", "native-plain"):
            self.assertNotIn("missing", lines[name])

    def test_a_run_says_what_builds_its_engine(self):
        done = run("screen", "--engine", "bullet", "--layouts", SEED_LAYOUT, "--accelerations", SEED_ACCELERATION, "-o",
                   self.folder / "results.h5", program=self.program)
        self.assert_refused(done, "libholdfast-bullet.so", COMMAND)
        self.assertFalse((self.folder / "results.h5").exists())

    def test_check_warns_of_it_and_checks_the_files(self):
        config = self.write("bullet.ini", "[Screening]\nEngine = bullet\n")
        for words in ([config], [SEED_LAYOUT, "-c", config]):
            done = run("check", *words, program=self.program)
            self.assert_exit(done, 0)
            self.assertIn(": ok: ", done.stdout)
            self.assertTrue(done.stderr.startswith(f"warning: {config}: "), done.stderr)
            self.assertIn(COMMAND, done.stderr)

    def test_the_command_names_a_target(self):
        self.assertIn(f"add_custom_target({COMMAND.split()[-1]} ", (SOURCE / "CMakeLists.txt").read_text())
        self.assertIn(COMMAND, (SOURCE / "docs/start/install.md").read_text())


if __name__ == "__main__":
    unittest.main()
