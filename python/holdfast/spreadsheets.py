"""Spreadsheets as tables of text, which the library reads."""

from __future__ import annotations

import csv
import importlib
import io
import math
import os
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple, Optional, Union

from .errors import Error, Problem


class Sheet(NamedTuple):
    """A sheet of a spreadsheet, and the names of all that there are."""

    rows: list[Sequence[Any]]
    names: list[str]


def read_sheet(path: str, sheet: Union[int, str]) -> Optional[Sheet]:
    """A sheet of a spreadsheet, .xlsx or .ods; None where the name is that of no spreadsheet.

    :raises Error: it cannot be read, or the package that reads it is not installed
    """
    kind = os.path.splitext(path)[1].lower()
    if kind not in (".xlsx", ".xlsm", ".ods", ".xls"):
        return None
    try:
        if kind in (".xlsx", ".xlsm"):
            return _sheet_of_xlsx(path, sheet)
        import pandas

        with pandas.ExcelFile(path, engine="odf" if kind == ".ods" else None) as book:
            table = book.parse(sheet_name=sheet, header=None, dtype=object)
            return Sheet([list(row) for row in table.itertuples(index=False, name=None)], list(map(str, book.sheet_names)))
    except ImportError as error:
        needed = {".xlsx": "openpyxl", ".xlsm": "openpyxl", ".ods": "pandas and odfpy", ".xls": "pandas and xlrd"}[kind]
        raise _wrong(path, f"a spreadsheet needs a package that is not installed: {error.name or needed}",
                     f"install {needed}, or save the sheet as CSV (UTF-8)") from None
    except Exception as error:  # whatever these packages raise for files that are none
        raise _wrong(path, f"the spreadsheet cannot be read: {error}", "a sheet that is saved as CSV (UTF-8) can") from error


def _sheet_of_xlsx(path: str, sheet: Union[int, str]) -> Sheet:
    openpyxl: Any = importlib.import_module("openpyxl")

    book = openpyxl.load_workbook(path, read_only=True, data_only=True)
    try:
        chosen = book[sheet] if isinstance(sheet, str) else book.worksheets[sheet]
        return Sheet([list(row) for row in chosen.iter_rows(values_only=True)], list(book.sheetnames))
    finally:
        book.close()


def text_of_rows(rows: Iterable[Sequence[Any]]) -> str:
    """Rows as the text of a table; a row is a line. Numbers have as many digits as give them back."""
    text = io.StringIO()
    writer = csv.writer(text, dialect="excel-tab", quoting=csv.QUOTE_ALL, lineterminator="\n")
    for row in rows:
        cells = [_cell(value) for value in row]
        if any(cells):
            writer.writerow(cells)
        else:
            text.write("\n")
    return text.getvalue()


def _cell(value: Any) -> str:
    if hasattr(value, "item"):
        value = value.item()  # of numpy
    if value is None or (isinstance(value, float) and math.isnan(value)) or type(value).__name__ in ("NAType", "NaTType"):
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    return " ".join((repr(value) if isinstance(value, float) else str(value)).split())


def _wrong(path: str, what: str, accepted: str) -> Error:
    return Error([Problem(f"{path}: {what}; {accepted}", what, "", accepted, file=path)])
