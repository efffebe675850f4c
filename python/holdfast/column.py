"""A column of a table as an attribute."""

from typing import Any, Optional


class Column:
    """A column of the structured array ``table`` of an object, as a view of its memory; named as the attribute is,
    unless a name is given."""

    def __init__(self, sentence: str, name: str = "") -> None:
        self.__doc__ = sentence
        self._name = name

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, of: Optional[Any], owner: type) -> Any:
        return self if of is None else of.table[self._name]
