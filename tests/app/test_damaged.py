"""Results files that were changed by something else: other types, shapes, values. Single bytes are those of test_hostile.py.

Whatever is in the file, `summary` and `--resume` answer: with tables, or with a message that names the file.
"""
import shutil
import unittest

import h5py
import numpy as np

from cli import CONFIG, SEED, THOROUGH, TOWER, CliTest, datasets, layout_text, some, start, wait_for

DAMAGE = ["is damaged", "lacks a dataset", "has a dataset", "ends before", "has no", "cannot be", "is not", "later format", "takes more than"]


def other_type(data):
    return np.zeros(len(data), "f8") if data.dtype.kind == "S" else np.full(data.shape, b"text")


def other_width(data):
    if data.dtype.kind == "S":
        return data.astype("S300")
    widths = {"u1": "u2", "u4": "u8", "u8": "u4", "i4": "i8", "f4": "f8", "f8": "f4"}
    return data.astype(widths[f"{data.dtype.kind}{data.itemsize}"])


# What is done to a dataset: a name, and what it becomes (None: removed).
CHANGES = {
    "removed": lambda data: None,
    "of another type": other_type,
    "of another width": other_width,
    "with a column more": lambda data: np.stack([data, data], axis=-1),
    "a single value": lambda data: data.reshape(-1)[0] if data.size else np.zeros(()),
    "empty": lambda data: data[:0],
    "shorter": lambda data: data[:-1],
    "longer": lambda data: np.concatenate([data, data]),
}
# What is done to the values of a dataset of numbers.
VALUES = {
    "largest": lambda data: np.full_like(data, np.iinfo(data.dtype).max if data.dtype.kind in "ui" else np.finfo(data.dtype).max),
    "one more": lambda data: data + np.ones_like(data),
    "reversed": lambda data: data[::-1],
    "infinite or zero": lambda data: np.full_like(data, 0 if data.dtype.kind in "ui" else np.nan),
}

CURE = "remove this part and all later ones; --resume then simulates their worlds again"

# Datasets of a part that nothing but the results file needs.
NEEDED_AT_THE_END = tuple(f"/inputs/layouts/{name}" for name in (
    "box_begin", "box_count", "header", "container_type", "container_size", "open_sides", "drop_sides", "bed_height"))


