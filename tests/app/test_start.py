"""What the program loads when it starts: no plug-in that was not asked for, and no client for the web."""
import os
import unittest

from cli import CliTest


class Start(CliTest):
    def loaded(self, *arguments):
        """Names of all libraries that a run initialises, as the loader tells them."""
        done = self.run_here(*arguments, env={**os.environ, "LD_DEBUG": "libs"})
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        return {line.rsplit("/", 1)[-1] for line in done.stderr.splitlines() if "calling init: " in line}

    def test_a_plug_in_is_loaded_when_its_engine_is_asked_for(self):
        self.write_inputs()
        self.write("none.ini", "")
        words = ("screen", "-c", "none.ini", "--layouts", "seed.txt", "--accelerations", "rest.txt", "--quiet", "--overwrite")
        native = self.loaded(*words)
        bullet = self.loaded(*words, "--engine", "bullet")
        self.assertEqual({name for name in native if "holdfast" in name or "Bullet" in name}, set())
        self.assertIn("libholdfast-bullet.so", bullet)
        self.assertNotIn("libholdfast-bullet-opencl.so", bullet)

    def test_the_results_file_draws_in_no_client_for_the_web(self):
        loaded = self.loaded("--version")
        self.assertIn("libc.so.6", loaded)
        if any(name.startswith("libhdf5") for name in loaded):
            self.skipTest("built with the shared HDF5")
        self.assertEqual({name for name in loaded if name.startswith(("libcurl", "libssl", "libldap", "libkrb5"))}, set())


if __name__ == "__main__":
    unittest.main()
