"""holdfast serve: a line of JSON in, a line of JSON out, with the bits of `screen`; whatever comes in, it goes on."""
import contextlib
import json
import os
import pathlib
import random
import select
import signal
import subprocess
import threading
import unittest

from cli import HOLDFAST, PATIENCE, SANITIZED, SEED, TOWER, CliTest, wait_for

ACCELERATION = "0 0.25 0 0 0\n0.25 0.5 8 0 0\n"
ONE_BOX = [[1.0, 1.0, 0.0, 1.5, 1.5, 0.5, 1]]
PUMP = {"corner_min": [1.0, 1.0, 0.0], "corner_max": [1.5, 1.5, 0.5], "name": "Pump"}
CONFIG = "[Native]\nAccuracy = screening\n"


def rows(boxes):
    """Boxes of a layout file as rows of seven numbers."""
    return [[*box, 1] for box in boxes]


def line(**request):
    return json.dumps(request) + "\n"


class Service(CliTest):
    def setUp(self):
        super().setUp()
        self.write("config.ini", CONFIG)
        self.write("shove.txt", ACCELERATION)
        self.write("rest.txt", "0 0.5 0 0 0\n")
        self.arguments = ("serve", "-c", "config.ini", "--accelerations", "shove.txt", "rest.txt")

    def serve(self, text, *more, expect=0, **options):
        """The answers to a whole input, in the order in which they come."""
        done = self.run_here(*self.arguments, *more, input=text, **options)
        self.assert_exit(done, expect)
        return [json.loads(answer) for answer in done.stdout.splitlines()]

    def begin(self, *more, **options):
        """A service with both ends of its pipes in the hands of the test."""
        service = subprocess.Popen([HOLDFAST, *self.arguments, *more], cwd=self.folder, stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)
        self.addCleanup(service.stderr.close)
        self.addCleanup(service.stdout.close)
        self.addCleanup(service.stdin.close)
        self.addCleanup(service.wait, PATIENCE)
        self.addCleanup(service.kill)
        return service

    def ask(self, service, **request):
        """One answer to one line."""
        service.stdin.write(line(**request).encode())
        service.stdin.flush()
        self.assertTrue(select.select([service.stdout], [], [], PATIENCE)[0], "no answer")
        return json.loads(service.stdout.readline())


