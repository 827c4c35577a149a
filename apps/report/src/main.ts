// SPDX-License-Identifier: MIT
// What the report's page can do that paper cannot: charts that answer, tables that sort.
import { drawCharts, type Specification } from "./charts";
import { makeSortable } from "./sorting";

declare global {
  interface Window {
    /** For tests: all charts are drawn, and the views behind them by figure. */
    verdigris: { ready: Promise<void>; charts: Record<string, unknown> };
  }
}

const text = document.getElementById("verdigris-data")?.textContent ?? "{}";
const { figures = {} } = JSON.parse(text) as { figures?: Record<string, Specification> };
for (const table of document.querySelectorAll<HTMLTableElement>("main table")) makeSortable(table);

const charts: Record<string, unknown> = {};
const dark = matchMedia("(prefers-color-scheme: dark)");
const redraw = () => drawCharts(figures, dark.matches, charts);
window.verdigris = { ready: redraw(), charts };

dark.addEventListener("change", () => void redraw());
let width = innerWidth, later = 0;
addEventListener("resize", () => {
  if (innerWidth === width) return;  // a phone's address bar hides
  width = innerWidth;
  clearTimeout(later);
  later = window.setTimeout(() => void redraw(), 200);
});
