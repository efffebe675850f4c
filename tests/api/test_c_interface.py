"""The C interface from a foreign language: Python's ctypes calls the shared library as any other language would, and gets
the bits of the program. And what the library shows to the linker."""
import ctypes
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import unittest
from ctypes import POINTER, byref, c_char_p, c_double, c_float, c_int, c_int32, c_int64, c_size_t, c_uint32, c_uint64, c_void_p

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LIBRARY = pathlib.Path(os.environ["HOLDFAST_LIBRARY"])
PROGRAM = pathlib.Path(os.environ["HOLDFAST"])
HEADER = SOURCE / "include/holdfast/holdfast.h"
ACCELERATION = SOURCE / "configs/accelerations/road_brake_0g8.txt"
LAYOUTS = [SOURCE / "configs/layouts" / name for name in ("seed_example.txt", "BR0_012_block.txt")]
PATIENCE = 60  # s

OK, ERROR, BAD_ARGUMENT, BAD_HANDLE, IN_USE, CANCELLED = range(6)
CENTIMETRE = 1


class ScreenOptions(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("engine", c_char_p), ("accuracy", c_char_p), ("scheduler", c_char_p),
                ("threads", c_int32), ("unit", c_int32), ("mark_bad_layouts", c_int32), ("keep_boxes", c_int32),
                ("most_in_flight", c_size_t)]


class Layouts(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("boxes", POINTER(c_double)), ("box_count", c_size_t),
                ("offsets", POINTER(c_size_t)), ("layout_count", c_size_t), ("names", POINTER(c_char_p))]


class Outcome(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("layout", c_uint64), ("acceleration", c_uint64), ("verdict", c_int32),
                ("status", c_uint32), ("status_time", c_double), ("caveats", c_uint32), ("stop_reason", c_int32),
                ("boxes", c_uint32), ("fallen", c_uint32), ("unstable", c_uint32), ("moved", c_uint32), ("tilted", c_uint32),
                ("fallen_at_end", c_uint32), ("critical_box", c_uint32), ("peak_displacement", c_float),
                ("peak_drop", c_float), ("peak_tilt", c_float), ("end_displacement", c_float),
                ("peak_kinetic_energy", c_double), ("end_kinetic_energy", c_double), ("end_time", c_double),
                ("steps", c_uint64), ("steps_skipped", c_uint64), ("max_residual", c_double), ("residual_scale", c_double),
                ("max_penetration", c_double), ("cpu_seconds", c_double), ("state_hash", c_uint64)]


def loaded():
    """The library, with the types of the functions that the tests call."""
    library = ctypes.CDLL(str(LIBRARY))
    library.holdfast_version.restype = c_char_p
    library.holdfast_screen_new.argtypes = [c_void_p, POINTER(ScreenOptions), POINTER(c_void_p)]
    library.holdfast_screen_free.argtypes = [c_void_p]
    library.holdfast_screen_free.restype = None
    library.holdfast_screen_add_acceleration.argtypes = [c_void_p, c_char_p, POINTER(c_double), c_size_t]
    library.holdfast_screen_evaluate.argtypes = [c_void_p, POINTER(Layouts), POINTER(Outcome), c_size_t]
    library.holdfast_screen_submit.argtypes = [c_void_p, POINTER(c_double), c_size_t, POINTER(c_uint64)]
    library.holdfast_screen_cancel.argtypes = [c_void_p]
    library.holdfast_screen_message.argtypes = [c_void_p]
    library.holdfast_screen_message.restype = c_char_p
    library.holdfast_screen_error_count.argtypes = [c_void_p]
    library.holdfast_screen_error_count.restype = c_size_t
    return library


def rows(path, columns):
    """The numbers of a file of layouts or accelerations below its header."""
    return [[float(word) for word in line.split()[:columns]] for line in path.read_text().splitlines()[1:] if line.strip()]


def numbers_of(table):
    flat = [number for row in table for number in row]
    return (c_double * len(flat))(*flat)


class Screened:
    """A screen of the C interface with one acceleration, and layouts for it."""

    def __init__(self, library, paths=LAYOUTS, **options):
        self.library = library
        self.screen = c_void_p()
        given = ScreenOptions(size=ctypes.sizeof(ScreenOptions), unit=CENTIMETRE, **options)
        self.status = library.holdfast_screen_new(None, byref(given), byref(self.screen))
        segments = rows(ACCELERATION, 5)
        self.status |= library.holdfast_screen_add_acceleration(self.screen, b"brake", numbers_of(segments), len(segments))
        tables = [rows(path, 7) for path in paths]
        self.boxes = numbers_of([row for table in tables for row in table])
        ends = [sum(map(len, tables[:i])) for i in range(len(tables) + 1)]
        self.offsets = (c_size_t * len(ends))(*ends)
        self.layouts = Layouts(ctypes.sizeof(Layouts), self.boxes, ends[-1], self.offsets, len(tables), None)
        self.outcomes = (Outcome * len(tables))()
        if tables:
            self.outcomes[0].size = ctypes.sizeof(Outcome)

    def evaluate(self):
        return self.library.holdfast_screen_evaluate(self.screen, byref(self.layouts), self.outcomes, len(self.outcomes))

    def evaluate_nothing(self):
        nothing = Layouts(size=ctypes.sizeof(Layouts))
        return self.library.holdfast_screen_evaluate(self.screen, byref(nothing), None, 0)

    def evaluate_in_another_thread(self):
        """Returns when that is under way: the thread, and a list that gets the status in the end."""
        ends = []

        def work():
            while (status := self.evaluate()) == IN_USE:
                pass
            ends.append(status)

        thread = threading.Thread(target=work)
        thread.start()
        while self.evaluate_nothing() == OK:
            pass
        return thread, ends

    def message(self):
        return self.library.holdfast_screen_message(self.screen).decode()

    def free(self):
        self.library.holdfast_screen_free(self.screen)