class Answers(Service):
    def test_the_same_as_screen(self):
        paths = sorted((pathlib.Path(__file__).resolve().parents[2] / "configs/layouts").glob("BR*.txt"))[:4]
        done = self.run_here("screen", "-c", "config.ini", "--layouts", *paths, "--accelerations", "shove.txt",
                             "rest.txt", "--json", "--quiet")
        self.assert_exit(done, 0)
        expected = [json.loads(world) for world in done.stdout.splitlines()]
        layouts = [[[float(word) for word in row.split()] for row in path.read_text().splitlines()[1:]] for path in paths]
        text = "".join(line(id=path.name, boxes=boxes, unit="cm") for path, boxes in zip(paths, layouts))
        for threads in (1, 3):
            answers = self.serve(text, "--ordered", "--threads", threads)
            self.assertEqual([answer["id"] for answer in answers], [path.name for path in paths])
            worlds = [world for answer in answers for world in answer["verdicts"]]
            self.assertEqual(len(worlds), len(expected))
            for world, same in zip(worlds, expected):
                self.assertEqual(list(world), list(same)[2:-1], "the names of screen, in their order")
                for key in world:
                    if key != "cpu_seconds":
                        self.assertEqual(world[key], same[key], key)

    def test_one_at_a_time_while_the_input_stays_open(self):
        service = self.begin()
        for i in range(3):
            answer = self.ask(service, id=i, boxes=ONE_BOX)
            self.assertEqual((answer["id"], answer["layout"], answer["line"]), (i, i, i + 1))
            self.assertEqual([world["verdict"] for world in answer["verdicts"]], ["moved", "stayed"])
        self.assertIn("error", self.ask(service, id=3))
        out, err = service.communicate(timeout=PATIENCE)
        self.assertEqual((service.returncode, out, err), (0, b"", b""))

    def test_order(self):
        large = [[1.3 * i, 0.5 * j, 0.4 * k, 1.3 * i + 0.6, 0.5 * j + 0.45, 0.4 * k + 0.4, 1] for i in range(4)
                 for j in range(4) for k in range(4)]
        requests = [{"id": i, "boxes": large if i % 10 == 0 else ONE_BOX} for i in range(40)]
        requests[7] = {"id": 7, "boxes": "none"}
        requests[9] = {"id": 9, "boxes": ONE_BOX, "accelerations": ["rest.txt"]}
        text = "".join(line(**request) for request in requests)
        ordered = self.serve(text, "--ordered", "--threads", 2)
        self.assertEqual([answer["id"] for answer in ordered], list(range(40)))
        self.assertEqual([i for i, answer in enumerate(ordered) if "error" in answer], [7])
        as_finished = self.serve(text, "--threads", 2)
        without_time = []
        for answers in (ordered, sorted(as_finished, key=lambda answer: answer["id"])):
            for answer in answers:
                for world in answer.get("verdicts", []):
                    del world["cpu_seconds"]
            without_time.append(answers)
        self.assertEqual(*without_time)

    def test_what_a_line_may_ask_for(self):
        seed = rows(SEED)
        metres = [[number / 100 for number in box[:6]] + [1] for box in seed]
        answers = self.serve(
            line(id="cm", boxes=seed, unit="cm") + line(id="m", boxes=metres, unit="m") + line(id="default", boxes=metres)
            + line(id="some", boxes=metres, accelerations=["rest.txt"])
            + line(id="turned", boxes=metres, accelerations=["rest.txt", "shove.txt"])
            + line(id="boxes", boxes=metres, per_box=True) + line(id="series", boxes=metres, series=True)
            + line(id={"any": ["thing", None]}, boxes=metres) + line(boxes=metres), "--ordered")
        names = [[world["acceleration"] for world in answer["verdicts"]] for answer in answers]
        both = ["shove.txt", "rest.txt"]
        self.assertEqual(names, [both, both, both, ["rest.txt"], both[::-1], both, both, both, both])
        hashes = {(world["acceleration"], world["state_hash"]) for answer in answers for world in answer["verdicts"]}
        self.assertEqual(len(hashes), 2)
        self.assertEqual([answer["id"] for answer in answers][7:], [{"any": ["thing", None]}, None])
        box = answers[5]["verdicts"][0]["per_box"][0]
        self.assertEqual(len(answers[5]["verdicts"][0]["per_box"]), 3)
        self.assertEqual(list(box), ["peak_displacement_m", "peak_drop_m", "peak_tilt_deg", "peak_kinetic_energy_J",
                                     "peak_speed_m_s", "end_displacement_m", "end_tilt_deg", "end_kinetic_energy_J",
                                     "settling_peak_displacement_m", "settling_peak_drop_m", "settling_peak_tilt_deg",
                                     "fallen", "moved", "tilted", "unstable", "fallen_at_end", "first_beyond_s"])
        series = answers[6]["verdicts"][0]["series"]
        samples = len(series["time_s"])
        self.assertGreater(samples, 5)
        for name, numbers in (("displacement_m", 3), ("orientation_wxyz", 4), ("angular_velocity_rad_s", 3)):
            self.assertEqual([len(sample) for sample in series[name]], [3] * samples)
            self.assertEqual(len(series[name][0][0]), numbers)
        self.assertEqual(series["displacement_m"][-1][0], box["end_displacement_m"])

    def test_boxes_as_objects_and_a_container(self):
        """Lines of a file of loads are lines of the service, with the bits of `screen`."""
        loads = [{"name": "a", "boxes": [{**PUMP, "mass": 80.5}, {"corner_min": [2, 1, 0], "corner_max": [2.5, 1.5, 0.5],
                                                                  "material": 3, "mat": 0.9, "order": 2, "bearing_limit": 500}]},
                 {"name": "b", "container": "trailer-curtain", "boxes": [PUMP, [2, 1, 0, 2.5, 1.5, 0.5, 1]]},
                 {"name": "c", "container": {"size": [3000, 2000, 2100], "open_sides": ["rear"], "drop_sides": {"left": 600},
                                             "bed_height": 900}, "unit": "mm",
                  "boxes": [[1000, 1000, 0, 1500, 1500, 500, 1]]}]
        self.write("loads.json", json.dumps({"holdfast": 1, "loads": loads}))
        done = self.run_here("screen", "-c", "config.ini", "--layouts", "loads.json", "--accelerations", "shove.txt", "rest.txt",
                             "--json", "--quiet")
        self.assert_exit(done, 0)
        expected = [json.loads(world) for world in done.stdout.splitlines()]
        self.assertEqual([world.get("critical_box_name") for world in expected], ["Pump", None, "Pump", None, None, None])
        in_metres = {**loads[2], "unit": "m", "boxes": ONE_BOX, "container": {
            "size": [3, 2, 2.1], "open_sides": ["rear"], "drop_sides": {"left": 0.6}, "bed_height": 0.9}}
        answers = self.serve("".join(line(**load) for load in [*loads, in_metres]) + line(boxes=[PUMP], per_box=True), "--ordered")
        worlds = [world for answer in answers for world in answer["verdicts"]]
        self.assertEqual([world["state_hash"] for world in worlds[:6]], [world["state_hash"] for world in expected])
        self.assertEqual([world.get("critical_box_name") for world in worlds[:4]], ["Pump", None, "Pump", None])
        self.assertEqual(worlds[4]["state_hash"], worlds[6]["state_hash"])
        self.assertEqual([box["name"] for box in worlds[8]["per_box"]], ["Pump"])

    def test_no_input(self):
        for text in ("", "\n", " \r\n\t\n"):
            self.assertEqual(self.serve(text), [])
        self.assertEqual(len(self.serve(line(boxes=ONE_BOX).strip())), 1, "the last line needs no end")


