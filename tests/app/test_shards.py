"""Runs that are simulated in shards and merged: the file is that of one run, whatever the shards were. test_shard_faults has what may
happen to them.

There are more generated layouts beside the bundled ones where tests are thorough.
"""
import os
import random
import shutil
import subprocess
import sys
import time
import unittest

import h5py

from cli import SOURCE, THOROUGH, CliTest, datasets, layout_text

CANDIDATES = "2000" if THOROUGH else "60"
TIMES = ("/worlds/cpu_seconds", "/margins/cpu_seconds", "/margin_spread/cpu_seconds", "/replicas/cpu_seconds")


def stored_chunks(path):
    """Compressed bytes of all chunks of a file, by dataset; times left out."""
    found = {}

    def take(name, item):
        if isinstance(item, h5py.Dataset) and item.chunks and f"/{name}" not in TIMES:
            found[name] = [item.id.read_direct_chunk(item.id.get_chunk_info(i).chunk_offset)
                           for i in range(item.id.get_num_chunks())]

    with h5py.File(path) as file:
        file.visititems(take)
    return found


class ShardTest(CliTest):
    """Small layouts under two accelerations, which are blocks of 128 layouts."""

    layouts = 600  # five blocks, the last of 88

    def setUp(self):
        super().setUp()
        draw = random.Random(7)
        for i in range(self.layouts):
            boxes = [(30 * k, 10, 0, 30 * k + 20, 30, draw.randint(10, 90)) for k in range(draw.randint(1, 4))]
            self.write(f"layouts/{i:04}.txt", layout_text(boxes))
        self.write(f"layouts/{self.layouts // 2:04}.txt", layout_text([(0, 0, 0, 1000, 10, 10)]))  # outside the container
        self.write("push.txt", "0 0.3 0 6 0\n")
        self.write("rest.txt", "0 0.1 0 0 0\n")
        self.arguments = ["screen", "--layouts", "layouts", "--accelerations", "push.txt", "rest.txt", "--accuracy",
                          "screening", "--quiet"]

    def screen(self, *arguments, output="results.h5", code=1):  # one layout is bad
        done = self.run_here(*self.arguments, "-o", output, *arguments)
        self.assert_exit(done, code)
        return self.folder / output

    def shards(self, count, *arguments):
        for part in range(1, count + 1):
            done = self.run_here(*self.arguments, "-o", "results.h5", "--part", f"{part}/{count}", *arguments)
            self.assertIn(done.returncode, (0, 1), done.stderr)
        return self.folder / "results.h5.shards"

    def merge(self, *arguments, code=0):
        done = self.run_here("merge", "results.h5", *arguments)
        self.assert_exit(done, code)
        return done

    def assert_same_file(self, a, b):
        left, right = datasets(a), datasets(b)
        self.assertEqual(sorted(left), sorted(right))
        for name in left:
            if name not in TIMES:
                self.assertEqual(left[name].tobytes() if hasattr(left[name], "tobytes") else left[name],
                                 right[name].tobytes() if hasattr(right[name], "tobytes") else right[name], name)
        self.assertEqual(stored_chunks(a), stored_chunks(b))
        with h5py.File(a) as one, h5py.File(b) as two:
            for group in ("/", "/summary", "/inputs/settings"):
                self.assertEqual(list(one[group].attrs), list(two[group].attrs))
                for name, value in one[group].attrs.items():
                    if name not in ("created_utc", "command_line", "Screening/Threads"):
                        self.assertEqual(value, two[group].attrs[name], name)


