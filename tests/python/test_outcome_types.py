"""What is written from the rows of outcome_fields.h: Python classes and TypeScript types."""
import pathlib
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tools"))
import outcome_types  # noqa: E402

HEADER = (SOURCE / outcome_types.ROWS).read_text(encoding="utf-8")
LAST_VERDICT = HEADER[HEADER.index("  X(not_needed, NOT_ASKED"):].splitlines()[0]
LAST_FIELD = HEADER[HEADER.index("  X(recorded, hash, state_hash"):].splitlines()[0]


def written(header):
    """The files for the rows of a header, by the end of their names."""
    rows = outcome_types.Rows(header)
    return {pathlib.Path(name).name: "\n".join(write(rows)) for name, write in outcome_types.WRITERS.items()}


class OutcomeTypesTest(unittest.TestCase):
    def test_the_files_of_the_sources_are_current(self):
        tool = [sys.executable, SOURCE / "tools/outcome_types.py", "--check"]
        result = subprocess.run(tool, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def test_a_row_of_a_field_is_all_that_it_takes(self):
        row = '  X(derived, f32, largest_tilt, "/a/b", "c", 9, "degree", "largest `tilt` of a box; NaN without") \\'
        files = written(HEADER.replace(LAST_FIELD, f"{row}\n{LAST_FIELD}"))
        self.assertIn('    largest_tilt = Column("Largest ``tilt`` of a box, degree; NaN without.")', files["world_columns.py"])
        self.assertIn("  /** largest `tilt` of a box, degree; NaN without */\n  largestTilt: number;", files["outcome.ts"])
        self.assertEqual(files["codes.py"], written(HEADER)["codes.py"])

    def test_a_row_of_a_name_is_all_that_it_takes(self):
        row = '  X(left_out, LEFT_OUT, 7, "nobody asked")'
        files = written(HEADER.replace(LAST_VERDICT, f"{LAST_VERDICT} \\\n{row}"))
        self.assertIn("    LEFT_OUT = 7  #: nobody asked\n", files["codes.py"])
        self.assertIn("  /** nobody asked */\n  left_out: 7,\n} as const;\nexport type VerdictName", files["outcome.ts"])

    def test_only_numbers_that_a_program_gets_are_columns(self):
        rows = outcome_types.Rows(HEADER)
        names = [field.name for field in rows.world()]
        self.assertEqual(names[:3], ["layout", "acceleration", "verdict"])
        self.assertIn("steps", names)
        for name in ("message", "engine", "box_begin", "solve_iterations"):
            self.assertNotIn(name, names)

    def test_a_line_that_is_not_understood_is_named(self):
        number = HEADER.splitlines().index(LAST_FIELD) + 1
        for row in (LAST_FIELD.replace('"1",', "1,"), LAST_FIELD.replace("recorded", "found"), LAST_FIELD.replace("hash,", "u128,"),
                    LAST_FIELD.replace(") \\", ")"), f"{LAST_FIELD}\n  HOLDFAST_MORE_FIELDS(X) \\"):
            with self.assertRaisesRegex(SystemExit, rf"outcome_fields\.h:({number}|{number + 1}): "):
                outcome_types.Rows(HEADER.replace(LAST_FIELD, row))


if __name__ == "__main__":
    unittest.main()
