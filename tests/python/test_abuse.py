"""What a program may do wrong: it gets an exception, and never a crash."""
import signal
import threading
import time
import unittest

import numpy as np

import holdfast
from samples import BOX, LONG_LAYOUT, PATIENCE, REST, SLIDE, in_another_process, main

# A screen that works for minutes, in a script.
LONG = """
import holdfast, os, signal, threading, time
screen = holdfast.Screen([BRAKE], accuracy="reference", unit="cm", threads=2)
layouts = [screen.read_layout(LONG_LAYOUT)] * 200
"""

# What can be meant as a layout and is none, and what is said of it.
WRONG_SHAPES = [
    (BOX[:, :6], r"a wrong shape: \(1, 6\)"),
    (np.zeros((7, 6)), r"a wrong shape: \(7, 6\)"),
    (np.zeros((0, 6)), r"a wrong shape: \(0, 6\)"),
    (BOX[0], r"a wrong shape: \(7,\)"),
    (BOX[None], r"a wrong shape: \(1, 1, 7\)"),
    (np.array(1.0), r"a wrong shape: \(\)"),
    ([[1, 2], [3]], "no array of numbers: list"),
    ([["a box"]], "no array of numbers: list"),
    (np.array([BOX[0], None], dtype=object), "no array of numbers: ndarray"),
    (np.ma.masked_array(BOX, BOX > 1e9), "no array of numbers: MaskedArray of float64"),
    (BOX + 0j, "no array of numbers: ndarray of complex128"),
    (BOX.astype("S"), r"no array of numbers: ndarray of \|S32"),
    (BOX.astype("U"), r"no array of numbers: ndarray of <U32"),
    (BOX.astype("M8[s]"), r"no array of numbers: ndarray of datetime64\[s\]"),
    (BOX.astype("m8[s]"), r"no array of numbers: ndarray of timedelta64\[s\]"),
    (BOX > 0, "no array of numbers: ndarray of bool"),
    ([[b"1"] * 7], "no array of numbers: list"),
]


