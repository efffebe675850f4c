"""The package among those that its users have: pandas, DEAP, process pools, type checkers, doctest, pip."""
import concurrent.futures
import doctest
import importlib
import multiprocessing
import os
import pathlib
import pkgutil
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import pandas as pd

import holdfast
from samples import BOX, REST, SLIDE, SOURCE, STACK, main

PACKAGE = pathlib.Path(holdfast.__file__).parent


def hashes_in_worker(screen, layouts):
    return screen.evaluate(layouts).state_hash


class PandasTest(unittest.TestCase):
    def test_verdicts_are_a_data_frame(self):
        with holdfast.Screen([holdfast.Acceleration("brake", SLIDE), holdfast.Acceleration("rest", REST)]) as screen:
            verdicts = screen.evaluate([BOX, STACK], names=["box", "stack"])
            unnamed = screen.evaluate([BOX]).frame()
        frame = verdicts.frame()
        table = pd.crosstab(frame["acceleration"], frame["verdict"])
        self.assertEqual(table.loc["brake", "moved"], 2)
        self.assertEqual(table.loc["rest", "stayed"], 2)
        self.assertEqual(frame.set_index(["name", "acceleration"]).loc[("stack", "rest"), "boxes"], 2)
        self.assertNotIn("name", unnamed)
        self.assertEqual(len(pd.DataFrame(verdicts.table.ravel())), 4)

    def test_a_data_frame_is_a_layout(self):
        frame = pd.DataFrame(STACK, columns=["x0", "y0", "z0", "x1", "y1", "z1", "material"]).astype({"material": int})
        with holdfast.Screen([SLIDE]) as screen:
            np.testing.assert_array_equal(screen.evaluate([frame]).state_hash, screen.evaluate([STACK]).state_hash)


class DeapTest(unittest.TestCase):
    def test_a_population_is_evaluated_in_one_call(self):
        from deap import algorithms, base, creator, tools

        creator.create("Fitness", base.Fitness, weights=(1.0,))
        creator.create("Individual", list, fitness=creator.Fitness)
        random.seed(1)
        toolbox = base.Toolbox()
        toolbox.register("individual", tools.initRepeat, creator.Individual, random.random, 3)
        toolbox.register("population", tools.initRepeat, list, toolbox.individual)
        toolbox.register("mate", tools.cxTwoPoint)
        toolbox.register("mutate", tools.mutGaussian, mu=0.0, sigma=0.2, indpb=0.5)
        toolbox.register("select", tools.selTournament, tournsize=3)

        def decode(keys):
            """A pile of three boxes, each as wide as its key says: what leans too far out falls."""
            widths = 0.3 + 0.5 * np.clip(keys, 0.0, 1.0)
            return np.array([[0.0, 0.0, 0.4 * i, 1.0, width, 0.4 * (i + 1), 1.0] for i, width in enumerate(widths)])

        with holdfast.Screen([[[0.0, 0.5, 0.0, 5.5, 0.0]]], accuracy="screening") as screen:
            calls = []

            def evaluate_all(_, population):
                population = list(population)
                calls.append(len(population))
                layouts = [decode(one) for one in population]
                holds = screen.holds(layouts)
                return [(float(sum(layout[:, 4]) * held),) for layout, held in zip(layouts, holds)]

            toolbox.register("evaluate", decode)
            toolbox.register("map", evaluate_all)
            population, _ = algorithms.eaSimple(toolbox.population(12), toolbox, 0.5, 0.5, 4, verbose=False)
        self.assertGreaterEqual(len(calls), 4)
        self.assertTrue(all(one.fitness.valid for one in population))


class ProcessPoolTest(unittest.TestCase):
    def test_a_screen_goes_to_the_processes_of_a_pool(self):
        layouts = [BOX, STACK]
        with holdfast.Screen([SLIDE, REST], accuracy="screening", threads=2) as screen:
            expected = screen.evaluate(layouts).state_hash
            for method in ("fork", "spawn"):
                context = multiprocessing.get_context(method)
                with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
                    for found in pool.map(hashes_in_worker, [screen] * 4, [layouts] * 4):
                        np.testing.assert_array_equal(found, expected)
                    with self.assertRaisesRegex(holdfast.Error, "of box 1") as caught:
                        pool.submit(hashes_in_worker, screen, [BOX, -BOX]).result()
                    self.assertEqual(caught.exception.layout, 1)


