"""The installed package from outside: another project finds the library, builds against it, and gets the bits that the
program gets."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["HOLDFAST_BUILD"])
ACCELERATION = SOURCE / "configs/accelerations/road_brake_0g8.txt"
LAYOUTS = sorted((SOURCE / "configs/layouts").glob("*.txt"))

# Prints, by the C interface, for each engine of Bullet what keeps it from being made.
ENGINES_OF_LIBRARY = """
import ctypes, sys
from ctypes import byref, c_char_p, c_int32, c_size_t, c_void_p

class Options(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("engine", c_char_p)]

library = ctypes.CDLL(sys.argv[1])
library.holdfast_screen_message.restype = c_char_p
for name in ("bullet", "bullet-f64", "bullet-stock"):
    screen = c_void_p()
    library.holdfast_screen_new(None, byref(Options(ctypes.sizeof(Options), name.encode())), byref(screen))
    print(name, library.holdfast_screen_message(screen).decode() or "is there")
"""


def done(*words, **options):
    """Output of a command that must succeed."""
    result = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if result.returncode != 0:
        raise AssertionError(f"{words}\n{result.stdout}{result.stderr}")
    return result.stdout


class InstalledTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="holdfast_embed_"))
        cls.prefix = cls.folder / "prefix"
        done("cmake", "--install", BUILD, "--prefix", cls.prefix)
        cls.library = next(cls.prefix.rglob("libholdfast.so")).parent

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def screened(self):
        """Verdicts and hashes by the installed program."""
        lines = done(self.prefix / "bin/holdfast", "screen", "--quiet", "--json", "--accuracy", "screening", "--no-series",
                     "--layouts", *LAYOUTS, "--accelerations", ACCELERATION, "-o", "results.h5", "--overwrite",
                     cwd=self.folder).splitlines()
        worlds = map(json.loads, lines)
        return [f"{w['layout']} {w['acceleration']} {w['verdict']} {w['state_hash']}" for w in worlds]

    def test_an_embedding_project_gets_the_bits_of_the_program(self):
        build = self.folder / "embed"
        done("cmake", "-S", SOURCE / "examples/embed", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        done("cmake", "--build", build)
        self.assertEqual(done(build / "embed", ACCELERATION, *LAYOUTS).splitlines(), self.screened())
        # The box slides against friction of 0.5 under 7 m/s² for a second: x = 2.25 - 0.5 (7 - 0.5 * 9.81).
        self.assertIn("1.00 s: x = 1.2025 m", done(build / "replay").splitlines())
        self.check_plain(build / "plain")

    def test_the_search_example_finds_the_package(self):
        done("cmake", "-S", SOURCE / "examples/search", "-B", self.folder / "search", f"-DCMAKE_PREFIX_PATH={self.prefix}")

    def check_plain(self, program):
        """The example of the C interface: the world of a screen, and the same in pieces, end with the same bits."""
        lines = done(program).splitlines()
        self.assertEqual(lines[0], f"stayed moved {lines[-1]}")
        self.assertIn("1.00 s: x = 1.2025 m", lines)

    def flags_of(self, library, **environment):
        """What pkg-config says of the package below a folder of libraries, which must name folders that are there."""
        environment = {**os.environ, "PKG_CONFIG_LIBDIR": str(library / "pkgconfig"), **environment}
        flags = done("pkg-config", "--cflags", "--libs", "holdfast", env=environment).split()
        include, folder = [pathlib.Path(flag[2:]) for flag in flags if flag.startswith(("-I", "-L"))]
        self.assertTrue((include / "holdfast/holdfast.h").exists(), flags)
        self.assertTrue((folder / "libholdfast.so").exists(), flags)
        return flags

    def test_pkg_config_tells_how_to_build(self):
        flags = self.flags_of(self.library)
        program = self.folder / "embed_by_pkg_config"
        done("c++", "-std=c++20", SOURCE / "examples/embed/main.cpp", *flags, f"-Wl,-rpath,{self.library}", "-o", program)
        self.assertEqual(len(done(program, ACCELERATION, LAYOUTS[0]).splitlines()), 1)
        plain = self.folder / "plain_by_pkg_config"
        done("cc", "-std=c11", "-pedantic", "-Wall", "-Wextra", "-Werror", SOURCE / "examples/embed/plain.c", *flags,
             f"-Wl,-rpath,{self.library}", "-o", plain)
        self.check_plain(plain)

    def test_the_packages_have_all_that_the_program_shares(self):
        patterns = [line for file in (SOURCE / "debian").glob("*.install") for line in file.read_text().split()]
        shared = sorted((self.prefix / "share/holdfast").iterdir())
        self.assertIn("load_report.css", [path.name for path in shared])
        for path in shared:
            self.assertTrue(any(pathlib.PurePath("usr/share/holdfast", path.name).match(pattern) for pattern in patterns), path)

    def test_pkg_config_finds_the_package_wherever_it_lies(self):
        stage = self.folder / "stage"
        done("cmake", "--install", BUILD, "--prefix", "/usr", env={**os.environ, "DESTDIR": str(stage)})
        self.flags_of(stage / "usr" / self.library.relative_to(self.prefix))
        shutil.move(stage / "usr", self.folder / "moved")
        library = self.folder / "moved" / self.library.relative_to(self.prefix)
        self.flags_of(library)
        # As where packages for another machine are put together.
        self.flags_of(library, PKG_CONFIG_SYSROOT_DIR=str(self.folder))

    def test_pkg_config_follows_the_folder_of_libraries(self):
        build, prefix = self.folder / "elsewhere", self.folder / "deep"
        done("cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DBUILD_TESTING=OFF", "-DCMAKE_INSTALL_LIBDIR=lib/one/two")
        library = prefix / "lib/one/two"
        (library / "pkgconfig").mkdir(parents=True)
        shutil.copy(build / "holdfast.pc", library / "pkgconfig")
        (library / "libholdfast.so").touch()
        shutil.copytree(SOURCE / "include", prefix / "include")
        self.flags_of(library)

    def test_a_build_of_the_program_alone_says_what_to_build(self):
        """`make demo` builds no library: what installs must say so, and how the program is installed."""
        build = self.folder / "program"
        for script in BUILD.rglob("cmake_install.cmake"):
            copy = build / script.relative_to(BUILD)
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_text(script.read_text().replace(str(BUILD), str(build)))
        refused = subprocess.run(["cmake", "--install", build, "--prefix", self.folder / "none", "--component", "program"],
                                 capture_output=True, text=True, check=False)
        self.assertIn(f"cmake --build {build} --target holdfast", refused.stderr)
        for name in ("bin/holdfast", "holdfast.1", "holdfast.bash"):
            (build / name).parent.mkdir(exist_ok=True)
            shutil.copy(BUILD / name, build / name)
        shutil.copytree(BUILD / "share", build / "share", symlinks=True)
        refused = subprocess.run(["cmake", "--install", build, "--prefix", self.folder / "all"], capture_output=True, text=True,
                                 check=False)
        self.assertNotEqual(refused.returncode, 0)
        self.assertNotIn("cannot find", refused.stderr)
        for command in (f"cmake --build {build}", f"cmake --install {build} --component program"):
            self.assertIn(command, [line.strip() for line in refused.stderr.splitlines()])
        done("cmake", "--install", build, "--component", "program", "--prefix", self.folder / "alone")
        self.assertIn("native ", done(self.folder / "alone/bin/holdfast", "engines"))

    def test_a_project_of_c_alone_finds_the_package(self):
        folder = self.folder / "c_alone"
        folder.mkdir()
        (folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.22)\nproject(alone LANGUAGES C)\nfind_package(holdfast 2.0 REQUIRED)\n"
            f"add_executable(plain {SOURCE}/examples/embed/plain.c)\n"
            "target_link_libraries(plain PRIVATE holdfast::holdfast)\n")
        done("cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        done("cmake", "--build", folder / "build")
        self.check_plain(folder / "build/plain")

    def test_only_the_public_headers_are_installed(self):
        headers = [path.name for path in (self.prefix / "include").rglob("*") if path.is_file()]
        self.assertEqual(sorted(headers), ["holdfast.h", "holdfast.hpp", "outcome_fields.h", "outcomes.hpp"])

    def assert_finds_engines(self, *words):
        """The output has a line for each engine of Bullet, and misses none."""
        listed = done(*words).splitlines()
        for name in ("bullet", "bullet-f64", "bullet-stock"):
            line = next(line for line in listed if line.split()[0] == name)
            self.assertNotIn("missing", line)
            self.assertNotIn("plug-in", line)

    def test_plugins_have_a_folder_of_their_own(self):
        self.assertEqual({path.name for path in self.library.glob("libholdfast*")} -
                         {path.name for path in self.library.glob("libholdfast.so*")}, {"libholdfast-core.a"})
        plugins = sorted((self.library / "holdfast").glob("*/libholdfast-*.so"))
        self.assertLessEqual({"libholdfast-bullet.so", "libholdfast-bullet-f64.so"}, {path.name for path in plugins})
        of_library = (sys.executable, "-c", ENGINES_OF_LIBRARY, self.library / "libholdfast.so")
        self.assert_finds_engines(self.prefix / "bin/holdfast", "engines")
        self.assert_finds_engines(*of_library)
        # All in one folder, as in a Python package, they are found too.
        for plugin in plugins:
            self.addCleanup(shutil.move, self.library / plugin.name, plugin)
            shutil.move(plugin, self.library)
        self.assert_finds_engines(*of_library)
        self.assertIn("missing", done(self.prefix / "bin/holdfast", "engines"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