class InputTest(unittest.TestCase):
    def setUp(self):
        self.screen = holdfast.Screen([SLIDE, REST])
        self.addCleanup(self.screen.close)

    def check(self, layouts, message, place=(None, None, None), **options):
        with self.assertRaisesRegex(holdfast.Error, message) as caught:
            self.screen.evaluate(layouts, **options)
        error = caught.exception
        self.assertEqual((error.layout, error.box, error.column), place)
        self.assertTrue(error.what and error.accepted is not None)

    def test_wrong_shapes(self):
        self.check([BOX, BOX[:, :6]], r"layout 1: a wrong shape: \(1, 6\); an array of shape \(boxes, 7\)", (1, None, None))
        self.check(BOX, r"layout 0: a wrong shape: \(7,\); .* a single layout goes into a list", (0, None, None))
        for layout, message in WRONG_SHAPES:
            self.check([BOX, layout], f"^layout 1: {message}", (1, None, None))
            self.check([BOX, layout], f"^mine: {message}", (1, None, None), names=["", "mine"])
        self.check([BOX, np.zeros((0, 7))], "^layout 1: has no boxes", (1, None, None))
        self.check([[]], "^layout 0: has no boxes", (0, None, None))
        for thing in ("a box", b"a box", None, 1.0, {}, {1}, object()):
            self.check([BOX, thing], "^layout 1 is no array of numbers", (1, None, None))
        self.check(BOX[:, :6], "array of boxes has a wrong shape", offsets=[0, 1])
        for offsets, layout in (([0, 2], 0), ([0, 1, 0], 1), ([-1, 1], 0), ([0, 2**62], 0)):
            self.check(BOX, "has offsets that are none", (layout, None, None), offsets=offsets)
        for offsets in ([], [[0, 1]], ["a"], 1, [0, 1.5], np.ma.masked_array([0, 1]), [0j, 1j], [b"0", b"1"]):
            self.check(BOX, "offsets have a wrong type or shape", offsets=offsets)
        self.check([BOX], "there are 2 names and 1 layouts", names=["a", "b"])
        with self.assertRaises(TypeError):
            self.screen.evaluate(3)
        with self.assertRaises(TypeError):
            self.screen.evaluate([BOX], names=[1])

    def test_segments_and_needs_that_are_no_numbers(self):
        segments = np.array([[0, 1, 5, 0, 0]])
        for wrong in (segments + 0j, segments.astype("S"), segments.astype("M8[s]"), np.ma.masked_array(segments), [["0", 1, 5, 0, 0]]):
            with self.assertRaisesRegex(holdfast.Error, "^acceleration brake is no array of numbers: "):
                holdfast.Acceleration("brake", wrong)
            with self.assertRaisesRegex(holdfast.Error, "is no array of numbers"):
                holdfast.Screen([wrong])
        margins = self.screen.margins([BOX])
        with self.assertRaisesRegex(holdfast.Error, "needed is no array of numbers"):
            margins.over([0.8j, 0.5, 0.5, 0.5])

    def test_wrong_shapes_may_be_marked(self):
        layouts = [BOX, *(layout for layout, _ in WRONG_SHAPES), BOX]
        with holdfast.Screen([SLIDE, REST], errors="mark", keep_boxes=True) as screen:
            verdicts = screen.evaluate(layouts)
            streamed = dict(screen.stream(layouts))
            with self.assertRaisesRegex(holdfast.Error, "layout 1 is no array of numbers: str"):
                screen.evaluate([BOX, "a box"])
        self.assertEqual([problem.layout for problem in verdicts.problems], list(range(1, len(layouts) - 1)))
        for i, (_, message) in enumerate(WRONG_SHAPES, 1):
            for marked in (verdicts[i], streamed[i]):
                self.assertEqual(marked.status.tolist(), [holdfast.Status.BAD_LAYOUT] * 2)
                self.assertRegex(marked.messages[i, 1], f"^layout {i}: {message}")
                self.assertEqual(marked.problems[0].layout, i)
            self.assertEqual(verdicts.box_outcomes(i).shape, (2, 0))
        np.testing.assert_array_equal(verdicts.state_hash[0], self.screen.evaluate([BOX]).state_hash[0])
        np.testing.assert_array_equal(verdicts.state_hash[0], verdicts.state_hash[-1])

    def test_numbers_that_are_none(self):
        for column in range(6):
            for number in (np.nan, np.inf, -np.inf):
                layout = np.concatenate([BOX, BOX + [1, 0, 0, 1, 0, 0, 0]])
                layout[1, column] = number
                self.check([BOX, layout], "layout 1: box 2 has a corner that is not finite", (1, 1, column))
        for material in (-1, 0.5, np.nan, np.inf, 1e300):
            self.check([BOX[:, :6].tolist()[0:0] or np.append(BOX[:, :6], [[material]], axis=1)],
                       "material of box 1 is not an id", (0, 0, 6))

    def test_boxes_that_are_none(self):
        self.check([BOX[:, [3, 1, 2, 0, 4, 5, 6]]], "negative length: -50 cm", (0, 0, 3))
        self.check([BOX * [1, 1, 1, 1, 1, 0, 1]], "has no height", (0, 0, 5))
        self.check([BOX + [0, 0, -1, 0, 0, 0, 0]], "outside the container", (0, 0, 2))
        self.check([np.concatenate([BOX, BOX])], "box 2 overlaps box 1", (0, 1, None))
        self.check([BOX * 100], "seem to be centimetres", (0, None, None))
        self.check([np.tile(BOX, (30000, 1))], "too many boxes: 30000", (0, None, None))

    def test_options_that_are_none(self):
        for options, message in (({"accuracy": "perfect"}, "unknown accuracy"), ({"engine": "warp"}, "warp"),
                                 ({"threads": -1}, "Threads"), ({"scheduler": "chance"}, "Scheduler"),
                                 ({"config": "[Container]\nLenght = 1\n"}, "config:2:1: unknown key"),
                                 ({"unit": "mm"}, "unit is 'mm'"), ({"errors": "ignore"}, "errors is 'ignore'")):
            with self.assertRaisesRegex(ValueError, message):
                holdfast.Screen([SLIDE], **options)
        with self.assertRaisesRegex(ValueError, "at least one acceleration"):
            holdfast.Screen([])
        for acceleration in ([[0, 1, 2]], [], [[0, -1, 0, 0, 0]], [[0, 1, np.nan, 0, 0]], "nowhere.txt"):
            with self.assertRaises(holdfast.Error):
                holdfast.Screen([acceleration])
        for options in ({"threads": "two"}, {"config": None}, {"most_in_flight": -1}, {"accuracy": 1}):
            with self.assertRaises(TypeError):
                holdfast.Screen([SLIDE], **options)
        with self.assertRaises(TypeError):
            holdfast.Screen("one.txt")
        with self.assertRaisesRegex(holdfast.Error, "config") as caught:
            holdfast.Screen([SLIDE], config="[Container]\nLength = long\n")
        self.assertEqual((caught.exception.problems[0].line, caught.exception.problems[0].character), (2, 10))