class Mistakes(Service):
    def test_each_is_answered_and_the_service_goes_on(self):
        cases = [
            ("hello\n", {"id": None, "column": 1, "value": "hello"}),
            ('{"id": 1, "boxes": [[0, 0, 0, NaN, 1, 1, 1]]}\n', {"id": 1, "column": 31, "box": 0, "number": 3, "value": "NaN"}),
            ('{"id": 2, "boxes": [[0, 0, 0, 1, 1, 1e400, 1]]}\n', {"id": 2, "column": 37, "box": 0, "number": 5}),
            ('{"id": "\udcfc"}\n', {"id": None, "error": "the line is not JSON"}),
            (line(id=3, boxes=[ONE_BOX[0], [2, 2, 0, 2.5, 1.5, 0.5, 1]]), {"id": 3, "box": 1, "number": 4, "column": 71,
                                                                          "value": "-50 cm"}),
            (line(id=4, boxes=[[0, 0, 0, 1, 1, 1]]), {"id": 4, "box": 0, "column": 21}),
            (line(id=5, boxes=[[0, 0, 0, 1, "1", 1, 1]]), {"id": 5, "box": 0, "number": 4, "value": '"1"'}),
            (line(boxes=ONE_BOX, bxes=1, id=6), {"id": 6, "value": "bxes", "accepted": "did you mean 'boxes'?"}),
            (line(id=7), {"id": 7, "error": "boxes are missing"}),
            (line(id=8, boxes=ONE_BOX, unit="yd"), {"id": 8, "accepted": '"m", "dm", "cm", "mm", "in" or "ft"'}),
            (line(id=9, boxes=ONE_BOX, accelerations=["rest"]), {"id": 9, "accepted": "a list of some of shove.txt, rest.txt"}),
            (line(id=10, boxes=rows(TOWER)), {"id": 10, "error": "the numbers seem to be centimetres, and metres are expected"}),
            (line(id=11, boxes=[ONE_BOX[0], ONE_BOX[0]]), {"id": 11, "box": 1}),
            (line(id=12, boxes=[ONE_BOX[0][:6] + [1.5]]), {"id": 12, "box": 0, "number": 6, "value": "1.5"}),
            ("[1, 2]\n", {"error": "the line is not an object"}),
            ('{"id": 14, "boxes": [[\n', {"id": 14, "error": "the line ends within its JSON"}),
            (line(id=15, boxes=[{**PUMP, "mass": -1}]), {"id": 15, "box": 0, "number": None, "column": 109, "value": "-1",
                                                         "error": "mass of box 1 is not possible"}),
            (line(id=16, boxes=[{**PUMP, "mas": 1}]), {"id": 16, "box": 0, "value": "mas", "accepted": "did you mean 'mass'?"}),
            (line(id=17, boxes=[{"corner_min": [0, 0, 0]}]), {"id": 17, "box": 0, "column": 22,
                                                              "error": "box 1 has no corner_max"}),
            (line(id=18, boxes=[{"corner_min": [0, 0], "corner_max": [1, 1, 1]}]),
             {"id": 18, "box": 0, "error": "corner_min of box 1 does not have three numbers"}),
            (line(id=19, boxes=[{"corner_max": [1, 1, -1], "corner_min": [0, 0, 0]}]),
             {"id": 19, "box": 0, "number": 5, "column": 44, "value": "-100 cm"}),
            (line(id=20, boxes=ONE_BOX, container="barn"), {"id": 20, "box": None, "error": "no container", "value": '"barn"'}),
            (line(id=21, boxes=ONE_BOX, container={"size": [1, 2]}), {"id": 21, "error":
                                                                      "the size of the container does not have three numbers"}),
            (line(id=22, boxes=ONE_BOX, container={"open_sides": ["floor"]}), {"id": 22, "error": "an open side that is none"}),
            (line(id=23, boxes=ONE_BOX, container={"drop_sides": {"roof": 1}}), {"id": 23, "error": "a drop side that is no wall"}),
            (line(id=24, boxes=[PUMP, [0, 0, 0, 1, 1, 1, 1.5]]), {"id": 24, "box": 1, "number": 6, "value": "1.5"}),
            ('{"id": 25, "boxes": [{"corner_min": {"x": 1}}], "container": {"size": {"x": 1}}}\n',
             {"id": 25, "error": "corner_min of box 1 is not a list"}),
        ]
        answers = self.serve("".join(broken + line(id="good", boxes=ONE_BOX) for broken, _ in cases), "--ordered")
        self.assertEqual(len(answers), 2 * len(cases))
        for i, (broken, expected) in enumerate(cases):
            answer = answers[2 * i]
            with self.subTest(line=broken):
                self.assertEqual(list(answer), ["id", "layout", "line", "column", "box", "number", "error", "value",
                                                "accepted", "more"])
                self.assertEqual((answer["layout"], answer["line"]), (2 * i, 2 * i + 1))
                self.assertEqual({key: answer[key] for key in expected}, expected)
                self.assertEqual(answers[2 * i + 1]["id"], "good")
                self.assertEqual(answers[2 * i + 1]["verdicts"][0]["verdict"], "moved")

    def test_whatever_the_bytes_are_a_line_has_one_answer(self):
        chance = random.Random(1)
        good = line(id=["a", 1.5, {"b": None}], boxes=ONE_BOX, unit="m", accelerations=["rest.txt"], per_box=True).strip()
        lines = []
        for _ in range(1500):
            text = list(good)
            for _ in range(chance.randint(1, 4)):
                at = chance.randrange(len(text))
                text[at:at + chance.randint(0, 3)] = chance.choices('[]{},:"\\ 019-+.eEtfnu\0\t\r\x7f\udcff', k=chance.randint(0, 3))
            lines.append("".join(text))
        answers = self.serve("\n".join(lines) + "\n", "--ordered")
        self.assertEqual([answer["line"] for answer in answers], list(range(1, len(lines) + 1)))
        for answer, text in zip(answers, lines):
            self.assertTrue(answer.get("error") or answer.get("verdicts"), text)
            self.assertLessEqual(answer.get("column") or 1, len(text) + 1)

    def test_a_series_that_is_too_long(self):
        self.write("config.ini", "[Export Settings]\nResultsIntervallInSeconds = 0.000001\n")
        answers = self.serve(line(boxes=ONE_BOX, series=True) + line(boxes=ONE_BOX), "--ordered")
        self.assertEqual(answers[0]["error"], "would give a world too many samples")
        self.assertEqual(answers[0]["value"], "5750000")
        self.assertEqual(answers[1]["verdicts"][0]["verdict"], "moved")

    def test_what_the_command_line_cannot_be(self):
        self.assert_refused(self.run_here("serve", "--accelerations", "-", input=""), "standard input brings the layouts")
        self.assert_refused(self.run_here("serve", "--accelerations", "none.txt", input=""), "none.txt")
        self.assert_refused(self.run_here(*self.arguments, "--engine", "none", input=""), "none")
        self.assert_refused(self.run_here(*self.arguments, "--accuracy", "high", input=""), "high", "screening")
        self.write("bad.txt", "0 0.5 x 0 0\n")
        self.assert_refused(self.run_here("serve", "--accelerations", "bad.txt", input=""), "bad.txt:1:7")


