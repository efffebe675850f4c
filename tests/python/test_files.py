"""Results files and time series: those of the program."""
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

import holdfast
from samples import BOX, BRAKE, LAYOUTS, REST, SLIDE, SLIDES, STACK, main, screened


class RecordTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "results.h5"

    def test_the_file_has_the_verdicts_names_and_settings(self):
        with holdfast.Screen([SLIDE, REST], config="[Native]\nAccuracy = screening\n") as screen:
            self.assertTrue(screen.record([BOX, STACK], self.path, names=["box", "stack"], command_line="a test"))
            expected = screen.evaluate([BOX, STACK]).state_hash.ravel()
        with h5py.File(self.path) as file:
            np.testing.assert_array_equal(file["worlds/state_hash"][:], expected)
            self.assertEqual(file["inputs/layouts/name"].asstr()[:].tolist(), ["box", "stack"])
            self.assertIn("Accuracy = screening", file["inputs/config"].asstr()[()])

    def test_a_file_that_is_there_is_resumed_replaced_or_refused(self):
        with holdfast.Screen([SLIDE]) as screen:
            self.assertTrue(screen.record([BOX], self.path))
            with self.assertRaisesRegex(holdfast.Error, "exists already"):
                screen.record([BOX], self.path)
            self.assertTrue(screen.record([BOX], self.path, resume=True))
            self.assertTrue(screen.record(STACK, self.path, offsets=[0, 2], overwrite=True, series=False))
            with self.assertRaisesRegex(holdfast.Error, "both resume and overwrite"):
                screen.record([BOX], self.path, resume=True, overwrite=True)
            with self.assertRaisesRegex(holdfast.Error, "needs a layout"):
                screen.record([], self.path)
            with self.assertRaises(holdfast.Error):
                screen.record([BOX], self.path / "below a file")


class ReplayTest(unittest.TestCase):
    def test_a_replay_is_the_series_of_a_box_that_slides(self):
        with holdfast.Screen([REST, holdfast.Acceleration("slide", SLIDE)]) as screen:
            for wanted in (1, -1, "slide", np.int64(1), holdfast.Acceleration("another", SLIDE)):
                replay = screen.replay(BOX, wanted)
                self.assertEqual(replay.displacement.shape, (16, 1, 3))
                self.assertEqual(replay.orientation.shape, (16, 1, 4))
                self.assertEqual(replay.angular_velocity.shape, (16, 1, 3))
                pushed = replay.time <= 1
                np.testing.assert_allclose(replay.displacement[pushed, 0, 0], -0.5 * (7 - 0.5 * 9.81) * replay.time[pushed]**2,
                                           atol=1e-3)
                self.assertAlmostEqual(float(replay.displacement[-1, 0, 0]), -SLIDES, 3)
                self.assertEqual(replay.verdict.moved, 1)
                self.assertTrue(replay.box_outcomes["moved"][0])
            np.testing.assert_array_equal(screen.replay(BOX, 0).displacement, 0.0)
            self.assertEqual(screen.replay(BOX, 1).verdict.state_hash, screen.evaluate([BOX]).state_hash[0, 1])
            self.assertEqual(repr(replay), "<holdfast.Replay of 1 boxes, 16 samples>")

    def test_the_series_are_those_of_the_program(self):
        world = screened(LAYOUTS[:1], [BRAKE])[0]
        with holdfast.Screen([BRAKE], unit="cm") as screen:
            replay = screen.replay(screen.read_layout(LAYOUTS[0]))
        self.assertEqual(f"{int(replay.verdict.state_hash):016x}", world["state_hash"])
        end = np.linalg.norm(replay.displacement[-1], axis=-1).max()
        self.assertEqual(np.float32(end), np.float32(replay.verdict.end_displacement))

    def test_what_cannot_be_replayed_is_an_error(self):
        with holdfast.Screen([SLIDE], errors="mark") as screen:
            with self.assertRaises(holdfast.Error):
                screen.replay(-BOX)
            with self.assertRaisesRegex(ValueError, "no acceleration is called 'none'"):
                screen.replay(BOX, "none")
            with self.assertRaises(IndexError):
                screen.replay(BOX, 1)
            with self.assertRaises(TypeError):
                screen.replay(BOX, 0.5)


if __name__ == "__main__":
    main()
