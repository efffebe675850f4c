"""HDF5 files that are made to harm: they point elsewhere, claim to be huge, never end, or have wrong bytes.

Whatever is in a file, every command that reads it answers within its limits of memory and time: with what was asked, or with one
line that names the file. There are more files with random wrong bytes where tests are thorough.
"""
import os
import random
import shutil
import struct
import unittest
import zlib

import h5py
import numpy as np

from cli import AT_ONCE, REST, SANITIZED, SEED, SHOVE, THOROUGH, TOWER, CliTest, layout_text

MUTATIONS = 2000 if THOROUGH else 60
SECRET = "do not show this line"
NAMES = "/inputs/layouts/name"
TABLE = "/boxes/mass"


def wrong_bytes(data, draw):
    """A copy of the bytes of a file in which some are others, most of them where HDF5 describes its objects."""
    changed = bytearray(data)
    marks = [i for mark in (b"TREE", b"SNOD", b"HEAP", b"GCOL", b"OHDR", b"FRHP", b"\x89HDF") for i in places(data, mark)]
    for _ in range(draw.choice((1, 1, 2, 4, 16))):
        near = draw.choice(marks) + draw.randrange(200) if draw.random() < 0.7 else draw.randrange(len(data))
        at = min(near, len(data) - 1)
        kind = draw.randrange(5)
        if kind == 0:
            changed[at] = draw.choice((0, 1, 127, 128, 255))
        elif kind == 1:
            changed[at] ^= 1 << draw.randrange(8)
        elif kind == 2:
            size = draw.choice((4, 8, 64, 512, 4096))
            changed[at:at + size] = bytes(len(changed[at:at + size]))
        elif kind == 3:
            number = struct.pack("<Q", draw.choice((0, 1, at, len(data), 2**31, 2**32, 2**63, 2**64 - 1)))
            changed[at:at + 8] = number[:len(changed[at:at + 8])]
        else:
            source, size = draw.randrange(len(data)), draw.choice((8, 64, 512))
            piece = data[source:source + size]
            changed[at:at + len(piece)] = piece[:len(changed[at:at + len(piece)])]
    return bytes(changed[:draw.randrange(len(changed))] if draw.random() < 0.03 else changed)


def places(data, mark):
    at = data.find(mark)
    while at >= 0:
        yield at
        at = data.find(mark, at + 1)


