"""Results of ``PathSet.table``."""

from __future__ import annotations

from typing import Any, Dict, Iterator, List, Mapping, Sequence

import numpy as np

from .queries import masked

__all__ = ["Table"]


class Table(Mapping[str, np.ma.MaskedArray]):
    """Columns of equal length by name, in order; one row per group, ordered by the groups' keys.

    Unknown values are masked. ``str(table)`` is an aligned text.

    Attributes:
        group_keys: names of the columns that the rows are grouped by.
        row_count: groups; 1 without ``group by``.
    """

    def __init__(self, columns: Sequence[Any], rows: int):
        self._columns: Dict[str, np.ma.MaskedArray] = {}
        self.group_keys: List[str] = []
        self.row_count = rows
        for name, key, (kind, values, known) in columns:
            self._columns[name] = masked(values, known, kind)
            if key:
                self.group_keys.append(name)

    def __getitem__(self, name: str) -> np.ma.MaskedArray:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def rows(self) -> List[Dict[str, Any]]:
        """One dictionary per row; None where a value is unknown."""
        lists = {name: column.tolist() for name, column in self._columns.items()}
        return [{name: values[i] for name, values in lists.items()} for i in range(self.row_count)]

    def to_dataframe(self) -> Any:
        """A pandas DataFrame, indexed by the keys if there are any. Raises ImportError without pandas."""
        from .dataframes import table_frame
        return table_frame(self)

    def __str__(self) -> str:
        def text(value: Any) -> str:
            if value is None:
                return ""
            return f"{value:.6g}" if isinstance(value, float) else str(value)
        lines = [list(self._columns)] + [[text(row[name]) for name in self._columns] for row in self.rows()]
        widths = [max(len(line[i]) for line in lines) for i in range(len(self._columns))]
        return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(line, widths)) for line in lines)

    def __repr__(self) -> str:
        return f"<Table: {self.row_count} rows; {', '.join(self._columns)}>"
