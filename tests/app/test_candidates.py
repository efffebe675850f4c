"""bench/candidates.py: layouts that are distinct, valid, the same every time, and as the knobs say; bench/with_play.py;
bench/sampled_accelerations.py."""
import subprocess
import sys
import unittest

from cli import SOURCE, CliTest

COUNT = 120


class Candidates(CliTest):
    def make(self, folder, *knobs, count=COUNT):
        """The layouts' texts by name, and their boxes."""
        done = subprocess.run([sys.executable, SOURCE / "bench/candidates.py", str(count), self.folder / folder,
                               *map(str, knobs)], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        texts = {path.name: path.read_text() for path in sorted((self.folder / folder).iterdir())}
        self.assertEqual(len(texts), count)
        return texts

    @staticmethod
    def boxes(text):
        return [tuple(map(float, line.split())) for line in text.splitlines()[1:]]

    def assert_valid(self, folder):
        done = self.run_here("check", folder)
        self.assert_exit(done, 0)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.stdout.count(": ok: layout"), COUNT)

    def support(self, boxes):
        """For every box, the share of its base that stands on the floor or on tops at its height."""
        shares = []
        for x, y, z, X, Y, _, _ in boxes:
            area = (X - x) * (Y - y) if z == 0 else sum(
                max(0, min(X, B) - max(x, b)) * max(0, min(Y, C) - max(y, c))
                for b, c, _, B, C, top, _ in boxes if abs(top - z) < 1e-6)
            shares.append(area / ((X - x) * (Y - y)))
        return shares

    def test_distinct_valid_and_supported(self):
        texts = self.make("plain")
        self.assertEqual(len(set(texts.values())), COUNT)
        self.assertEqual({name.split("_")[2] for name in texts}, {f"BR{i}.txt" for i in range(1, 16)})
        self.assert_valid("plain")
        for text in texts.values():
            self.assertGreater(min(self.support(self.boxes(text))), 0.999)
            types, count = map(int, text.split("\n")[0].split())
            self.assertEqual((types, count), (len({box[6] for box in self.boxes(text)}), len(self.boxes(text))))

    def test_the_same_every_time_and_another_with_another_seed(self):
        texts = self.make("one")
        self.assertEqual(texts, self.make("two"))
        few = self.make("few", count=7)
        self.assertEqual(few, {name: texts[name] for name in few})
        other = self.make("other", "--seed", 2)
        self.assertFalse(set(texts.values()) & set(other.values()))

    def test_knobs(self):
        texts = self.make("knobs", "--overhang", 0.3, "--gap", 4, "--fill", 0.5)
        self.assert_valid("knobs")
        shares = [share for text in texts.values() for share in self.support(self.boxes(text))]
        self.assertTrue(0.7**2 - 0.01 < min(shares) < 0.99, min(shares))
        for text in texts.values():
            volume = sum((X - x) * (Y - y) * (Z - z) for x, y, z, X, Y, Z, _ in self.boxes(text))
            self.assertLess(volume / (587 * 233 * 220), 0.55)

        texts = self.make("many", "--boxes", 20, 600)
        self.assert_valid("many")
        counts = [len(self.boxes(text)) for text in texts.values()]
        self.assertGreaterEqual(min(counts), 20)
        self.assertLessEqual(max(counts), 600)
        self.assertTrue(min(counts) < 100 and max(counts) > 400, sorted(counts))

    def test_what_cannot_be_is_refused(self):
        for knobs in (("--boxes", 9, 3), ("--fill", 2), ("--overhang", 0.9), ("--gap", -1)):
            done = subprocess.run([sys.executable, SOURCE / "bench/candidates.py", "3", self.folder / "no", *map(str, knobs)],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, done.stderr)

    def test_play_takes_from_all_sides_but_not_from_the_height(self):
        tight = SOURCE / "configs/layouts/BR1_001_ep.txt"
        subprocess.run([sys.executable, SOURCE / "bench/with_play.py", "2", self.folder / "loose", tight], check=True)
        loose = self.boxes((self.folder / "loose" / tight.name).read_text())
        boxes = self.boxes(tight.read_text())
        self.assertEqual(len(loose), len(boxes))
        for (x, y, z, X, Y, Z, _), now in zip(boxes, loose):
            self.assertEqual([round(edge, 6) for edge in now[:6]], [x + 0.1, y + 0.1, z, X - 0.1, Y - 0.1, Z])

    def test_sampled_accelerations(self):
        folder = self.folder / "sampled"
        subprocess.run([sys.executable, SOURCE / "bench/sampled_accelerations.py", folder], check=True)
        done = self.run_here("check", folder)
        self.assert_exit(done, 0)
        largest = {}
        for path in folder.iterdir():
            rows = [list(map(float, line.split())) for line in path.read_text().splitlines()[1:]]
            largest[path.stem] = [max(abs(row[k]) for row in rows) / 9.81 for k in (2, 3, 4)]
            self.assertTrue(all(abs(b[0] - a[0] - 0.02) < 1e-9 for a, b in zip(rows, rows[1:])))
        self.assertEqual([round(a, 2) for a in largest["lane_change_0g2"]], [0, 0.2, 0])
        self.assertEqual([round(a, 2) for a in largest["braking_0g8"]], [0.82, 0.01, 0])
        subprocess.run([sys.executable, SOURCE / "bench/sampled_accelerations.py", folder, "--samples", "300"], check=True)
        self.assert_exit(self.run_here("check", folder), 0)
        self.assertEqual(len((folder / "braking_0g8.txt").read_text().splitlines()), 1 + 3 * 300)


if __name__ == "__main__":
    unittest.main()
