"""Tables as data frames of the libraries that are installed."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas
    import polars


def to_pandas(csv: str) -> pandas.DataFrame:
    """A CSV table for pandas, with every number to the last bit."""
    import pandas

    table = pandas.read_csv(io.StringIO(csv))
    # The reader of pandas is one bit off now and then; Python's numbers are exact.
    floats = [name for name in table.columns if table[name].dtype == "float64"]
    if floats:
        exact = pandas.read_csv(io.StringIO(csv), usecols=floats, converters=dict.fromkeys(floats, _number))
        for name in floats:
            table[name] = exact[name].astype("float64")
    return table


def _number(text: str) -> float:
    return float(text) if text else float("nan")


def to_polars(csv: str) -> polars.DataFrame:
    """A CSV table for polars."""
    import polars

    return polars.read_csv(io.BytesIO(csv.encode()), infer_schema_length=None)


def numbers(value: Any) -> Any:
    """JSON with infinite numbers in place of their names."""
    if isinstance(value, dict):
        return {key: numbers(item) for key, item in value.items()}
    if isinstance(value, list):
        return [numbers(item) for item in value]
    if value in ("inf", "-inf") and isinstance(value, str):
        return float(value)
    return value


def html_table(head: list[str], rows: list[list[str]]) -> str:
    """A table as HTML, with all but its first column to the right."""
    from html import escape

    def cell(tag: str, nth: int, text: str) -> str:
        side = "left" if nth == 0 else "right"
        return f'<{tag} style="text-align: {side}">{escape(text)}</{tag}>'

    lines = ["<table>", "<thead><tr>"]
    lines += [cell("th", nth, text) for nth, text in enumerate(head)]
    lines.append("</tr></thead><tbody>")
    for row in rows:
        lines.append("<tr>" + "".join(cell("td", nth, text) for nth, text in enumerate(row)) + "</tr>")
    lines.append("</tbody></table>")
    return "\n".join(lines)


def shown(value: float | None) -> str:
    """A number as people read it."""
    if value is None:
        return "–"
    if value != value or value in (float("inf"), float("-inf")):
        return str(value)
    size = abs(value)
    if size != 0 and size < 1e-3:
        return f"{value:.3g}"
    return f"{value:.4f}" if size < 10 else f"{value:.2f}"