class Damaged(CliTest):
    def setUp(self):
        super().setUp()
        self.write("config.ini", CONFIG + "[Export Settings]\nResultsIntervallInSeconds = 0.1\n")
        self.write("a_shove.txt", "0 0.3 8 1 0\n")
        self.write("b_endless.txt", "0 15000 1 0 0\n")
        for name, boxes in (("a.txt", SEED), ("b.txt", TOWER)):
            self.write(f"layouts/{name}", layout_text(boxes))

    def arguments(self, *accelerations):
        return ("screen", "-c", "config.ini", "--layouts", "layouts", "--accelerations", *accelerations, "--quiet")

    def assert_answers(self, path, *arguments):
        """The program does what is asked, or says what is wrong with the file; it never crashes."""
        done = self.run_here(*arguments)
        self.assertIn(done.returncode, (0, 1, 2), f"{arguments}: {done.stderr}")
        self.assert_exit(done, done.returncode)
        if done.returncode != 0:
            lines = [line for line in done.stderr.splitlines() if not line.startswith("warning: ")]
            self.assertEqual(len(lines), 1, done.stderr)
            self.assertIn(path, done.stderr)
            self.assertTrue(any(words in done.stderr for words in DAMAGE), done.stderr)
        return done.returncode

    def changed(self, source, name, change):
        """A copy of the file in which a dataset is another."""
        shutil.copy(source, self.folder / "changed.h5")
        with h5py.File(self.folder / "changed.h5", "r+") as file:
            data, attributes = file[name][()], dict(file[name].attrs)
            new = change(data)
            chunks = file[name].chunks if name.startswith("/series") else None
            del file[name]
            if new is not None:
                options = {"chunks": chunks, "maxshape": (None, *np.shape(new)[1:])} if chunks and np.ndim(new) == len(chunks) \
                    else {}
                file.create_dataset(name, data=new, **options).attrs.update(attributes)
        return "changed.h5"

    def summary(self, path):
        shutil.rmtree(self.folder / "tables", ignore_errors=True)
        return self.assert_answers(path, "summary", path, "--csv", "tables")

    def test_summary_of_other_types_and_shapes(self):
        self.assert_exit(self.run_here(*self.arguments("a_shove.txt")), 0)
        refused = 0
        needed = ("/worlds", "/boxes", "/inputs/layouts/name", "/inputs/accelerations/name", "/series/time", "/series/displ")
        for name in some(name for name in datasets(self.folder / "results.h5") if name.startswith(needed)):
            for kind, change in CHANGES.items():
                with self.subTest(dataset=name, change=kind):
                    refused += self.summary(self.changed(self.folder / "results.h5", name, change)) != 0
        self.assertGreater(refused, 100 if THOROUGH else 30, "of some 300 changes many are such that no table can be made")

    def test_summary_of_other_values(self):
        self.assert_exit(self.run_here(*self.arguments("a_shove.txt")), 0)
        for name, data in datasets(self.folder / "results.h5").items():
            if not name.startswith(("/worlds", "/boxes/end", "/series/time")) or data.dtype.kind == "S":
                continue
            for kind, change in VALUES.items():
                with self.subTest(dataset=name, values=kind):
                    code = self.summary(self.changed(self.folder / "results.h5", name, change))
                    if name in ("/worlds/box_begin", "/worlds/box_count") and kind in ("largest", "one more", "reversed"):
                        self.assertNotEqual(code, 0)

    def test_a_file_that_claims_to_be_huge(self):
        self.assert_exit(self.run_here(*self.arguments("a_shove.txt")), 0)
        for name in ("/worlds/layout", "/boxes/mass", "/inputs/layouts/name", "/boxes/peak_drop"):
            with self.subTest(dataset=name):
                shutil.copy(self.folder / "results.h5", self.folder / "huge.h5")
                with h5py.File(self.folder / "huge.h5", "r+") as file:
                    dtype = file[name].dtype
                    del file[name]
                    file.create_dataset(name, (10**13,), dtype, chunks=(16384,), maxshape=(None,))
                self.assertNotEqual(self.summary("huge.h5"), 0)

    def test_attributes_of_other_types(self):
        self.assert_exit(self.run_here(*self.arguments("a_shove.txt")), 0)
        for group, name in (("/", "format"), ("/", "format_version"), ("/", "engine"), ("/", "worlds_begin"),
                            ("/", "complete"), ("/summary", "drop_threshold")):
            for value in (None, np.arange(3), "text", 2.5, np.uint64(2**64 - 1)):
                with self.subTest(attribute=name, value=value):
                    shutil.copy(self.folder / "results.h5", self.folder / "changed.h5")
                    with h5py.File(self.folder / "changed.h5", "r+") as file:
                        del file[group].attrs[name]
                        if value is not None:
                            file[group].attrs[name] = value
                    self.summary("changed.h5")

    def test_resume_from_changed_parts(self):
        """A world of four is finished; then its part is no longer what it was."""
        arguments = self.arguments("a_shove.txt", "b_endless.txt")
        process = start(*arguments, "--threads", 1, cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        part = self.folder / "results.h5.parts/part-000001.h5"
        wait_for(part.exists, process)
        process.kill()
        process.wait()
        shutil.copy(part, self.folder / "kept.h5")
        kinds = ("removed", "of another type", "with a column more")

        def damage(name, kind):
            shutil.copy(self.folder / self.changed(self.folder / "kept.h5", name, CHANGES[kind]), part)

        # What is refused is refused before anything is simulated: the endless world is never begun.
        names = [name for name in datasets(part) if name.startswith(("/worlds/layout", "/inputs/layout", "/boxes/world",
                                                                     "/series/time", "/series/displ"))]
        for name in some(names):
            for kind in kinds if name not in NEEDED_AT_THE_END else ():
                with self.subTest(dataset=name, change=kind):
                    damage(name, kind)
                    self.assertEqual(self.assert_answers("results.h5", *arguments, "--resume"), 2)
        for name, value in (("worlds_begin", 1), ("samples_begin", 2**63), ("fingerprint", "config=0"), ("boxes_begin", "x")):
            with self.subTest(attribute=name):
                shutil.copy(self.folder / "kept.h5", part)
                with h5py.File(part, "r+") as file:
                    del file.attrs[name]
                    file.attrs[name] = value
                self.assert_refused(self.run_here(*arguments, "--resume"), "results.h5")
        for content in (b"", b"No part.\n", (self.folder / "kept.h5").read_bytes()[:3000]):
            part.write_bytes(content)
            self.assert_refused(self.run_here(*arguments, "--resume"), "part-000001.h5", CURE)
        content = bytearray((self.folder / "kept.h5").read_bytes())
        place = content.index(b"TREE")  # HDF5's own index of what is in a group
        content[place:place + 4] = b"EERT"
        part.write_bytes(content)
        self.assert_refused(self.run_here(*arguments, "--resume"), "part-000001.h5", "signature", CURE)
        # The rest is missed when the parts are put together. The first such run simulates the worlds that are left.
        for name in NEEDED_AT_THE_END:
            for kind in kinds:
                with self.subTest(dataset=name, change=kind):
                    damage(name, kind)
                    done = self.run_here(*arguments, "--resume")
                    self.assert_refused(done, "part-000001.h5: ", name, CURE, "--resume puts them together", code=1, lines=2)
        shutil.copy(self.folder / "kept.h5", part)
        self.assert_exit(self.run_here(*arguments, "--resume"), 0)


if __name__ == "__main__":
    unittest.main()
