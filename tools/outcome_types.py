#!/usr/bin/env python3
"""Writes the Python classes and TypeScript types that are made of the rows of include/holdfast/outcome_fields.h.

    tools/outcome_types.py            writes them
    tools/outcome_types.py --check    names those that are not current, and exits with 1 if there are any
"""
import json
import pathlib
import re
import sys
import textwrap
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROWS = "include/holdfast/outcome_fields.h"
WRITTEN_BY = f"Written by tools/outcome_types.py from {ROWS}."
WIDTH = 120

NUMBERS = {"u32", "u64", "f32", "f64", "time", "flag"}
SCOPES = {"recorded", "derived", "message", "stored"}
# Scopes of the fields that a program gets as a number.
PUBLIC = {"recorded", "derived"}


class Field(NamedTuple):
    scope: str
    type: str
    name: str
    dataset: str
    label: str
    since: str
    unit: str
    sentence: str

    def described(self):
        """The sentence, with the unit at the end of what comes before the first semicolon."""
        if self.unit in ("1", "none"):
            return self.sentence
        head, semicolon, rest = self.sentence.partition(";")
        return f"{head}, {self.unit}{semicolon}{rest}"


class Code(NamedTuple):
    name: str
    c_name: str
    code: int
    sentence: str


# What a line between the two remarks to clang-format may be, beside an empty one.
BEGIN, END = "/* clang-format off */", "/* clang-format on */"
COMMENT = re.compile(r"(?:/\*| \*) (.*?)(?: \*/)?")
LIST = re.compile(r"#define HOLDFAST_(\w+)\(X\) \\")
FIELD = re.compile(r'  X\((\w+), *(\w+), *(\w+), *"([^"\\]+)", *"([^"\\]*)", *(\d+), *"([^"\\]+)", *"([^"\\]+)"\)(?: \\)?')
CODE = re.compile(r'  X\((\w+), *(\w+), *(\d+), *"([^"\\]+)"\)(?: \\)?')
INCLUDED = re.compile(r"  HOLDFAST_(\w+)\(X\)(?: \\)?")


class Rows:
    """The rows of the header: those of fields and those of codes, by the name of their list without HOLDFAST_."""

    def __init__(self, text):
        self.fields, self.codes, self.comments = {}, {}, {}
        lines = text.splitlines()
        if lines.count(BEGIN) != 1 or lines.count(END) != 1:
            sys.exit(f"{ROWS}: the rows are not between one {BEGIN} and one {END}")
        first = lines.index(BEGIN) + 1
        in_list, comment = False, ""
        for number, line in enumerate(lines[first:lines.index(END)], first + 1):
            if in_list:
                self._add(current, line, number)
            elif match := LIST.fullmatch(line):
                current = match[1]
                self.comments[current] = comment
                comment = ""
            elif match := COMMENT.fullmatch(line):
                comment = f"{comment} {match[1]}".strip()
            elif line != "":
                refuse(line, number)
            in_list = line.endswith(" \\")

    def _add(self, current, line, number):
        if match := FIELD.fullmatch(line):
            self.fields.setdefault(current, []).append(self._checked(Field(*match.groups()), number))
        elif match := CODE.fullmatch(line):
            self.codes.setdefault(current, []).append(Code(match[1], match[2], int(match[3]), match[4]))
        elif (match := INCLUDED.fullmatch(line)) and match[1] in self.fields:
            self.fields.setdefault(current, []).extend(self.fields[match[1]])
        else:
            refuse(line, number)

    def _checked(self, field, number):
        known = NUMBERS | {"vec3", "hash", "text"} | {type_of(name) for name in self.codes}
        if field.scope not in SCOPES or field.type not in known:
            sys.exit(f"{ROWS}:{number}: the scope {field.scope} or the type {field.type} is not known")
        return field

    def world(self):
        """The fields of a world that a program gets as a number."""
        return [field for field in self.fields["WORLD_FIELDS"] if field.scope in PUBLIC]

    def box(self):
        """The same of a box."""
        return [field for name in ("BOX_FIELDS", "BOX_VERDICT_FIELDS") for field in self.fields[name] if field.scope in PUBLIC]


def refuse(line, number):
    sys.exit(f"{ROWS}:{number}: this line is not understood: {line.strip()}")


def type_of(enumeration):
    """STOP_REASONS: stop_reason, STATUS_BITS: status."""
    return enumeration.lower().removesuffix("_bits" if enumeration.endswith("_BITS") else "s")


def class_of(type_name):
    """stop_reason: StopReason."""
    return type_name.title().replace("_", "")


def member_of(name):
    """state_hash: stateHash."""
    return re.sub(r"_(.)", lambda match: match[1].upper(), name)


def for_python(sentence):
    """With code as reStructuredText has it."""
    return re.sub(r"`([^`]+)`", r"``\1``", sentence)