class ToolsTest(unittest.TestCase):
    def done(self, *words, **options):
        result = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def test_the_examples_of_the_documentation_run(self):
        names = ["holdfast"] + [f"holdfast.{module.name}" for module in pkgutil.iter_modules([str(PACKAGE)])]
        tried = 0
        for name in names:
            module = importlib.import_module(name)
            if hasattr(module, "__file__") and module.__file__.endswith(".py"):
                result = doctest.testmod(module, extraglobs={"np": np, "holdfast": holdfast})
                self.assertEqual(result.failed, 0, name)
                tried += result.attempted
        self.assertGreater(tried, 15)
        before = os.getcwd()
        os.chdir(SOURCE)
        try:
            self.assertEqual(doctest.testfile(str(SOURCE / "docs/reference/python.md"), module_relative=False).failed, 0)
        finally:
            os.chdir(before)

    def test_the_first_snippet_of_the_page_runs(self):
        snippets = re.findall(r"^```python\n(.*?)^```", (SOURCE / "docs/reference/python.md").read_text(), re.MULTILINE | re.DOTALL)
        [snippet] = [snippet for snippet in snippets if snippet.startswith("import holdfast\n")]
        self.assertEqual(self.done(sys.executable, "-c", snippet, cwd=SOURCE), "[ True]\n")

    def test_types_are_right_and_the_stub_is_that_of_the_module(self):
        config = SOURCE / "pyproject.toml"
        with tempfile.TemporaryDirectory() as cache:
            environment = {**os.environ, "MYPY_CACHE_DIR": cache}
            self.done(sys.executable, "-m", "mypy", "--config-file", config, SOURCE / "python/holdfast", env=environment)
            self.done(sys.executable, "-m", "mypy.stubtest", "holdfast._core", "--mypy-config-file", config, "--allowlist",
                      SOURCE / "python/stubtest_allowlist.txt", cwd=PACKAGE.parent, env=environment)

    def test_every_public_name_is_documented(self):
        for name in holdfast.__all__:
            public = getattr(holdfast, name)
            self.assertTrue(public.__doc__, name)
            for member in vars(public) if isinstance(public, type) and public.__module__.startswith("holdfast") else ():
                if not member.startswith("_") and callable(getattr(public, member)):
                    self.assertTrue(getattr(public, member).__doc__, f"{name}.{member}")

    def test_pip_installs_a_package_that_stands_alone(self):
        """By the commands of docs/reference/python.md, in a copy of the sources with the build of this test."""
        [block] = [block for block in re.findall(r"^```sh\n(.*?)^```", (SOURCE / "docs/reference/python.md").read_text(), re.MULTILINE | re.DOTALL)
                   if "pip install" in block]
        commands = [line for line in block.splitlines() if not line.startswith("tools/install_dependencies.sh")]
        environment = {**os.environ, "PIP_QUIET": "1", "PIP_NO_CACHE_DIR": "1", "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
        environment.pop("PYTHONPATH", None)
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder)
            for name in ("pyproject.toml", "setup.py", "README.md", "CMakeLists.txt"):
                shutil.copy(SOURCE / name, copy)
            for name in ("python", "tools"):
                shutil.copytree(SOURCE / name, copy / name)
            (copy / "build").mkdir()
            (copy / "build/release").symlink_to(PACKAGE.parents[1])
            said = self.done("bash", "-e", "-c", "\n".join(commands), cwd=copy, env=environment)
            self.assertEqual(said.splitlines()[-1], holdfast.__version__)
            target = str(copy / "build/venv")
            script = ("import holdfast, sys; assert holdfast.__file__.startswith(sys.argv[1]), holdfast.__file__\n"
                      "print(*(engine.name for engine in holdfast.engines() if not engine.missing))\n"
                      "print(*(line.split()[-1] for line in open('/proc/self/maps') if 'libholdfast' in line))")
            names, loaded = self.done(copy / "build/venv/bin/python", "-c", script, target, cwd="/", env=environment).splitlines()
        self.assertIn("native bullet bullet-f64", names)
        self.assertTrue(all(target in path for path in loaded.split()), loaded)


if __name__ == "__main__":
    main()
