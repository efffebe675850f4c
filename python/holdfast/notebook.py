"""What tables of a notebook have in common."""

from __future__ import annotations

#: Layouts that a notebook shows one by one.
MOST_SHOWN = 20


def counted(number: int, noun: str) -> str:
    """A number with its noun."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def more_layouts(number: int, columns: int) -> list[str]:
    """The last row of a table that does not show all of so many layouts; none where it does."""
    hidden = number - MOST_SHOWN
    return [f"<tr><td colspan='{columns}'>and {counted(hidden, 'more layout')}</td></tr>"] if hidden > 0 else []
