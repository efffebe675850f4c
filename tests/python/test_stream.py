"""Layouts that are evaluated as they are asked for."""
import itertools
import unittest

import numpy as np

import holdfast
from samples import BOX, LONG_LAYOUT, REST, SLIDE, main


def moved_by(number):
    """A box that stands a little further along the container for every number."""
    return BOX + [0.001 * number, 0, 0, 0.001 * number, 0, 0, 0]


class StreamTest(unittest.TestCase):
    def setUp(self):
        self.screen = holdfast.Screen([SLIDE, REST], accuracy="screening", threads=2, most_in_flight=5)
        self.addCleanup(self.screen.close)

    def test_every_layout_comes_with_its_index_and_the_bits_of_evaluate(self):
        layouts = [moved_by(i) for i in range(40)]
        expected = self.screen.evaluate(layouts).state_hash
        for ordered in (True, False):
            found = list(self.screen.stream(layouts, ordered=ordered))
            indices = [index for index, _ in found]
            self.assertEqual(sorted(indices), list(range(40)))
            if ordered:
                self.assertEqual(indices, list(range(40)))
            for index, verdicts in found:
                self.assertEqual(verdicts.shape, (2,))
                np.testing.assert_array_equal(verdicts.layout, [index, index])
                np.testing.assert_array_equal(verdicts.state_hash, expected[index])

    def test_no_more_layouts_are_taken_than_there_is_room_for(self):
        taken = []

        def endless():
            for i in itertools.count():
                taken.append(i)
                yield moved_by(i % 100)

        for index, _ in itertools.islice(self.screen.stream(endless(), ordered=True), 20):
            self.assertLessEqual(len(taken), index + 7)
        self.assertLess(len(taken), 30)
        self.assertEqual(self.screen.evaluate([BOX]).shape, (1, 2))

    def test_a_bad_layout_is_an_error_with_its_index_or_marked(self):
        layouts = [BOX, BOX, -BOX]
        with self.assertRaisesRegex(holdfast.Error, "^layout 2: ") as caught:
            list(self.screen.stream(layouts))
        self.assertEqual((caught.exception.layout, caught.exception.box), (2, 0))
        with self.assertRaisesRegex(holdfast.Error, "^layout 1: a wrong shape") as caught:
            list(self.screen.stream([BOX, BOX[:, :6]]))
        self.assertEqual(caught.exception.layout, 1)
        with self.assertRaisesRegex(holdfast.Error, "layout 1"):
            list(self.screen.stream([BOX, None, BOX]))
        with holdfast.Screen([SLIDE], errors="mark", keep_boxes=True) as screen:
            found = dict(screen.stream(layouts, names=["a", "b", "c"]))
        self.assertIn("c: the material of box 1", found[2].messages[2, 0])
        self.assertEqual(found[2].problems[0].layout, 2)
        self.assertEqual(found[1].box_outcomes(1).shape, (1, 1))

    def test_a_screen_has_one_stream_at_a_time(self):
        first = self.screen.stream([BOX] * 20)
        next(first)
        with self.assertRaisesRegex(RuntimeError, "a stream already"):
            next(self.screen.stream([BOX]))
        self.assertEqual(self.screen.evaluate([BOX]).shape, (1, 2))
        first.close()
        self.assertEqual(len(list(self.screen.stream([BOX]))), 1)
        self.screen.stream([BOX])  # never begun
        self.assertEqual(len(list(self.screen.stream([]))), 0)

    def test_cancel_drops_what_is_in_flight(self):
        with holdfast.Screen([SLIDE], accuracy="reference", unit="cm", threads=1) as screen:
            layout = screen.read_layout(LONG_LAYOUT)
            stream = screen.stream([BOX * 100, layout, layout, layout], ordered=True)
            next(stream)
            screen.cancel()
            left = [verdicts for _, verdicts in stream]
        self.assertEqual(len(left), 3)
        self.assertEqual(int(left[-1].stop_reason[0]), holdfast.StopReason.NOT_RUN)
        self.assertEqual(left[-1].messages, {(3, 0): "cancelled"})

    def test_a_stream_of_a_closed_screen_ends_with_an_error(self):
        stream = self.screen.stream([BOX] * 20)
        next(stream)
        self.screen.close()
        with self.assertRaisesRegex(ValueError, "closed"):
            next(stream)


if __name__ == "__main__":
    main()