class LifeTest(unittest.TestCase):
    def test_a_closed_screen_raises(self):
        with holdfast.Screen([SLIDE]) as screen:
            pass
        self.assertTrue(screen.closed)
        self.assertIn("closed", repr(screen))
        screen.close()
        screen.cancel()
        for call in (lambda: screen.evaluate([BOX]), lambda: screen.holds([BOX]), lambda: screen.record([BOX], "x.h5"),
                     lambda: screen.replay(BOX), lambda: next(screen.stream([BOX])), lambda: screen.read_layout("x"),
                     screen.__enter__):
            with self.assertRaisesRegex(ValueError, "the screen is closed"):
                call()

    def test_two_threads_take_turns(self):
        with holdfast.Screen([SLIDE, REST], threads=2) as screen:
            expected = screen.evaluate([BOX]).state_hash
            found = []
            threads = [threading.Thread(target=lambda: found.extend(screen.evaluate([BOX] * 5) for _ in range(20)))
                       for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join(PATIENCE)
        self.assertEqual(len(found), 80)
        for verdicts in found:
            np.testing.assert_array_equal(verdicts.state_hash, np.repeat(expected, 5, axis=0))

    def test_another_thread_may_cancel_or_close(self):
        for end in ("cancel", "close"):
            screen = holdfast.Screen([SLIDE], accuracy="reference", unit="cm", threads=1)
            layouts = [screen.read_layout(LONG_LAYOUT)] * 200
            timer = threading.Timer(0.2, getattr(screen, end))
            timer.start()
            verdicts = screen.evaluate(layouts)
            timer.join(PATIENCE)
            self.assertEqual(int(verdicts.stop_reason[-1, 0]), holdfast.StopReason.NOT_RUN)
            self.assertEqual(verdicts[-1].messages, {(199, 0): "cancelled"})
            self.assertEqual(screen.closed, end == "close")
            screen.close()

    def test_other_threads_run_while_a_screen_works(self):
        with holdfast.Screen([SLIDE], accuracy="reference", unit="cm", threads=1) as screen:
            layouts = [screen.read_layout(LONG_LAYOUT)] * 200
            ticks = []
            timer = threading.Timer(0.5, screen.cancel)
            thread = threading.Thread(target=lambda: [(ticks.append(i), time.sleep(0.01)) for i in range(10)])
            timer.start()
            thread.start()
            screen.evaluate(layouts)
            timer.join(PATIENCE)
        self.assertEqual(len(ticks), 10)
        thread.join(PATIENCE)


class ProcessTest(unittest.TestCase):
    def check(self, script, **options):
        done = in_another_process(LONG + script, **options)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)

    def test_ctrl_c_ends_every_call(self):
        self.check("""
import tempfile
def interrupted(call):
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    try:
        call()
    except KeyboardInterrupt:
        return True
    return False
folder = tempfile.mkdtemp()
assert interrupted(lambda: screen.evaluate(layouts))
assert interrupted(lambda: screen.holds(layouts))
assert interrupted(lambda: list(screen.stream(layouts)))
assert interrupted(lambda: screen.record(layouts, folder + "/results.h5"))
assert interrupted(lambda: screen.replay(layouts[0]))
assert screen.evaluate([BOX * 100]).shape == (1, 1)
""")

    def test_a_signal_handler_may_not_use_the_screen_that_works(self):
        self.check("""
def handle(number, frame):
    try:
        screen.evaluate(layouts[:1])
    except RuntimeError as error:
        print(error)
        screen.cancel()
signal.signal(signal.SIGALRM, handle)
signal.setitimer(signal.ITIMER_REAL, 0.3)
verdicts = screen.evaluate(layouts)
assert verdicts.stop_reason[-1, 0] == holdfast.StopReason.NOT_RUN
""")

    def test_a_forked_process_has_a_screen_of_its_own(self):
        self.check("""
small = [BOX * 100] * 20
expected = screen.evaluate(small).state_hash
stream = screen.stream(small)
next(stream)
worker = threading.Thread(target=lambda: screen.evaluate(layouts))
worker.start()
time.sleep(0.2)
child = os.fork()
if child == 0:
    assert (screen.evaluate(small).state_hash == expected).all()
    try:
        list(stream)
    except RuntimeError:
        os._exit(0 if len(list(screen.stream(small))) == 20 else 2)
    os._exit(1)
assert os.waitpid(child, 0)[1] == 0
screen.cancel()
worker.join()
""")

    def test_the_interpreter_may_end_with_work_in_flight(self):
        self.check("""
stream = screen.stream(layouts)
threading.Thread(target=lambda: next(stream), daemon=True).start()
other = holdfast.Screen([BRAKE], accuracy="reference", unit="cm")
threading.Thread(target=lambda: other.evaluate(layouts), daemon=True).start()
time.sleep(0.2)
""")

    def test_an_end_by_sigterm_takes_no_time(self):
        begin = time.monotonic()
        done = in_another_process(LONG + "threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGTERM)).start()\n"
                                  "screen.evaluate(layouts)")
        self.assertEqual(done.returncode, -signal.SIGTERM)
        self.assertLess(time.monotonic() - begin, PATIENCE)


if __name__ == "__main__":
    main()
