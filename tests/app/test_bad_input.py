"""Bad input and bad usage: one line that says where and what, the right exit code, and never a crash."""
import os
import re
import signal
import subprocess
import unittest

from cli import CONFIG, FLOATING, HOLDFAST, PATIENCE, REST, SEED, SHOVE, SOURCE, TOWER, CliTest, datasets, layout_text, start

HEAD = "1 2\n"
BOX = "0 0 0 80 60 100 1\n"

# name, content, line:column of the message ("" where it is about the whole file), what it says
BAD_LAYOUTS = [
    ("empty", "", "", "is empty"),
    ("only_header", HEAD, "", "has no boxes"),
    ("no_header", BOX + BOX, "1:1", "the header is missing"),
    ("few_columns", HEAD + BOX + "100 0 0 180 60 1\n", "3:1", "too few columns"),
    ("word", HEAD + "0 0 zero 80 60 100 1\n", "2:5", "z1 of box 1 is not a number: zero"),
    ("nan", HEAD + "0 0 0 nan 60 100 1\n", "2:7", "x2 of box 1 is not a number: nan"),
    ("infinite", HEAD + "0 0 0 80 1e999 100 1\n", "2:10", "y2 of box 1 is not a number: 1e999"),
    ("material", HEAD + "0 0 0 80 60 100 1.5\n", "2:17", "the material of box 1 is not an id: 1.5"),
    ("flat", HEAD + "0 0 0 0 60 100 1\n", "2", "box 1"),
    ("reversed", HEAD + "80 0 0 0 60 100 1\n", "2", "box 1"),
    ("outside", HEAD + BOX + "550 0 0 630 60 100 1\n", "3", "box 2"),
    ("below", HEAD + "0 0 -10 80 60 100 1\n", "2", "box 1"),
    ("far", HEAD + "0 0 0 1e300 60 100 1\n", "2:7", "x2 of box 1 is too far away: 1e300; a number of cm from -1000000 to 1000000"),
    ("thin", HEAD + "0 0 0 80 60 1e-300 1\n", "2", "box 1 has no height: 1e-300 cm; the second corner must be beyond"),
    ("overlap", HEAD + BOX + "70 0 0 150 60 100 1\n", "3", "box 2 overlaps box 1 of line 2: 100 mm deep"),
    ("binary", b"1 2\n\x00\xff\xfe 0 0 80 60 100 1\n", "2:1", ""),
]
BAD_ACCELERATIONS = [
    ("empty", "", "", "is empty"),
    ("only_comment", "# time duration x y z\n", "", "has no segments"),
    ("few_columns", "0 1 0 0 0\n1 1 0 0\n", "2:1", "too few columns: 4"),
    ("many_columns", "0 1 0 0 0 7\n", "1:1", "too many columns: 6"),
    ("word", "0 1 0 fast 0\n", "1:7", "ay is not a number: fast"),
    ("infinite", "0 1 inf 0 0\n", "1:5", "ax is not a number: inf"),
    ("negative_time", "-1 1 0 0 0\n", "1:1", "the initial time is negative"),
    ("no_duration", "0 0 0 0 0\n", "1:3", "the duration is too short"),
    ("endless", "0 1e300 0 0 0\n", "1:3", "the time is too large: 1e300; times of at most 1e6 s"),
    ("absurd", "0 1 0 -1e300 0\n", "1:7", "ay is too large: -1e300; accelerations from -10000 to 10000 m/s²"),
    ("overlap", "0 1 1 0 0\n0.5 1 2 0 0\n", "2:1", "the segment overlaps that of line 1"),
    ("unsorted", "1 1 1 0 0\n0 1 2 0 0\n", "2:1", "the segment is before that of line 1"),
]
BAD_CONFIGS = [
    ("unknown_key", "[Screening]\nEngin = bullet\n", "2:1", "unknown key in [Screening]: Engin; did you mean Engine?"),
    ("unknown_section", "[Screning]\n", "1:1", "did you mean [Screening]?"),
    ("wrong_section", "[Screening]\nDensityValue = 3\n", "2:1", "it belongs to [Physics Engine]"),
    ("not_a_number", "[Physics Engine]\nDensityValue = heavy\n", "2:16", "DensityValue has a wrong value: heavy"),
    ("negative", "[Physics Engine]\nDensityValue = -1\n", "2:16", "a number from 1e-12 to 1000000 (kg/m³"),
    ("absurd", "[Screening]\nGravity = 1e300\n", "2:11", "Gravity has a wrong value: 1e300; a number from 0 to 1000000"),
    ("percent", "[Contact]\nBoxFloor = 60\n", "2:12", "BoxFloor has a wrong value: 60; a number from 0 to 10"),
    ("no_value", "[Physics Engine]\nDensityValue =\n", "2:15", "DensityValue has no value"),
    ("twice", "[Container]\nLength = 1\nLength = 2\n", "3:1", "the key is given twice: Length; its first value is on line 2"),
    ("no_section", "Length = 1\n", "1:1", "a key before any section"),
    ("prose", "[Container]\nlong and wide\n", "2:1", "neither a section nor a key with a value"),
    ("word", "[Container]\nUpAxis = x\n", "2:10", "UpAxis has a wrong value: x; z or y"),
    ("conflict", "[Material 3]\nDensity = 3\nMass = 4\n", "3:1", "both a mass and a density"),
]
BAD_FILES = [(kind, *row) for kind, table in (("layout", BAD_LAYOUTS), ("acceleration", BAD_ACCELERATIONS),
                                              ("config", BAD_CONFIGS)) for row in table]


