// SPDX-License-Identifier: MIT
// Tables sort by a click on a heading: within each group, so that groups stay together.

interface Key { missing: boolean; number: number; text: string }

const kCollator = new Intl.Collator("en", { numeric: true });

function keyOf(row: HTMLTableRowElement, column: number): Key {
  const cell = row.cells[column];
  const value = cell?.dataset.value;
  const number = value === undefined ? NaN : numberOf(value);
  const missing = !cell || cell.hasAttribute("data-missing") || value === "nan";
  return { missing, number, text: cell?.textContent ?? "" };
}

function numberOf(text: string): number {
  return text === "inf" ? Infinity : text === "-inf" ? -Infinity : Number(text);
}

/** Numbers before words; what is missing or not a number is last in either direction. */
export function compare(a: Key, b: Key, direction: 1 | -1): number {
  if (a.missing || b.missing) return Number(a.missing) - Number(b.missing);
  const words = [Number.isNaN(a.number), Number.isNaN(b.number)];
  if (words[0] !== words[1]) return Number(words[0]) - Number(words[1]);
  if (words[0]) return direction * kCollator.compare(a.text, b.text);
  return direction * (a.number < b.number ? -1 : a.number > b.number ? 1 : 0);
}

export function makeSortable(table: HTMLTableElement): void {
  const headings = [...(table.tHead?.rows[0]?.cells ?? [])];
  // The order that the author chose returns on the third click.
  const given = [...table.tBodies].map((body) => [...body.rows]);
  headings.forEach((heading, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener("click", () => {
      const next = { ascending: "descending", descending: "none" }[heading.ariaSort ?? ""] ?? "ascending";
      for (const other of headings) other.removeAttribute("aria-sort");
      if (next !== "none") heading.setAttribute("aria-sort", next);
      [...table.tBodies].forEach((body, i) => {
        const rows = given[i] ?? [];
        const title = rows.filter((row) => row.classList.contains("group"));
        const data = rows.filter((row) => !row.classList.contains("group"));
        if (next !== "none") {
          const direction = next === "ascending" ? 1 : -1;
          data.sort((a, b) => compare(keyOf(a, column), keyOf(b, column), direction));
        }
        body.append(...title, ...data);
      });
    });
  });
}
