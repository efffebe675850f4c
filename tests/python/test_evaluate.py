"""Arrays in, a table of verdicts out."""
import copy
import pickle
import unittest

import numpy as np

import holdfast
from samples import BOX, BRAKE, CORNER, LAYOUTS, REST, SLIDE, SLIDES, STACK, main, screened


class EvaluateTest(unittest.TestCase):
    def test_verdicts_have_the_bits_of_the_program(self):
        worlds = screened(LAYOUTS, [BRAKE, CORNER], "--accuracy", "screening", "--no-series")
        with holdfast.Screen([BRAKE, CORNER], accuracy="screening", unit="cm") as screen:
            verdicts = screen.evaluate([screen.read_layout(path) for path in LAYOUTS])
        self.assertEqual(verdicts.shape, (3, 2))
        self.assertEqual([f"{number:016x}" for number in verdicts.state_hash.ravel().tolist()],
                         [world["state_hash"] for world in worlds])
        self.assertEqual([holdfast.Verdict(code).name.lower() for code in verdicts.verdict.ravel()],
                         [world["verdict"] for world in worlds])

    def test_a_world_may_end_when_its_verdict_is_decided(self):
        with holdfast.Screen([SLIDE, REST], config="[Screening]\nStopWhen = moved\n") as screen:
            verdicts = screen.evaluate([BOX])
        self.assertEqual(verdicts.verdict.tolist(), [[holdfast.Verdict.MOVED, holdfast.Verdict.STAYED]])
        self.assertEqual(verdicts.stop_reason.tolist(), [[holdfast.StopReason.DECIDED, holdfast.StopReason.SLEEPING]])
        self.assertEqual(verdicts.holds.tolist(), [[False, True]])
        self.assertLess(verdicts.end_time[0, 0], verdicts.end_time[0, 1])
        self.assertEqual(list(verdicts.frame()["verdict"]), ["moved", "stayed"])
        self.assertIn(">at least moved, ", verdicts._repr_html_())
        self.assertIn(">stayed, ", verdicts._repr_html_())

    def test_worlds_that_are_not_needed_have_a_name_in_a_data_frame(self):
        with holdfast.Screen([SLIDE, REST], config="[Screening]\nFirstFailure = true\n") as screen:
            verdicts = screen.evaluate([BOX])
        self.assertEqual(list(verdicts.frame()["verdict"]), ["moved", "not_needed"])
        self.assertEqual(repr(verdicts), "<holdfast.Verdicts of shape (1, 2): 1 moved, 1 not_needed>")

    def test_holds_gives_the_answer_of_evaluate(self):
        layouts = [BOX, STACK, BOX - [2, 0, 0, 2, 0, 0, 0], BOX + [0, 0, 0.3, 0, 0, 0.3, 0]]
        flat, offsets = np.concatenate(layouts), np.cumsum([0, *map(len, layouts)])
        with holdfast.Screen([SLIDE, REST]) as screen:
            expected = screen.evaluate(layouts).holds.all(axis=1)
            self.assertEqual(expected.tolist(), [False, False, True, False])
            found = screen.holds(layouts)
            self.assertEqual((found.dtype, found.shape), (np.dtype(bool), (4,)))
            np.testing.assert_array_equal(found, expected)
            np.testing.assert_array_equal(screen.holds(flat, offsets=offsets), expected)
            self.assertEqual(screen.holds([]).shape, (0,))
            with self.assertRaisesRegex(holdfast.Error, "^layout 1: "):
                screen.holds([BOX, -BOX])
        with holdfast.Screen([REST], errors="mark") as screen:
            self.assertEqual(screen.holds([BOX, -BOX]).tolist(), [True, False])

    def test_what_happens_while_a_load_settles_is_not_blamed_on_the_acceleration(self):
        with holdfast.Screen([SLIDE], keep_boxes=True) as screen:
            verdicts = screen.evaluate([BOX + [0, 0, 0.3, 0, 0, 0.3, 0]])
            replay = screen.replay(BOX + [0, 0, 0.3, 0, 0, 0.3, 0])
        self.assertEqual((int(verdicts.verdict[0, 0]), int(verdicts.critical_box[0, 0])), (holdfast.Verdict.UNSTABLE, 1))
        box = verdicts.box_outcomes(0)[0, 0]
        self.assertTrue(box["unstable"])
        self.assertLess(box["first_beyond"], 0)
        self.assertAlmostEqual(float(box["settling_peak_drop"]), 0.3, 2)
        self.assertNotIn("at least", verdicts._repr_html_())
        self.assertTrue((replay.time <= 0).all())

    def test_caveats_stand_beside_verdicts(self):
        with holdfast.Screen([[[0.0, 1.0, 0.5 * 9.81, 0.0, 0.0]], REST]) as screen:
            verdicts = screen.evaluate([BOX])
        self.assertEqual(verdicts.caveats.tolist(), [[holdfast.Caveat.MARGINAL, holdfast.Caveat.OK]])
        self.assertTrue(np.isnan(verdicts.status_time).all())

    def test_layouts_may_be_one_array_with_offsets_or_of_three_dimensions(self):
        with holdfast.Screen([SLIDE, REST]) as screen:
            expected = screen.evaluate([BOX, STACK])
            flat = screen.evaluate(np.concatenate([BOX, STACK]), offsets=np.array([0, 1, 3]))
            cube = screen.evaluate(np.array([BOX, BOX]))
            generated = screen.evaluate(layout for layout in [BOX, STACK])
        np.testing.assert_array_equal(flat.state_hash, expected.state_hash)
        np.testing.assert_array_equal(generated.state_hash, expected.state_hash)
        np.testing.assert_array_equal(cube.state_hash, expected.state_hash[[0, 0]])

    def test_numbers_of_other_kinds_and_orders_are_the_same_layout(self):
        with holdfast.Screen([SLIDE]) as screen:
            expected = screen.evaluate([BOX]).state_hash
            wide = np.zeros((2, 14))
            wide[::2, ::2] = BOX
            for other in (BOX.tolist(), BOX.astype(np.float32), np.asfortranarray(BOX), wide[::2, ::2], BOX[::-1]):
                np.testing.assert_array_equal(screen.evaluate([other]).state_hash, expected)

    def test_columns_are_views_of_one_table(self):
        with holdfast.Screen([SLIDE, REST]) as screen:
            verdicts = screen.evaluate([BOX, STACK])
        self.assertTrue(np.shares_memory(verdicts.peak_displacement, verdicts.table))
        np.testing.assert_array_equal(verdicts.holds, [[False, True], [False, True]])
        np.testing.assert_array_equal(verdicts.boxes, [[1, 1], [2, 2]])
        np.testing.assert_array_equal(verdicts.layout, [[0, 0], [1, 1]])
        np.testing.assert_array_equal(verdicts.acceleration, [[0, 1], [0, 1]])
        self.assertAlmostEqual(float(verdicts.peak_displacement[0, 0]), SLIDES, 2)
        for name in verdicts.table.dtype.names:
            self.assertEqual(getattr(verdicts, name).shape, (2, 2), name)
            self.assertTrue(getattr(holdfast.Verdicts, name).__doc__, name)

    def test_a_part_of_the_verdicts_is_verdicts(self):
        with holdfast.Screen([SLIDE, REST], errors="mark") as screen:
            verdicts = screen.evaluate([BOX, STACK + np.nan, BOX])
        self.assertEqual(verdicts[1].shape, (2,))
        self.assertEqual(verdicts[1, 0].shape, ())
        self.assertEqual(verdicts[::2].shape, (2, 2))
        self.assertEqual(verdicts[verdicts.holds].shape, (2,))
        self.assertEqual(list(verdicts[1].messages), [(1, 0), (1, 1)])
        self.assertEqual(verdicts[2].messages, {})
        self.assertEqual(len(verdicts[1].problems), 2)
        self.assertEqual(verdicts[0].problems, ())
        with self.assertRaisesRegex(TypeError, "column is an attribute"):
            verdicts["moved"]

    def test_boxes_are_there_on_request(self):
        with holdfast.Screen([SLIDE, REST], keep_boxes=True, errors="mark") as screen:
            verdicts = screen.evaluate([STACK, -BOX])
        boxes = verdicts.box_outcomes(0)
        self.assertEqual(boxes.shape, (2, 2))
        self.assertEqual(boxes["end_displacement"].shape, (2, 2, 3))
        for name in boxes.dtype.names:
            self.assertIn(name, holdfast.Verdicts.box_outcomes.__doc__)
        self.assertEqual(int(boxes["moved"][0].sum()), int(verdicts.moved[0, 0]))
        self.assertLess(boxes["end_displacement"][0, 0, 0], -0.5)
        self.assertGreater(boxes["first_beyond"][0, 0], 0)
        self.assertTrue(np.isnan(boxes["first_beyond"][1]).all())
        self.assertEqual(verdicts.box_outcomes(1).shape, (2, 0))
        with holdfast.Screen([SLIDE]) as screen, self.assertRaisesRegex(ValueError, "keep_boxes=True"):
            screen.evaluate([BOX]).box_outcomes(0)

    def test_a_notebook_shows_a_table(self):
        with holdfast.Screen([holdfast.Acceleration("<brake>", SLIDE)]) as screen:
            verdicts = screen.evaluate([BOX] * 30, names=[f"<layout {i}>" for i in range(30)])
        for shown in (verdicts, verdicts[3], verdicts[3, 0], verdicts[:0]):
            page = shown._repr_html_()
            self.assertNotIn("<layout", page)
            self.assertNotIn("<brake", page)
            self.assertEqual(page.count("<tr>"), page.count("</tr>"))
        self.assertIn(">moved, 1.49 m", verdicts._repr_html_())
        self.assertIn("and 10 more layouts", verdicts._repr_html_())
        self.assertIn("and 1 more layout<", verdicts[:21]._repr_html_())
        self.assertEqual(repr(verdicts), "<holdfast.Verdicts of shape (30, 1): 30 moved>")

    def test_settings_are_those_of_a_config_file(self):
        with holdfast.Screen([SLIDE], config="[Screening]\nMoveThreshold = 2\n") as screen:
            self.assertTrue(screen.evaluate([BOX]).holds.all())

    def test_everything_can_be_pickled(self):
        screen = holdfast.Screen([SLIDE, BRAKE], accuracy="screening", unit="cm", errors="mark", keep_boxes=True)
        verdicts = screen.evaluate([BOX * 100, BOX])
        for again in (pickle.loads(pickle.dumps(screen)), copy.copy(screen)):
            self.assertEqual(again.accelerations, screen.accelerations)
            self.assertEqual(repr(again), repr(screen))
            np.testing.assert_array_equal(again.evaluate([BOX * 100, BOX]).state_hash, verdicts.state_hash)
        same = pickle.loads(pickle.dumps(verdicts))
        np.testing.assert_array_equal(same.state_hash, verdicts.state_hash)
        self.assertEqual((same.messages, same.problems), (verdicts.messages, verdicts.problems))
        for name in verdicts.box_outcomes(0).dtype.names:  # column by column: NaN is equal to itself there
            np.testing.assert_array_equal(same.box_outcomes(0)[name], verdicts.box_outcomes(0)[name])

    def test_a_norm_comes_before_what_is_given(self):
        road = ["road-front-0g8", "road-rear-0g5", "road-left-0g5", "road-right-0g5"]
        self.assertEqual([one.name for one in holdfast.norm_accelerations("road")], road)
        screen = holdfast.Screen([REST], norm="road", accuracy="screening")
        self.assertEqual([one.name for one in screen.accelerations], [*road, "acceleration 0"])
        verdicts = screen.evaluate([BOX])
        for again in (pickle.loads(pickle.dumps(screen)), holdfast.Screen([REST], config="[Screening]\nNorm = road\n[Native]\n"
                                                                                       "Accuracy = screening\n")):
            self.assertEqual(again.accelerations, screen.accelerations)
            np.testing.assert_array_equal(again.evaluate([BOX]).state_hash, verdicts.state_hash)
        replay = screen.replay(BOX, "road-front-0g8")
        self.assertEqual(replay.verdict.state_hash, verdicts.state_hash[0, 0])
        with self.assertRaisesRegex(holdfast.Error, "did you mean road"):
            holdfast.Screen(norm="raod")
        with self.assertRaisesRegex(ValueError, "or a norm"):
            holdfast.Screen()

    def test_worlds_of_accelerations_for_sliding_alone_do_not_end_early(self):
        early = "[Screening]\nStopWhen = moved\n"
        rail = holdfast.norm_accelerations("rail-en12195")
        self.assertEqual({one.purpose for one in rail}, {"sliding", "tipping"})
        screen = holdfast.Screen(norm="rail-en12195", config=early)
        self.assertEqual(list(screen.accelerations), rail)
        verdicts = screen.evaluate([BOX])
        self.assertIn(holdfast.Verdict.MOVED, verdicts.verdict)
        self.assertNotIn(holdfast.StopReason.DECIDED, verdicts.stop_reason)
        for again in (pickle.loads(pickle.dumps(screen)), holdfast.Screen(rail, config=early)):
            np.testing.assert_array_equal(again.evaluate([BOX]).state_hash, verdicts.state_hash)
        self.assertEqual(screen.replay(BOX, 0).verdict.state_hash, verdicts.state_hash[0, 0])

    def test_an_acceleration_is_a_value(self):
        one = holdfast.Acceleration("one", SLIDE)
        self.assertEqual(one, pickle.loads(pickle.dumps(one)))
        self.assertEqual(hash(one), hash(holdfast.Acceleration("one", SLIDE)))
        self.assertNotEqual(one, holdfast.Acceleration("two", SLIDE))
        sliding = holdfast.Acceleration("one", SLIDE, "sliding")
        self.assertNotEqual(one, sliding)
        self.assertEqual(pickle.loads(pickle.dumps(sliding)), sliding)
        with self.assertRaises(ValueError):
            one.segments[0, 0] = 1.0
        self.assertEqual(holdfast.read_acceleration(BRAKE).segments.shape[1], 5)


if __name__ == "__main__":
    main()