class ForeignLanguageTest(unittest.TestCase):
    def setUp(self):
        self.library = loaded()

    def program_hashes(self):
        with tempfile.TemporaryDirectory() as folder:
            lines = subprocess.run(
                [PROGRAM, "screen", "--quiet", "--json", "--accuracy", "screening", "--no-series", "--layouts", *LAYOUTS,
                 "--accelerations", ACCELERATION, "-o", "results.h5"],
                cwd=folder, check=True, capture_output=True, text=True).stdout.splitlines()
        return [int(json.loads(line)["state_hash"], 16) for line in lines]

    def test_a_layout_has_the_bits_of_the_program(self):
        screened = Screened(self.library, accuracy=b"screening")
        self.assertEqual((screened.status, screened.evaluate(), screened.message()), (OK, OK, ""))
        self.assertEqual([outcome.state_hash for outcome in screened.outcomes], self.program_hashes())
        screened.free()

    def test_a_second_thread_is_told_that_the_screen_is_in_use(self):
        screened = Screened(self.library, [LAYOUTS[1]] * 40, accuracy=b"reference", threads=1)
        thread, ends = screened.evaluate_in_another_thread()
        self.assertEqual(screened.evaluate_nothing(), IN_USE)
        self.assertIn("another thread", screened.message())
        self.assertEqual(self.library.holdfast_screen_cancel(screened.screen), OK)
        thread.join(PATIENCE)
        self.assertEqual(ends, [CANCELLED])
        self.assertEqual(screened.message(), "cancelled")
        screened.free()

    def test_a_screen_that_is_freed_while_it_works_ends_the_call(self):
        screened = Screened(self.library, [LAYOUTS[1]] * 40, accuracy=b"reference", threads=2)
        thread, ends = screened.evaluate_in_another_thread()
        screened.free()
        thread.join(PATIENCE)
        self.assertEqual(ends, [CANCELLED])
        self.assertEqual(screened.evaluate(), BAD_HANDLE)

    def test_a_process_may_end_or_fork_with_layouts_in_flight(self):
        script = f"""
import os, sys
sys.path.insert(0, {str(pathlib.Path(__file__).parent)!r})
from test_c_interface import *
library = loaded()
screened = Screened(library, [LAYOUTS[1]], accuracy=b"reference", threads=2)
for _ in range(20):
    assert library.holdfast_screen_submit(screened.screen, screened.boxes, screened.offsets[1], None) == OK
child = os.fork()
if child == 0:
    assert screened.evaluate() == OK
    sys.exit(0)
assert os.waitpid(child, 0)[1] == 0
"""
        done = subprocess.run([sys.executable, "-c", script], timeout=PATIENCE, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class LibraryTest(unittest.TestCase):
    def exported(self):
        lines = subprocess.run(["nm", "-DC", "--defined-only", LIBRARY], check=True, capture_output=True, text=True).stdout
        return [line.split(" ", 2)[2] for line in lines.splitlines()]

    def test_only_the_names_of_the_two_headers_are_exported(self):
        own = re.compile(r"holdfast_\w+$|holdfast::|(vtable|typeinfo|typeinfo name) for holdfast::Error$")
        self.assertEqual([name for name in self.exported() if not own.match(name)], [])
        self.assertEqual([name for name in self.exported() if "internal" in name or "State" in name], [])

    def test_every_function_of_the_header_is_exported_and_no_other(self):
        declared = re.findall(r"^HOLDFAST_API [^(]*?(holdfast_\w+)\(", HEADER.read_text(), re.MULTILINE)
        self.assertEqual(sorted(declared), sorted(name for name in self.exported() if name.startswith("holdfast_")))

    def test_both_headers_can_be_included_in_either_order(self):
        names = ["<holdfast/holdfast.h>", "<holdfast/holdfast.hpp>"]
        for first, second in (names, reversed(names)):
            subprocess.run(["c++", "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{SOURCE / 'include'}",
                            "-x", "c++", "-"], input=f"#include {first}\n#include {second}\n", text=True, check=True)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[1:]])
