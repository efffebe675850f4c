"""Builds the Python package by CMake: the compiled module, the library and the engines that are plug-ins.

The environment variable HOLDFAST_BUILD names a build folder that is configured with -DHOLDFAST_PYTHON=ON already, such as
that of `make python`: then its results are taken.
"""
import os
import pathlib
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent


def version():
    """That of CMakeLists.txt, the one place where it is."""
    return re.search(r"project\(holdfast VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


def run(*words):
    subprocess.run([str(word) for word in words], check=True)


def jobs():
    """Compilers that may run at once."""
    return subprocess.run([SOURCE / "tools/job_count.sh"], check=True, capture_output=True, text=True).stdout.strip()


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        given = os.environ.get("HOLDFAST_BUILD")
        build = pathlib.Path(given or self.build_temp).resolve()
        if not given:
            run("cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF",
                "-DHOLDFAST_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}")
        run("cmake", "--build", build, "-j", jobs(), "--target", "holdfast_python", "holdfast_plugins")
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        run("cmake", "--install", build, "--component", "python", "--prefix", target)
        # The Debian packages are built with symbols for debuggers, which make a wheel fifteen times as large.
        run("strip", *target.glob("*.so*"))


setup(version=version(), ext_modules=[Extension("holdfast._core", [])], cmdclass={"build_ext": CMakeBuild})
