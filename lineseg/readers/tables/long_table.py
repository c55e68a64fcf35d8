"""Long tables, as InfluxDB and pandas.melt write them: a row has the name of a quantity, and its value."""

from __future__ import annotations

from collections.abc import Iterable

from ..source import Source
from .dialect import Dialect, Row
from .headers import Name, is_angle, is_beam, is_distance, name_of

QUANTITIES, VALUE = ("field", "variable", "quantity", "metric"), "value"
# What differs from one quantity to the next.
OF_EXPORT = ("result", "table", "measurement", "start", "stop", "unit")
MOST_QUANTITIES = 20_000


def widened(
    source: Source, rows: Iterable[Row], dialect: Dialect, names: list[Name]
) -> tuple[Iterable[Row], list[Name]]:  # fmt: skip
    """The rows with a column for each quantity, and the names of these columns; all unchanged if no table is long.

    Raises ValueError if the quantities have no rows in common.
    """
    plain = [name.plain for name in names]
    if plain.count(VALUE) != 1 or any(map(is_distance, names)):
        return rows, names
    value = plain.index(VALUE)
    quantity = next((plain.index(word) for word in QUANTITIES if word in plain), None)
    if quantity is None:
        of_beams = any(map(is_angle, names)) or any(map(is_beam, names))
        return rows, [
            *names[:value],
            names[value]._replace(plain="distance"),
            *names[value + 1 :],
        ] if of_beams else names
    keys = [at for at, word in enumerate(plain) if at not in (value, quantity) and word and word not in OF_EXPORT]
    found: dict[str, list[tuple[int, list[bytes], bytes]]] = {}
    for number, text in rows:
        cells = dialect.cells(text)
        if len(cells) <= max(value, quantity) or dialect.number(cells[value]) is None:
            continue
        these = found.setdefault(cells[quantity].decode("utf-8", "replace"), [])
        these.append((number, [cells[at] if at < len(cells) else b"" for at in keys], cells[value]))
    first = next(iter(found.values()), [])
    if len(found) > MOST_QUANTITIES or any([each[1] for each in these] != [each[1] for each in first]
                                           for these in found.values()):  # fmt: skip
        raise ValueError(
            f"{source.name} has the quantities {', '.join(list(found)[:4])}, but not with the same rows for each; give "
            "each quantity a column, as pivot does."
        )
    mark = b"\t" if dialect.separator == b" " else dialect.separator
    wide = (
        Row(each[0][0], mark.join([*each[0][1], *(one[2] for one in each)]))
        for each in zip(*found.values(), strict=True)
    )
    return wide, [*(names[at] for at in keys), *map(name_of, found)]
