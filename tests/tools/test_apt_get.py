"""The scripts that install packages wait until another package manager is done, and end when something else is wrong."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"

# Programs in the place of those of the system: apt-get does what a file of answers says, one line a call.
APT_GET = """#!/bin/bash
echo "$*" >> "$HOLDFAST_TEST/calls"
answer=$(head -1 "$HOLDFAST_TEST/answers")
sed -i 1d "$HOLDFAST_TEST/answers"
[[ -z $answer ]] || { echo "$answer" >&2; exit 100; }
"""
SUDO = '#!/bin/bash\nexec "$@"\n'
NOTHING = "#!/bin/bash\n"
LOCKED = "E: Could not get lock /var/lib/apt/lists/lock. It is held by process 7 (apt-get)"


class AptGet(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        # dpkg-query knows no package, so that all of them are missing.
        for name, text in (("apt-get", APT_GET), ("sudo", SUDO), ("sleep", NOTHING), ("dpkg-query", NOTHING)):
            (self.folder / name).write_text(text)
            (self.folder / name).chmod(0o755)

    def run_tool(self, name, *arguments, answers=""):
        (self.folder / "answers").write_text(answers)
        environment = {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}", "HOLDFAST_TEST": str(self.folder)}
        done = subprocess.run([TOOLS / name, *arguments], env=environment, capture_output=True, text=True, timeout=60, check=False)
        return done, (self.folder / "calls").read_text().splitlines()

    def test_dependencies_wait_for_every_lock(self):
        done, calls = self.run_tool("install_dependencies.sh", answers=f"{LOCKED}\n{LOCKED}\n\n{LOCKED}\n\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(["update" in call for call in calls], [True, True, True, False, False])
        for call in calls:
            self.assertRegex(call, r"-o DPkg::Lock::Timeout=\d{2,}")
        self.assertEqual(done.stderr, "Waiting until another package manager is done\n" * 2)

    def test_another_error_ends_it_and_is_shown(self):
        done, calls = self.run_tool("apt_get.sh", "install", "nothing", answers="E: Unable to locate package nothing\n")
        self.assertEqual((done.returncode, len(calls)), (100, 1))
        self.assertEqual(done.stderr, "E: Unable to locate package nothing\n")

    def test_no_script_calls_apt_get_itself(self):
        for script in TOOLS.glob("*.sh"):
            if script.name == "apt_get.sh":
                continue
            for line in script.read_text().splitlines():
                # In a system of its own, which a chroot is, nothing else installs.
                code = re.sub(r"^\s*inside .*|#.*|command -v apt-get", "", line)
                self.assertNotIn("apt-get", code, script.name)


if __name__ == "__main__":
    unittest.main()