class Check(CliTest):
    def test_good_files_are_named(self):
        self.write_inputs()
        done = self.run_here("check", "config.ini", "seed.txt", "shove.txt")
        self.assert_exit(done, 0)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.stdout, "config.ini: ok: config, 2 keys\nseed.txt: ok: layout (text), 3 boxes\n"
                                      "shove.txt: ok: acceleration, 3 segments, 1.02 s\n")

    def test_the_samples_are_good(self):
        for folder in ("configs/layouts", "configs/accelerations", "bench/layouts", "configs/demo.ini",
                       "configs/free_container.ini", "configs/verdicts.ini"):
            done = self.run_here("check", SOURCE / folder)
            self.assert_exit(done, 0)
            self.assertEqual(done.stderr, "")

    def test_a_bad_file_is_told_where_and_why(self):
        for kind, name, content, place, what in BAD_FILES:
            with self.subTest(kind=kind, name=name):
                path = self.write(f"{kind}_{name}.txt", content)
                done = self.run_here("check", path.name)
                self.assert_exit(done, 2)
                said = done.stderr.splitlines()[0]
                taken = kind
                if name in ("empty", "only_header", "only_comment", "binary", "many_columns"):
                    # These do not show what they should have been, which `screen` knows.
                    self.assertIn(f"{path.name}: neither layout, acceleration nor config", said)
                    taken = "no known kind"
                else:
                    self.assertTrue(said.startswith(f"{path.name}:{place}"), said)
                    self.assertIn(what, said)
                why = r"( \(text(, since no line names the places and sizes of boxes)?\))?"
                self.assertRegex(done.stdout, rf"^{path.name}: bad: {taken}{why if kind == 'layout' else ''}, \d+ errors?\n$")
                self.assertEqual(done.stderr.splitlines()[-1], "1 of 1 files are bad")

    def test_all_faults_of_all_files_are_reported(self):
        self.write("a.txt", HEAD + "0 0 zero 80 60 100 1\n0 0 0 80 60 tall 1\n")
        self.write("b.txt", "0 1 0 fast 0\n")
        self.write("good.txt", HEAD + BOX)
        done = self.run_here("check", "a.txt", "b.txt", "good.txt")
        self.assert_exit(done, 2)
        self.assertEqual([line.split(" ")[0] for line in done.stderr.splitlines()],
                         ["a.txt:2:5:", "a.txt:3:13:", "b.txt:1:7:", "2"])
        self.assertEqual(done.stdout, "a.txt: bad: layout (text), 2 errors\nb.txt: bad: acceleration, 1 error\ngood.txt: ok: layout (text), 1 box\n")

    def test_a_layout_that_was_cut_off_is_reported(self):
        text = layout_text(SEED)
        self.write("whole.txt", text)
        self.write("cut.txt", "".join(text.splitlines(keepends=True)[:-1]))
        self.write("shove.txt", SHOVE)
        warning = "warning: cut.txt:1: the header announces 3 boxes and the file has 2, as in a truncated copy\n"
        done = self.run_here("check", "whole.txt", "cut.txt")
        self.assert_exit(done, 0)
        self.assertEqual(done.stderr, warning)
        done = self.run_here("screen", "--layouts", "whole.txt", "cut.txt", "--accelerations", "shove.txt")
        self.assert_exit(done, 0)
        self.assertEqual(done.stderr.count("the header announces"), 1)
        self.assertIn(warning, done.stderr)

    def test_it_says_all_that_screen_says_of_the_same_inputs(self):
        self.write("settings.ini", "[Container]\nOpenSides = rear\n[Physics Engine]\nSimulationStepsPerSecond = 100000\n"
                                   "[Export Settings]\nResultsIntervallInSeconds = 0.001\n"
                                   "[Simulation Settings]\nBoxFriction = 0.7\n[Contact]\nFrictionModel = pairs\nBoxBox = 0.4\n")
        many = [(30 * i, 20 * j, 0, 30 * i + 30, 20 * j + 20, 20) for i in range(14) for j in range(10)]
        for name, text in {
                "cut.txt": "1 3\n" + BOX + "100 0 0 180 60 100 1\n", "comment.txt": HEAD + "0 0 0 80 60 100 1 no more\n",
                "rounded.txt": HEAD + BOX + "79.995 0 0 150 60 100 1\n", "beyond.txt": HEAD + BOX + "600 0 0 680 60 100 1\n",
                "overlap.txt": HEAD + BOX + "70 0 0 150 60 100 1\n", "high.txt": HEAD + "0 0 200 80 60 300 1\n",
                "floating.txt": layout_text(FLOATING), "many.txt": layout_text(many), "more/cut.txt": HEAD + BOX,
                "other.txt": "what somebody wrote\n"}.items():
            self.write(f"layouts/{name}", text)
        for name, text in {"steps.txt": "0 100000 0 0 0\n", "samples.txt": "0 300 0 0 0\n", "long.txt": "0 140 0 0 0\n",
                           "more/long.txt": "0 0.1 0 0 0\n", "word.txt": "0 1 0 fast 0\n", "other.txt": "what somebody wrote\n"}.items():
            self.write(f"accelerations/{name}", text)
        layouts, accelerations = ["layouts", "layouts/more"], ["accelerations", "accelerations/more"]
        screened = self.run_here("screen", "-c", "settings.ini", "--layouts", *layouts, "--accelerations", *accelerations, "--quiet")
        self.assert_exit(screened, 1)
        checked = self.run_here("check", "-c", "settings.ini", *layouts, *accelerations)
        self.assert_exit(checked, 2)

        def messages(done):
            """Without the folder, which results do not have."""
            return {re.sub(r"^(warning: )?([a-z]+/(more/)?)?", "", line) for line in done.stderr.splitlines()}

        self.assertLessEqual(messages(screened), messages(checked))
        for what in ("cut.txt:1: the header announces", "more than seven columns", "within the tolerance", "wholly beyond the floor",
                     "overlaps box 1", "at the roof", "its series under long.txt would be too large", "has the same name in the results",
                     "too many steps", "too many samples", "very many steps", "ay is not a number", "left out, neither", "has no effect"):
            self.assertTrue(any(what in line for line in messages(screened)), (what, screened.stderr))

    def test_a_configuration_that_its_engine_cannot_follow_is_bad(self):
        self.write("free.ini", "[Container]\nMotion = free\n")
        self.write("box.txt", HEAD + BOX)
        self.write("rest.txt", REST)
        screened = self.run_here("screen", "-c", "free.ini", "--layouts", "box.txt", "--accelerations", "rest.txt")
        self.assert_exit(screened, 2)
        for words in (["free.ini"], ["box.txt", "-c", "free.ini"]):
            checked = self.run_here("check", *words)
            self.assert_exit(checked, 2)
            self.assertIn(screened.stderr.strip(), checked.stderr)

    def test_a_line_of_a_million_digits_is_read_by_check_as_by_screen(self):
        digits = "0" * 1_000_000
        self.write("layout.txt", f"1 1\n0 0 0 80.{digits} 59 106 1\n")
        self.write("acceleration.txt", f"0 1.{digits} 0 0 0\n")
        self.write("config.ini", f"# {digits}\n[Container]\nWidth = 233\n")
        done = self.run_here("check", "layout.txt", "acceleration.txt", "config.ini")
        self.assert_exit(done, 0)
        self.assertEqual(done.stdout, "layout.txt: ok: layout (text), 1 box\nacceleration.txt: ok: acceleration, 1 segments, 1 s\n"
                                      "config.ini: ok: config, 1 keys\n")
        self.assert_exit(self.run_here("screen", "-c", "config.ini", "--layouts", "layout.txt", "--accelerations",
                                       "acceleration.txt", "--quiet"), 0)

    def test_the_container_of_the_config_counts(self):
        self.write("long.ini", "[Container]\nLength = 1200\n")
        self.write("long.txt", HEAD + "900 0 0 1000 60 100 1\n")
        self.assert_exit(self.run_here("check", "long.txt"), 2)
        self.assert_exit(self.run_here("check", "long.txt", "-c", "long.ini"), 0)

    def test_the_centres_of_mass_of_the_config_count(self):
        self.write("heavy.ini", "[Material 1]\nCentreOfMass = 41 0 0\n")
        self.write("box.txt", HEAD + BOX)
        done = self.run_here("check", "box.txt", "-c", "heavy.ini")
        self.assert_exit(done, 2)
        self.assertIn("box.txt:2: box 1 has its centre of mass outside, by CentreOfMass of [Material 1]: 41 0 0 cm; "
                      "at most half of the box to either side, 40 x 30 x 50 cm\n", done.stderr)