class Hostile(CliTest):
    def setUp(self):
        super().setUp()
        self.write("config.ini", AT_ONCE)
        self.write("shove.txt", SHOVE)
        self.write("rest.txt", REST)
        for name, boxes in (("a.txt", SEED), ("b.txt", TOWER)):
            self.write(f"layouts/{name}", layout_text(boxes))
        screen = ("screen", "-c", "config.ini", "--layouts", "layouts", "--accelerations", "shove.txt", "rest.txt", "--quiet")
        self.assert_exit(self.run_here(*screen, "-o", "whole.h5"), 0)
        self.assert_exit(self.run_here(*screen, "-o", "shards.h5", "--part", "1/1"), 0)
        self.shard = self.folder / "shards.h5.shards/shard-1-of-1.h5"

    def read(self, path, *commands):
        """What commands say of a file: the lines of all of them. Each answers, or refuses in one line that names the file."""
        said = ""
        for words in commands:
            command = [word.replace("FILE", path) for word in words]
            done = self.run_here(*command)
            self.assert_exit(done, done.returncode)
            self.assertIn(done.returncode, (0, 1, 2), f"{command}: {done.stderr}")
            if done.returncode != 0:
                lines = [line for line in done.stderr.splitlines() if not line.startswith("warning: ")]
                self.assertEqual(len(lines), 1, f"{command}: {done.stderr}")
                # Of what happens while shards are put together it is not known which one it is.
                self.assertTrue(path in lines[0] or lines[0].startswith("a shard of merged.h5: "), lines[0])
            said += done.stdout + done.stderr
        return said

    SUMMARY = ("summary", "FILE")
    TABLES = ("summary", "FILE", "--csv", "tables")
    MERGE = ("merge", "merged.h5", "FILE", "--overwrite", "--quiet")
    REPORT = ("report", "FILE", "-o", "report.html")
    VIEW = ("view", "FILE", "--no-open", "-o", "page.html")

    def instead(self, name, make, source="whole.h5"):
        """A copy of a file in which `make` writes the dataset of that name, to which it is told what was there."""
        shutil.copy(self.folder / source, self.folder / "hostile.h5")
        with h5py.File(self.folder / "hostile.h5", "r+") as file:
            old = file[name][()]
            attributes = dict(file[name].attrs)
            del file[name]
            make(file, old)
            if isinstance(file.get(name, getlink=True), h5py.HardLink):
                file[name].attrs.update(attributes)
        return "hostile.h5"

    def test_what_lies_elsewhere_is_not_read(self):
        secret = self.write("secret.txt", (SECRET + "\n") * 10)
        os.mkfifo(self.folder / "pipe")
        with h5py.File(self.folder / "other.h5", "w") as file:
            file["lines"] = np.full(2, SECRET.encode(), "S21")
            file["masses"] = np.full(16, 7.0, "f8")

        def elsewhere(path):
            def make(file, old):
                create = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
                create.set_external(str(path).encode(), 0, h5py.h5f.UNLIMITED)
                kind = h5py.h5t.py_create(old.dtype, logical=True)
                h5py.h5d.create(file.id, NAMES.encode(), kind, h5py.h5s.create_simple(old.shape), create)
            return make

        def virtual(file, old):
            layout = h5py.VirtualLayout(shape=old.shape, dtype=old.dtype)
            layout[:] = h5py.VirtualSource("other.h5", "lines", shape=old.shape, dtype=old.dtype)
            file.create_virtual_dataset(NAMES, layout)

        def link(file, old):
            file[NAMES] = h5py.ExternalLink("other.h5", "lines")

        def circle(file, old):
            file[NAMES] = h5py.SoftLink(NAMES)

        for kind, make in {"external file": elsewhere(secret), "pipe": elsewhere("pipe"), "virtual": virtual, "link": link,
                           "circle": circle}.items():
            with self.subTest(kind=kind):
                path = self.instead(NAMES, make)
                said = self.read(path, self.SUMMARY, self.REPORT, self.VIEW)
                self.assertNotIn(SECRET, said)
                self.assertEqual(said.count(path), 3, said)
        with self.subTest(kind="a link in a shard"):
            self.assertIn("hostile.h5", self.read(self.instead(NAMES, link, self.shard), self.MERGE))

    def test_memory_is_limited(self):
        def packed(name, count, chunk, kind, entry):
            """Many entries that are all the same, of which one chunk is packed, and written again and again."""
            def make(file, old):
                data = file.create_dataset(name, (count,), kind, chunks=(chunk,), maxshape=(None,), compression="gzip")
                chunk_bytes = zlib.compress(entry * chunk)
                for begin in range(0, count, chunk):
                    data.id.write_direct_chunk((begin,), chunk_bytes)
            return make

        def zeros(count, chunk):
            return packed(TABLE, count, chunk, "f8", bytes(8))

        names = packed(NAMES, 600, 1, h5py.string_dtype("utf-8", 10**6), b"a" * 10**6)
        with self.subTest(kind="a table that is longer than what is needed of it"):
            self.read(self.instead(TABLE, zeros(10**8, 10**5)), self.SUMMARY, self.TABLES)
        with self.subTest(kind="long names"):
            path = self.instead(NAMES, names)
            said = self.read(path, self.SUMMARY, self.REPORT, self.VIEW)
            self.assertEqual(said.count("512 MB"), 3, said)
            self.assertIn("thresholds", self.read(path, (*self.SUMMARY, "--memory", "4096")))

    def test_a_report_of_half_a_file_is_one_line(self):
        for name in ("/boxes/mass", "/summary/worlds/verdict", "/inputs/layouts/corner_min", "/worlds/stop_reason"):
            shutil.copy(self.folder / "whole.h5", self.folder / "half.h5")
            with h5py.File(self.folder / "half.h5", "r+") as file:
                del file[name]
            with self.subTest(without=name):
                self.assertIn("half.h5", self.read("half.h5", self.REPORT))

    def test_a_large_chunk_is_refused(self):
        """HDF5 would unpack it for every slice of the table."""
        def make(file, old):
            file.create_dataset(TABLE, (2 * 10**6,), "f8", chunks=(10**6,), compression="gzip")

        self.assertIn("has chunks that are too large", self.read(self.instead(TABLE, make), self.SUMMARY))

    def test_texts_are_shown_as_texts(self):
        """No script in a page, no control of a terminal, and no line of its own."""
        script = b"<script>alert(1)</script>"
        for name in ("/summary/worlds/tilted_boxes", "/summary/worlds/fallen_at_end", "/boxes/mass"):
            path = self.instead(name, lambda file, old, name=name: file.create_dataset(name, data=np.full(len(old), script)))
            with self.subTest(dataset=name):
                self.assertIn(path, self.read(path, self.REPORT))
        shutil.copy(self.folder / "whole.h5", self.folder / "odd.h5")
        with h5py.File(self.folder / "odd.h5", "r+") as file:
            file.attrs["format"] = "\x1b]0;owned\x07\x1b[2J\nall is well \u009b31m \u202e"
        said = self.read("odd.h5", self.SUMMARY, self.REPORT, self.VIEW)
        self.assertFalse(set(said) & set("\x1b\x07\u009b\u202e"), ascii(said))

    def test_limits_that_are_none(self):
        for value in (np.nan, np.inf, -1.0):
            shutil.copy(self.folder / "whole.h5", self.folder / "limits.h5")
            with h5py.File(self.folder / "limits.h5", "r+") as file:
                file["summary"].attrs["move_threshold"] = value
            with self.subTest(value=value):
                self.assertIn("move_threshold is no limit", self.read("limits.h5", self.SUMMARY))

    def test_tables_that_do_not_fit_together(self):
        path = self.instead("/inputs/accelerations/segment_count", lambda file, old: file.create_dataset(
            "/inputs/accelerations/segment_count", data=np.full_like(old, 1000)), self.shard)
        self.assertIn("hostile.h5: is damaged: its tables do not fit together", self.read(path, self.MERGE))

    def test_outputs_that_are_inputs_or_pipes(self):
        whole = (self.folder / "whole.h5").read_bytes()
        for name in ("link", "pipe"):
            (self.folder / name).mkdir()
        os.symlink("../whole.h5", self.folder / "link/worlds.csv")
        os.mkfifo(self.folder / "pipe/boxes.csv")
        for folder, words in (("link", "is the results file itself"), ("pipe", "is not a regular file")):
            done = self.run_here("summary", "whole.h5", "--csv", folder)
            self.assert_exit(done, 1)
            self.assertIn(words, done.stderr)
        for words in (("merge", "", self.shard), ("summary", "whole.h5", "--csv", ""), ("summary", "whole.h5", "-o", "")):
            self.assert_refused(self.run_here(*words), "an empty path")
        self.assertEqual((self.folder / "whole.h5").read_bytes(), whole)
        # What a merge would remove before it reads it.
        (self.folder / "m.h5.parts").mkdir()
        for name in ("m.h5.tmp", "m.h5.parts/part-000001.h5"):
            shutil.copy(self.shard, self.folder / name)
            self.assert_refused(self.run_here("merge", "m.h5", name, "--overwrite"), "is one of the shards")
            self.assertTrue((self.folder / name).exists())

    def test_a_report_replaces_nothing_but_itself(self):
        self.write("r.html.new", "precious")
        self.assert_exit(self.run_here("report", "whole.h5", "-o", "r.html"), 0)
        self.assertEqual((self.folder / "r.html.new").read_text(), "precious")
        os.symlink("r.html", self.folder / "link.html")
        self.assert_exit(self.run_here("report", "whole.h5", "-o", "link.html"), 0)
        self.assertTrue((self.folder / "link.html").is_symlink())

    def test_files_of_zeros(self):
        data = (self.folder / "whole.h5").read_bytes()
        for mark in (b"TREE", b"SNOD", b"HEAP", b"GCOL"):
            for size in (8, 16, 64, 4096):
                with self.subTest(mark=mark, size=size):
                    changed = bytearray(data)
                    for at in places(data, mark):
                        begin = at if size < 4096 else at + 16
                        changed[begin:begin + size] = bytes(size)
                    self.write("zeros.h5", bytes(changed))
                    self.read("zeros.h5", self.TABLES)

    def test_wrong_bytes(self):
        if SANITIZED:
            self.skipTest("the sanitizer ends the program where the HDF5 library goes astray, as it should")
        files = {"whole.h5": self.TABLES, str(self.shard.relative_to(self.folder)): self.MERGE}
        for i in range(MUTATIONS):
            draw = random.Random(i)
            source, command = list(files.items())[i % 4 == 3]
            with self.subTest(mutation=i, command=command[0]):
                self.write("wrong.h5", wrong_bytes((self.folder / source).read_bytes(), draw))
                self.read("wrong.h5", command, *([self.REPORT] if i % 20 == 0 else []))


if __name__ == "__main__":
    unittest.main()
