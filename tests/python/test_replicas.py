"""Replicas as columns of the table of verdicts."""
import unittest

import numpy as np

import holdfast
from samples import BOX, CORNER, LAYOUTS, REST, main, screened


class ReplicasTest(unittest.TestCase):
    def test_are_those_of_the_program(self):
        expected = [world["replicas"] for world in
                    screened(LAYOUTS, [CORNER], "--replicas", 32, "--accuracy", "screening")]
        with holdfast.Screen([CORNER], accuracy="screening", unit="cm", config="[Screening]\nReplicas = 32\n") as screen:
            verdicts = screen.evaluate([screen.read_layout(path) for path in LAYOUTS])
        self.assertEqual(verdicts.replicas.ravel().tolist(), [world["count"] for world in expected])
        self.assertEqual(verdicts.replicas_failed.ravel().tolist(), [world["failed"] for world in expected])
        self.assertEqual([holdfast.ReplicaVerdict(code).name.lower() for code in verdicts.replica_verdict.ravel()],
                         [world["verdict"] for world in expected])
        np.testing.assert_array_equal(np.hstack([verdicts.wilson_low, verdicts.wilson_high]),
                                      [world["wilson_95"] for world in expected])

    def test_are_none_where_they_are_not_asked_for(self):
        with holdfast.Screen([REST]) as screen:
            verdicts = screen.evaluate([BOX])
        self.assertEqual(verdicts.replicas.tolist(), [[0]])
        self.assertEqual(verdicts.replica_verdict.tolist(), [[holdfast.ReplicaVerdict.NONE]])
        self.assertTrue(np.isnan(verdicts.wilson_low).all())


if __name__ == "__main__":
    main()