class Screen(CliTest):
    def test_a_bad_layout_becomes_a_row(self):
        self.write_inputs()
        self.layouts = [self.write("a_good.txt", layout_text(SEED))]
        for name, content, *_ in BAD_LAYOUTS:
            self.layouts.append(self.write(f"b_{name}.txt", content))
        self.layouts.append(self.write("c_good.txt", layout_text(SEED)))
        path, done = self.screen(expect=1)
        data = datasets(path)
        status = data["/worlds/status"].reshape(-1, 2)
        self.assertEqual([list(row) for row in status], [[0, 0], *[[1, 1]] * len(BAD_LAYOUTS), [0, 0]])
        said = done.stderr.splitlines()
        for i, (name, _, place, what) in enumerate(BAD_LAYOUTS, 1):
            with self.subTest(name=name):
                text = data["/worlds/status_text"][2 * i].decode()
                self.assertIn(f"b_{name}.txt:{place}", text)
                self.assertIn(what, text)
                self.assertEqual(said.count(text), 1, "each is reported once")
                self.assertEqual(data["/worlds/box_count"][2 * i], 0)
        # The good ones are what they are without the bad ones.
        self.layouts = [self.layouts[0]]
        alone, _ = self.screen(output="alone.h5")
        hashes = datasets(alone)["/worlds/state_hash"]
        self.assertEqual(list(hashes), list(data["/worlds/state_hash"][:2]))
        self.assertEqual(list(hashes), list(data["/worlds/state_hash"][-2:]))

    def test_a_bad_acceleration_becomes_a_row(self):
        self.write_inputs()
        self.layouts = self.layouts[:2]
        self.accelerations = [self.write("a_good.txt", SHOVE)]
        for name, content, *_ in BAD_ACCELERATIONS:
            self.accelerations.append(self.write(f"b_{name}.txt", content))
        path, done = self.screen("--json", expect=1)
        data = datasets(path)
        status = data["/worlds/status"].reshape(2, -1)
        self.assertEqual([list(row) for row in status], [[0, *[2] * len(BAD_ACCELERATIONS)]] * 2)
        for i, (name, _, place, what) in enumerate(BAD_ACCELERATIONS, 1):
            with self.subTest(name=name):
                text = data["/worlds/status_text"][i].decode()
                self.assertIn(f"b_{name}.txt:{place}", text)
                self.assertIn(what, text)
                self.assertIn(text, done.stderr.splitlines())
        self.assertEqual(done.stdout.count('"status":"bad_acceleration"'), 2 * len(BAD_ACCELERATIONS))

    def test_a_bad_config_ends_all(self):
        for name, content, place, what in BAD_CONFIGS:
            with self.subTest(name=name):
                self.write_inputs()
                self.config = self.write("bad.ini", content)
                done = self.screen(expect=2)[1]
                self.assert_refused(done, f"bad.ini:{place}: ", what)
        self.assertFalse(list(self.folder.glob("results*")))

    def test_what_is_not_there_is_reported(self):
        self.write_inputs()
        for arguments, words in (
                (("--engine", "bulet"), ("unknown engine: bulet", "did you mean 'bullet'?")),
                (("--engine", "warp"), ("unknown engine: warp", "accepted are", "bullet-f64")),
                (("--engine", "native", "--accuracy", "quick"),
                 ("unknown accuracy: quick; accepted are screening, standard or reference",)),
                (("--accuracy", "standard"), ("an accuracy is for the engine native", "bullet-stock", "--engine native")),
                (("--scheduler", "opnmp"), ("unknown scheduler: opnmp", "accepted are tbb")),
                (("--no-series", "--text", "text"), ("text files need the series",))):
            with self.subTest(arguments=arguments):
                done = self.screen(*arguments, expect=2)[1]
                self.assert_refused(done, *words)
        self.assertFalse(list(self.folder.glob("results*")))

    def test_an_engine_says_what_it_cannot_model(self):
        self.write_inputs()
        self.config = self.write("free.ini", "[Container]\nMotion = free\n")
        self.assert_refused(self.screen(expect=2)[1], "native", "Engine = bullet", "Motion = prescribed")

    def test_missing_files(self):
        self.write_inputs()
        good = ["-c", "config.ini", "--layouts", "seed.txt", "--accelerations", "rest.txt", "-o", "r.h5"]
        for i, missing in ((1, "nope.ini"), (3, "nope.txt"), (5, "nope.txt"), (1, ""), (3, ""), (7, "")):
            with self.subTest(missing=missing, of=good[i - 1]):
                done = self.run_here("screen", *good[:i], missing, *good[i + 1:])
                self.assert_refused(done, missing or "an empty path")

    def test_a_place_that_cannot_be_written(self):
        self.write_inputs()
        for output in ("seed.txt/results.h5", "/proc/results.h5"):
            with self.subTest(output=output):
                done = self.screen(output=output, expect=2)[1]
                self.assert_refused(done, "results.h5")


