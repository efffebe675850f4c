"""Wall forces, damage and indicators from Python, against exact values and against the program's file."""
import os
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

import holdfast

# A row of three boxes at the front wall, without friction, and a box that the wall has to catch at 1 m/s.
ROW = np.array([[1.0 * i, 0.0, 0.0, 1.0 * (i + 1), 1.0, 0.4, 1] for i in range(3)])
CAUGHT = np.array([[0.1, 0.0, 0.0, 1.1, 1.0, 0.4, 1]])
BRAKE = [[0.0, 0.5, 5.0, 0.0, 0.0]]
MASS = 100.0
SLIPPERY = "[Contact]\nFrictionModel = pairs\nBoxBox = 0\nBoxFloor = 0\nBoxWall = 0\n"


class Analyses(unittest.TestCase):
    def evaluate(self, screening, **options):
        with holdfast.Screen([BRAKE], config=SLIPPERY + f"[Screening]\n{screening}\n", keep_boxes=True, **options) as screen:
            return screen.evaluate([ROW, CAUGHT], names=["row.txt", "caught.txt"])

    def test_walls(self):
        verdicts = self.evaluate("Walls = en283")
        np.testing.assert_allclose(verdicts.wall_front[0], 3 * MASS * 5.0, rtol=1e-3)
        np.testing.assert_allclose(verdicts.wall_floor[0], 3 * MASS * 9.81, rtol=1e-3)
        np.testing.assert_allclose(verdicts.wall_share[0], 5.0 / (0.4 * 9.81), rtol=1e-3)
        self.assertEqual((verdicts.wall_rear[0, 0], verdicts.wall_roof[0, 0]), (0, 0))
        self.assertTrue(np.isnan(self.evaluate("WallForces = true").wall_share).all())
        without = self.evaluate("")
        self.assertTrue(np.isnan(without.wall_front).all())
        self.assertEqual(len(without.frame()), 2)

    def test_damage(self):
        verdicts = self.evaluate("Damage = true\nCriticalAcceleration = 4\nCriticalVelocityChange = 0.9")
        self.assertEqual(verdicts.boxes_beyond.tolist(), [[0], [1]])
        np.testing.assert_allclose(verdicts.velocity_change[:, 0], [0, 1], atol=0.03)
        np.testing.assert_allclose(verdicts.peak_acceleration[:, 0], [5, 52.5], atol=2.6)
        boxes = verdicts.box_outcomes(1)
        self.assertEqual(boxes["beyond"].tolist(), [[True]])
        self.assertEqual(boxes["velocity_change"][0, 0], verdicts.velocity_change[1, 0])
        without = self.evaluate("")
        self.assertTrue(np.isnan(without.peak_acceleration).all())
        self.assertTrue(np.isnan(without.box_outcomes(0)["velocity_change"]).all())

    def test_indicators(self):
        with holdfast.Screen([BRAKE]) as screen:
            indicators = screen.indicators([ROW, CAUGHT], names=["row", "caught"])
        np.testing.assert_allclose(indicators.fill, np.array([1.2, 0.4]) / (5.87 * 2.33 * 2.2))
        np.testing.assert_allclose(indicators.centre_of_gravity, [[1.5, 0.5, 0.2], [0.6, 0.5, 0.2]])
        self.assertEqual(indicators.supported_sides[0].tolist(), [3, 3, 2])
        self.assertEqual(indicators.base_support[1].tolist(), [1])
        self.assertEqual(indicators.badly_braced.round(3).tolist(), [0.333, 1])
        frame = indicators.frame()
        self.assertEqual(frame["name"].tolist(), ["row", "caught"])
        self.assertIn("2 layouts", repr(indicators))

    def test_a_bad_layout_has_no_indicators(self):
        bad = ROW.copy()
        bad[1, 5] = -1
        with holdfast.Screen([BRAKE], errors="mark") as screen:
            indicators = screen.indicators([ROW, bad])
        self.assertEqual(np.isnan(indicators.fill).tolist(), [False, True])
        self.assertEqual(len(indicators.base_support[1]), 0)
        self.assertEqual([problem.layout for problem in indicators.problems], [1])
        with holdfast.Screen([BRAKE]) as screen, self.assertRaises(holdfast.Error):
            screen.indicators([ROW, bad])

    def test_the_numbers_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            np.savetxt(f"{folder}/row.txt", ROW * [100, 100, 100, 100, 100, 100, 1],
                       "%.17g", header="1 3", comments="")
            np.savetxt(f"{folder}/brake.txt", BRAKE, "%.17g")
            with open(f"{folder}/config.ini", "w", encoding="utf-8") as file:
                file.write(SLIPPERY)
            subprocess.run([os.environ["HOLDFAST"], "screen", "-c", f"{folder}/config.ini", "--layouts", f"{folder}/row.txt",
                            "--accelerations", f"{folder}/brake.txt", "--walls", "en283", "--damage", "--indicators",
                            "--quiet", "-o", f"{folder}/results.h5"], check=False)
            verdicts = self.evaluate("Walls = en283\nDamage = true")
            with holdfast.Screen([BRAKE]) as screen:
                indicators = screen.indicators([ROW])
            with h5py.File(f"{folder}/results.h5") as file:
                self.assertEqual(file["walls/lasting_force"][0, 1], verdicts.wall_front[0, 0])
                self.assertEqual(file["damage/peak_acceleration"][:].max(), verdicts.peak_acceleration[0, 0])
                self.assertEqual(file["indicators/fill"][0], indicators.fill[0])
                np.testing.assert_array_equal(file["indicators/supported_sides"][:], indicators.supported_sides[0])


if __name__ == "__main__":
    unittest.main()