def python_codes(rows):
    lines = [f"# {WRITTEN_BY}", '"""What the numbers in a table of verdicts mean."""', "", "import enum"]
    for enumeration, codes in rows.codes.items():
        is_bits = enumeration.endswith("_BITS")
        lines += ["", "", f"class {class_of(type_of(enumeration))}(enum.{'IntFlag' if is_bits else 'IntEnum'}):",
                  f'    """{rows.comments[enumeration]}"""', ""]
        if is_bits:
            lines.append("    OK = 0")
        for code in codes:
            member = f"    {code.name.upper()} = {code.code}"
            line = f"{member}  #: {for_python(code.sentence)}"
            if len(line) > WIDTH:
                comment = textwrap.wrap(for_python(code.sentence), WIDTH, initial_indent="    #: ", subsequent_indent="    #: ")
                lines += [*comment, member]
            else:
                lines.append(line)
    return lines


def python_columns(rows):
    classes = {type_of(enumeration) for enumeration in rows.codes}
    lines = [f"# {WRITTEN_BY}", '"""The columns of a table of verdicts that say what became of a world."""', "",
             "from .column import Column", "", "", "class WorldColumns:",
             '    """What became of a world, one column per field. In a world that was not simulated, counts and measures are 0."""', "",
             "    __slots__ = ()", ""]
    for field in rows.world():
        sentence = for_python(field.described())
        sentence = sentence[0].upper() + sentence[1:] + "."
        if field.type in classes:
            sentence += f" See :class:`{class_of(field.type)}`."
        line = f'    {field.name} = Column("{sentence}")'
        if len(line) > WIDTH:
            parts = textwrap.wrap(sentence, WIDTH - 11, drop_whitespace=False)
            lines += [f"    {field.name} = Column(", *(f'        "{part}"' for part in parts), "    )"]
        else:
            lines.append(line)
    lines += ["", "", "#: What the columns of :meth:`Verdicts.box_outcomes` say, by their names.", "BOX_COLUMNS = {"]
    for field in rows.box():
        lines.append(f'    "{field.name}": "{for_python(field.described())}",')
    return [*lines, "}"]


def documented(sentence, indent):
    """A comment of TypeScript."""
    line = f"{indent}/** {sentence} */"
    if len(line) <= WIDTH:
        return [line]
    return [f"{indent}/**", *textwrap.wrap(sentence, WIDTH, initial_indent=f"{indent} * ", subsequent_indent=f"{indent} * "),
            f"{indent} */"]


def typescript(rows):
    lines = [f"// {WRITTEN_BY}"]
    types = {**{name: "number" for name in NUMBERS}, "hash": "string"}
    for enumeration, codes in rows.codes.items():
        name = type_of(enumeration)
        is_bits = enumeration.endswith("_BITS")
        constant = enumeration if is_bits else f"{name.upper()}_CODES"
        types[name] = "number" if is_bits else f"{class_of(name)}Name"
        lines += ["", *documented(rows.comments[enumeration], ""), f"export const {constant} = {{"]
        for code in codes:
            lines += [*documented(code.sentence, "  "), f"  {code.name}: {code.code},"]
        lines += ["} as const;", f"export type {class_of(name)}Name = keyof typeof {constant};"]
    lines += ["", *documented(rows.comments["WORLD_FIELDS"], ""), "export interface WorldOutcome {"]
    for field in rows.world():
        if field.type not in types:
            sys.exit(f"{ROWS}: the page has no type for {field.name} of a world, which is a {field.type}")
        lines += [*documented(field.described(), "  "), f"  {member_of(field.name)}: {types[field.type]};"]
    return [*lines, "}", *field_tables(rows)]


def field_tables(rows):
    """Rows of the fields themselves, for what goes through all of them."""
    sentence = "A field of an outcome: its dataset of the results file, and its heading in tables; empty: it has none."
    lines = ["", *documented(sentence, ""), "export interface OutcomeField {"]
    lines += [*(f"  {member}: string;" for member in ("name", "type", "dataset", "label")), "}"]
    for name, sentence in FIELD_TABLES.items():
        lines += ["", *documented(sentence, ""), f"export const {name}: readonly OutcomeField[] = ["]
        for field in rows.fields[name]:
            texts = {"name": member_of(field.name), "type": field.type, "dataset": field.dataset, "label": field.label}
            members = [f"{key}: {json.dumps(text)}" for key, text in texts.items()]
            line = f"  {{ {', '.join(members)} }},"
            lines += [line] if len(line) <= WIDTH else ["  {", *(f"    {member}," for member in members), "  },"]
        lines.append("];")
    return lines


# Lists of fields whose rows the page has, and what they are.
FIELD_TABLES = {
    "WORLD_FIELDS": "All that the results file has of a world, in the order of tables.",
    "BOX_FIELDS": "All that it has of what a box did.",
    "BOX_VERDICT_FIELDS": "How a box is judged by the limits.",
}


WRITERS = {
    "python/holdfast/codes.py": python_codes,
    "python/holdfast/world_columns.py": python_columns,
    "viewer/src/data/outcome.ts": typescript,
}


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    rows = Rows((ROOT / ROWS).read_text(encoding="utf-8"))
    texts = {ROOT / name: "\n".join(write(rows)) + "\n" for name, write in WRITERS.items()}
    if sys.argv[1:] == []:
        for path, text in texts.items():
            path.write_text(text, encoding="utf-8")
        return 0
    stale = [path for path, text in texts.items() if not path.exists() or path.read_text(encoding="utf-8") != text]
    for path in stale:
        print(f"{path.relative_to(ROOT)} is not current: run tools/outcome_types.py")
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