class Usage(CliTest):
    def test_bad_command_lines(self):
        for arguments, words in (
                ((), ("A subcommand is required",)),
                (("scren",), ("unknown command: scren; did you mean 'screen'?",)),
                (("frobnicate",), ("unknown command: frobnicate",)),
                (("--verson",), ("unknown option: --verson; did you mean '--version'?",)),
                (("screen",), ("--layouts",)),
                (("screen", "--layout", "x", "--accelerations", "y"), ("unknown option: --layout; did you mean '--layouts'?",)),
                (("screen", "--layouts", "x", "--accelerations", "y", "--thread=3"), ("did you mean '--threads'?",)),
                (("screen", "--layouts", "x", "--accelerations", "y", "--threads", "-1"), ("--threads", "-1", "1024")),
                (("screen", "--layouts", "x", "--accelerations", "y", "--threads", "many"), ("--threads", "many")),
                (("screen", "--layouts", "x", "--accelerations", "y", "--resume", "--overwrite"), ("--overwrite", "--resume")),
                (("check",), ("paths",)),
                (("summary",), ("results",)),
                (("run",), ("config",)),
                (("run", "a.ini", "b.ini"), ("b.ini",)),
                (("summary", "r.h5", "--drop-threshold", "-1"), ("--drop-threshold",)),
                (("engines", "all"), ("all",))):
            with self.subTest(arguments=arguments):
                done = self.run_here(*arguments)
                self.assert_exit(done, 2)
                self.assertEqual(done.stdout, "")
                self.assertLessEqual(len(done.stderr.splitlines()), 2, done.stderr)
                for word in words:
                    self.assertIn(word, done.stderr)

    def test_help_has_an_example(self):
        commands = ("screen", "run", "summary", "check", "bench", "validate", "engines")
        for command in ((), *((command,) for command in commands)):
            with self.subTest(command=command):
                done = self.run_here(*command, "--help")
                self.assert_exit(done, 0)
                self.assertEqual(done.stderr, "")
                self.assertIn("\nExample:\n  holdfast " + "".join(command), done.stdout)
        for command in commands:
            self.assertIn(f"\n  {command} ", self.run_here("--help").stdout)

    def test_exit_codes_are_reported(self):
        reported = self.run_here("--help").stdout
        for code in ("0 done", "1 some", "2 bad", "130 and 143", "141"):
            self.assertIn(code, reported)
        # More than a pipe holds, so that the program still writes when its reader is gone.
        ended = subprocess.run(["bash", "-c", f"(for i in $(seq 40); do '{HOLDFAST}' --help-config || echo $? >&2; done) | head -1"],
                               capture_output=True, text=True, timeout=PATIENCE, check=False)
        self.assertIn("141\n", ended.stderr)

    def test_a_folder_is_no_output(self):
        self.write_inputs()
        (self.folder / "taken").mkdir()
        inputs = ("--layouts", self.layouts[0], "--accelerations", self.accelerations[0])
        for more in ((), ("--resume",), ("--overwrite",)):
            for path in ("taken", "taken/", "."):
                with self.subTest(more=more, path=path):
                    self.assert_refused(self.run_here("screen", *inputs, "-o", path, *more),
                                        f"{path}: is a folder; -o takes the name of a results file, such as results.h5")
        self.assertEqual(list((self.folder / "taken").iterdir()), [])
        self.assert_exit(self.run_here("screen", *inputs, "--quiet"), 0)
        self.assert_refused(self.run_here("summary", "results.h5", "-o", "taken"), "taken: is a folder; the name of a new file")

    def test_pages(self):
        self.assertRegex(self.run_here("--version").stdout, r"^holdfast \d+\.\d+\.\d+ ")
        self.assertIn("BoxFriction", self.run_here("--help-config").stdout)
        engines = self.run_here("engines")
        self.assert_exit(engines, 0)
        self.assertTrue(engines.stdout.startswith("native "), "the default comes first")
        for name in ("bullet ", "bullet-f64 ", "bullet-stock "):
            self.assertRegex(engines.stdout, f"(?m)^{name}")


