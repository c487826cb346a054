// Sorts the rows of a table by the column whose heading is activated: ascending, descending, and
// then in the order of the page again. Sections stay together, and averages keep their place.
"use strict";
const NEXT = { none: "ascending", ascending: "descending", descending: "none" };
const SIGN = { none: 0, ascending: 1, descending: -1 };
for (const table of document.querySelectorAll("table")) {
  const bodies = Array.from(table.tBodies, (body) => {
    const rows = Array.from(body.rows, (row) => ({ row, stays: row.matches(".section, .average") }));
    return { body, rows };
  });

  // Numbers come before names, and a missing value is last in either direction.
  const key = (row, column) => {
    const cell = row.cells[column];
    const value = cell?.dataset.value;
    if (value === undefined) return { rank: 1, of: cell?.textContent ?? "" };
    const number = value === "" ? NaN : Number(value.replace("inf", "Infinity"));
    return Number.isNaN(number) ? { rank: 2, of: 0 } : { rank: 0, of: number };
  };
  const names = new Intl.Collator("en", { numeric: true });
  const compare = (a, b, sign) => {
    if (a.rank !== b.rank) return a.rank - b.rank;
    if (a.rank === 1) return sign * names.compare(a.of, b.of);
    return a.of === b.of ? 0 : sign * (a.of < b.of ? -1 : 1);
  };

  const sort = (column, sign) => {
    for (const { body, rows } of bodies) {
      const moved = rows.filter(({ stays }) => !stays);
      const sorted = moved.map(({ row }) => ({ row, key: key(row, column) }));
      if (sign !== 0) sorted.sort((a, b) => compare(a.key, b.key, sign));
      const next = sorted.values();
      const order = document.createDocumentFragment();
      for (const { row, stays } of rows) order.append(stays ? row : next.next().value.row);
      body.append(order);
    }
  };

  const headings = Array.from(table.querySelectorAll("thead th[data-column]"));
  for (const heading of headings) {
    heading.querySelector("button").addEventListener("click", () => {
      const order = NEXT[heading.getAttribute("aria-sort")];
      for (const other of headings) other.setAttribute("aria-sort", "none");
      heading.setAttribute("aria-sort", order);
      sort(Number(heading.dataset.column), SIGN[order]);
    });
  }
}