class Shards(ShardTest):
    def test_the_merged_file_is_that_of_one_run_whatever_the_shards_were(self):
        whole = self.screen(output="whole.h5")
        for count in (1, 2, 7):
            with self.subTest(shards=count):
                folder = self.shards(count)
                self.assertEqual(len(list(folder.glob("*.h5"))), min(count, 5))
                done = self.merge()
                self.assertEqual(done.stdout, f"results: results.h5, 1200 worlds of {min(count, 5)} shard{'s' * (count > 1)}\n")
                self.assert_same_file(whole, self.folder / "results.h5")
                self.assertFalse((self.folder / "results.h5.parts").exists())
                shutil.rmtree(folder)
                (self.folder / "results.h5").unlink()

    def test_shards_may_lie_anywhere_and_are_results_themselves(self):
        whole = self.screen("--no-series", output="whole.h5")
        folder = self.shards(2, "--no-series")
        (self.folder / "node1").mkdir()
        (folder / "shard-1-of-2.h5").rename(self.folder / "node1/a.h5")
        self.merge("results.h5.shards/shard-2-of-2.h5", "node1")
        self.assert_same_file(whole, self.folder / "results.h5")
        done = self.run_here("summary", "node1/a.h5")
        self.assert_exit(done, 0)
        # Blocks 1, 3 and 5 of five.
        self.assertEqual(len(datasets(self.folder / "node1/a.h5")["/worlds/layout"]), 2 * (128 + 128 + 88))

    def test_an_output_that_is_a_shard_is_refused_before_anything_is_removed(self):
        folder = self.shards(2, "--no-series")
        shard = folder / "shard-1-of-2.h5"
        content = shard.read_bytes()
        os.symlink(shard, self.folder / "link.h5")
        os.link(shard, self.folder / "same.h5")
        for output in (shard, self.folder / "link.h5", self.folder / "same.h5", folder / ".." / folder.name / shard.name):
            with self.subTest(output=str(output)):
                done = self.run_here("merge", str(output), str(folder), "--overwrite")
                self.assertNotEqual(done.returncode, 0)
                self.assertIn("is one of the shards", done.stderr)
                self.assertEqual(shard.read_bytes(), content)

    def test_all_analyses_are_merged(self):
        shutil.rmtree(self.folder / "layouts")
        for name in ("seed_example.txt", "BR5_020_layer_h60.txt"):
            (self.folder / "layouts").mkdir(exist_ok=True)
            shutil.copy(SOURCE / "configs/layouts" / name, self.folder / "layouts")
        self.write("layouts/box.txt", layout_text([(0, 0, 0, 80, 60, 50)]))
        names = [self.write(f"a/{i:03}.txt", f"0 0.05 {i % 5} {i % 3} 0\n") for i in range(130)]  # a block is one layout
        self.arguments = ["screen", "--layouts", "layouts", "--accelerations", "a", "--accuracy", "screening", "--quiet",
                          "--margins", "--walls", "en283", "--damage", "--load-shift", "--indicators", "--replicas", 27]
        self.assertEqual(len(names), 130)
        whole = self.screen(output="whole.h5", code=0)
        self.shards(3)
        self.merge()
        self.assert_same_file(whole, self.folder / "results.h5")

    def test_what_is_missing_double_or_different_is_named(self):
        folder = self.shards(3)
        second = folder / "shard-2-of-3.h5"
        kept = self.folder / "kept.h5"
        second.rename(kept)
        self.assert_refused(self.run_here("merge", "results.h5"), "a shard is missing", "2 of 3", "--resume")
        shutil.copy(folder / "shard-1-of-3.h5", folder / "copy.h5")
        self.assert_refused(self.run_here("merge", "results.h5", "results.h5.shards", kept), "is the same shard as", "1 of 3")
        (folder / "copy.h5").unlink()

        self.assert_exit(self.run_here(*self.arguments, "-o", "results.h5", "--part", "2/4"), 0)
        self.assert_refused(self.run_here("merge", "results.h5", "results.h5.shards", kept), "shard-2-of-4.h5",
                            "of another division", "2 of 4")
        (folder / "shard-2-of-4.h5").unlink()
        # Another accuracy, another version.
        other = [word.replace("screening", "standard") for word in self.arguments]
        self.run_here(*other, "-o", "results.h5", "--part", "2/3")
        self.assert_refused(self.run_here("merge", "results.h5"), "shard-2-of-3.h5", "of a run with other settings")
        shutil.copy(kept, second)
        with h5py.File(second, "r+") as file:
            fingerprint = file.attrs["run_fingerprint"]
            file.attrs["run_fingerprint"] = fingerprint.replace("software=", "software=0")
        self.assert_refused(self.run_here("merge", "results.h5"), "shard-2-of-3.h5", "of a run with other software")
        # Layouts of the same names, of which one has changed between the shards.
        changed = self.folder / "layouts/0050.txt"
        before = changed.read_text()
        changed.write_text(layout_text([(0, 0, 0, 81, 60, 50)]))
        second.unlink()
        self.assert_exit(self.run_here(*self.arguments, "-o", "results.h5", "--part", "2/3"), 0)
        changed.write_text(before)
        self.assert_refused(self.run_here("merge", "results.h5"), "shard-2-of-3.h5", "of a run with other layout_contents")
        for name in ("/worlds/box_begin", "/worlds/sample_begin", "/worlds/row_begin", "/worlds/layout", "/boxes/world",
                     "/inputs/layouts/box_begin"):
            shutil.copy(kept, second)
            with h5py.File(second, "r+") as file:
                file[name][len(file[name]) // 2 + 1] += 1
            self.assert_refused(self.run_here("merge", "results.h5"), "shard-2-of-3.h5: is damaged: ", name, code=1)
            shutil.rmtree(self.folder / "results.h5.parts", ignore_errors=True)
        shutil.copy(kept, second)
        with h5py.File(second, "r+") as file:
            file.attrs.modify("format_version", file.attrs["format_version"] - 1)
        self.assert_refused(self.run_here("merge", "results.h5"), "shard-2-of-3.h5: has version 2 of the format",
                            "simulate the shard again")
        second.write_bytes(kept.read_bytes()[:20000])
        self.assert_refused(self.run_here("merge", "results.h5"), "shard-2-of-3.h5")
        self.write("results.h5.shards/shard-2-of-3.h5", "no results\n")
        self.assert_refused(self.run_here("merge", "results.h5"), "shard-2-of-3.h5")
        second.unlink()
        whole = self.screen(output="whole.h5")
        self.assert_refused(self.run_here("merge", "results.h5", "results.h5.shards", whole), "whole.h5", "is no shard")
        self.assertFalse((self.folder / "results.h5").exists())
        self.merge("results.h5.shards", kept)

    def test_a_merge_goes_on_and_never_overwrites(self):
        whole = self.screen(output="whole.h5")
        self.shards(2)
        # As if killed before it assembled the file.
        self.merge()
        finished = (self.folder / "results.h5").read_bytes()
        self.merge()  # nothing to do
        self.assertEqual((self.folder / "results.h5").read_bytes(), finished)
        self.write("push.txt", "0 0.3 0 7 0\n")
        self.shards(2, "--overwrite")
        done = self.run_here("merge", "results.h5")
        self.assert_refused(done, "results.h5", "other accelerations", code=1)
        self.assertEqual((self.folder / "results.h5").read_bytes(), finished)
        self.assert_same_file(whole, self.folder / "results.h5")
        self.merge("--overwrite")
        self.assertNotEqual((self.folder / "results.h5").read_bytes(), finished)

    def test_bad_parts_and_what_needs_the_whole_run_are_refused(self):
        for part in ("0/3", "4/3", "1", "1/", "/2", "a/b", "-1/2", "1/2/3", "1/0"):
            self.assert_refused(self.run_here(*self.arguments, f"--part={part}"), part, "K/N")
        self.assert_refused(self.run_here(*self.arguments, "--part", "1/2", "--first-failure"), "FirstFailure")
        self.assert_refused(self.run_here(*self.arguments, "--part", "1/2", "--text", "texts"), "text files")
        self.assert_refused(self.run_here("merge", "none.h5"), "none.h5.shards", "is not there")


class GeneratedLayouts(ShardTest):
    """The bundled layouts and generated ones under the accelerations of the road."""

    def setUp(self):
        CliTest.setUp(self)
        shutil.copytree(SOURCE / "configs/layouts", self.folder / "layouts")
        subprocess.run([sys.executable, SOURCE / "bench/candidates.py", CANDIDATES, self.folder / "layouts", "--boxes", "20", "60"],
                       stdout=subprocess.DEVNULL, check=True)
        self.arguments = ["screen", "--layouts", "layouts", "--norm", "road", "--accuracy", "screening", "--quiet"]

    def seconds(self, *arguments, codes=(0, 1)):
        """That a command takes; of thousands of layouts a world may miss its tolerance."""
        begin = time.monotonic()
        done = self.run_here(*arguments, timeout=None)
        self.assertIn(done.returncode, codes, done.stderr)
        return time.monotonic() - begin

    def test_seven_shards_are_merged_to_the_file_of_one_run(self):
        whole = self.seconds(*self.arguments, "-o", "whole.h5")
        shards = sum(self.seconds(*self.arguments, "-o", "results.h5", "--part", f"{part}/7") for part in range(1, 8))
        merge = self.seconds("merge", "results.h5", codes=(0,))
        self.assert_same_file(self.folder / "whole.h5", self.folder / "results.h5")
        size = (self.folder / "results.h5").stat().st_size / 1e6
        print(f"{len(list((self.folder / 'layouts').iterdir()))} layouts, {size:.1f} MB: one run {whole:.1f} s, seven shards "
              f"one after the other {shards:.1f} s, merge {merge:.2f} s")


if __name__ == "__main__":
    unittest.main()