class Ends(Service):
    def test_a_reader_that_pauses_loses_nothing(self):
        """Answers fill the pipe, then the service stops to read; all come once the reader goes on."""
        count = 3000
        service = self.begin("--threads", "2")
        writer = threading.Thread(target=lambda: (service.stdin.write(
            b"".join(line(id=i, boxes=ONE_BOX).encode() for i in range(count))), service.stdin.close()))
        writer.start()
        writer.join(1.0)
        self.assertTrue(writer.is_alive(), "the service reads without bound")
        answers = [json.loads(answer) for answer in service.stdout]
        writer.join()
        self.assertEqual(sorted(answer["id"] for answer in answers), list(range(count)))
        self.assertEqual(service.wait(PATIENCE), 0)

    def test_a_reader_that_ends(self):
        service = self.begin()
        self.ask(service, boxes=ONE_BOX)
        service.stdout.close()
        with contextlib.suppress(BrokenPipeError):
            while True:
                os.write(service.stdin.fileno(), line(boxes=ONE_BOX).encode())
        self.assertEqual(service.wait(PATIENCE), -signal.SIGPIPE)

    def test_signals(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            for busy in (False, True):
                with self.subTest(signal=number, busy=busy):
                    service = self.begin()
                    self.ask(service, boxes=ONE_BOX)
                    if busy:
                        os.set_blocking(service.stdin.fileno(), False)
                        # Nobody reads the answers: there are no more than a pipe holds.
                        service.stdin.raw.write(line(boxes=ONE_BOX).encode() * 40)
                    service.send_signal(number)
                    self.assertEqual(service.wait(PATIENCE), code)
                    self.assertIn(b"stopped after ", service.stderr.read())

    def test_a_signal_while_nobody_reads(self):
        service = self.begin()
        os.set_blocking(service.stdin.fileno(), False)
        text = line(boxes=ONE_BOX).encode() * 100
        written = [0]

        def is_full():
            try:
                written[0] += service.stdin.raw.write(text) or 0
            except BlockingIOError:
                return True
            return select.select([], [service.stdin], [], 0.5)[1] == []

        wait_for(is_full, service)
        service.send_signal(signal.SIGTERM)
        self.assertEqual(service.wait(PATIENCE), 143)


@unittest.skipIf(SANITIZED, "a sanitizer keeps memory of its own")
class Memory(Service):
    def peak(self, text, count):
        """MiB of the service at its largest, when it has answered all lines of the text, so many."""
        service = self.begin("--threads", "2")
        writer = threading.Thread(target=lambda: (service.stdin.write(text), service.stdin.flush()))
        writer.start()
        for _ in range(count):
            self.assertTrue(service.stdout.readline().startswith(b'{"id":'))
        writer.join()
        status = pathlib.Path(f"/proc/{service.pid}/status").read_text()
        largest = next(row for row in status.splitlines() if row.startswith("VmHWM:"))
        self.assertEqual(service.communicate(timeout=PATIENCE), (b"", b""))
        return int(largest.split()[1]) / 1024

    def test_does_not_grow_with_the_number_of_lines(self):
        one = line(boxes=ONE_BOX).encode()
        self.assertLess(self.peak(one * 5000, 5000), self.peak(one * 1000, 1000) + 3)

    def test_a_line_without_end_is_not_kept(self):
        one = line(id=1, boxes=ONE_BOX).encode()
        self.assertLess(self.peak(b"[" * (100 << 20) + b"\n" + one, 2), self.peak(one, 1) + 30)
        answers = self.serve("x" * (9 << 20) + "\n" + one.decode(), "--ordered")
        self.assertEqual(answers[0]["error"], "the line is too long")
        self.assertEqual(answers[0]["line"], 1)
        self.assertEqual(answers[1]["id"], 1)


if __name__ == "__main__":
    unittest.main()
