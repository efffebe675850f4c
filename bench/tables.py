"""Tables of Markdown, and how they get into a page of the documentation."""
import textwrap

COLUMNS = 120  # of the prose in docs/


def wrapped(text):
    """The text with its lines of prose wrapped; the rows of tables stay whole."""
    return "\n".join(line if line.startswith("|") else textwrap.fill(line, COLUMNS, break_on_hyphens=False)
                     for line in text.splitlines())


def table_of(title, head, rows):
    """A table under its title."""
    lines = [title, "", f"| {' | '.join(head)} |", f"|{' --- |' * len(head)}", *[f"| {' | '.join(row)} |" for row in rows]]
    return "\n".join(lines)


def replace_tables(path, tables):
    """Puts each table between the marks in the page that have its name."""
    page = path.read_text(encoding="utf-8")
    for name, text in tables.items():
        begin, end = f"<!-- {name} -->\n", f"\n<!-- end of {name} -->"
        before, found, rest = page.partition(begin)
        _, closed, after = rest.partition(end)
        if not found or not closed:
            raise ValueError(f"{path}: no marks '{begin.strip()}' and '{end.strip()}'")
        page = before + begin + wrapped(text) + end + after
    path.write_text(page, encoding="utf-8")