class NoRegularFiles(CliTest):
    """What may keep its reader waiting for ever is refused at once, wherever a file is named."""

    def test_a_pipe_or_a_device_is_refused(self):
        self.write_inputs()
        os.mkfifo(self.folder / "pipe")
        (self.folder / "link").symlink_to("pipe")
        layout, acceleration = self.layouts[0], self.accelerations[0]
        for path, kind in (("pipe", "a pipe"), ("link", "a pipe"), ("/dev/zero", "a device")):
            for words in (("screen", "--layouts", path, "--accelerations", acceleration),
                          ("screen", "--layouts", layout, "--accelerations", path),
                          ("screen", "-c", path, "--layouts", layout, "--accelerations", acceleration),
                          ("screen", "--layouts", layout, "--accelerations", acceleration, "-o", path, "--resume"),
                          ("run", path), ("check", path), ("summary", path)):
                with self.subTest(path=path, words=words[:2]):
                    self.assert_refused(self.run_here(*words), f"{path}: is {kind}, not a file; save its output in a file")

    def test_a_pipe_in_a_folder_is_reported(self):
        self.write("layouts/seed.txt", layout_text(SEED))
        os.mkfifo(self.folder / "layouts/pipe.txt")
        self.write("shove.txt", SHOVE)
        done = self.run_here("screen", "--layouts", "layouts", "--accelerations", "shove.txt")
        self.assert_refused(done, "layouts/pipe.txt: is a pipe, not a file")

    def test_a_layout_that_changes_or_becomes_a_pipe_during_the_run_is_a_row(self):
        self.write("config.ini", CONFIG)
        for name in ("a.txt", "b.txt", "c.txt"):
            self.write(name, layout_text(SEED))
        self.write("short.txt", "0 0.1 1 0 0\n")
        self.write("long.txt", "0 1000 1 0 0\n")
        process = start("screen", "-c", "config.ini", "--layouts", "a.txt", "b.txt", "c.txt", "--accelerations", "short.txt",
                        "long.txt", "--json", "--threads", 1, "--scheduler", "serial", "--no-series", cwd=self.folder)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        self.assertIn("a.txt", process.stdout.readline())
        process.send_signal(signal.SIGSTOP)  # while it is at the long world
        (self.folder / "b.txt").unlink()
        os.mkfifo(self.folder / "b.txt")
        self.write("c.txt", layout_text(TOWER))
        process.send_signal(signal.SIGCONT)
        said = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual(process.returncode, 1, said)
        self.assertIn("b.txt: is a pipe, not a file", said)
        self.assertIn("c.txt: this layout has changed since the run began, and is left out; screen it again by itself", said)
        self.assertEqual(datasets(self.folder / "results.h5")["/worlds/status"].tolist(), [0, 0, 1, 1, 1, 1])


if __name__ == "__main__":
    unittest.main()
