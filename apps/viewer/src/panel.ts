// SPDX-License-Identifier: MIT
// The words: which forecaster and why, the guards, what a unit is, how each map is known.
import { ageScale } from "./age_scale";
import { type ViewerDocument } from "./data";
import { mapsOf } from "./flat";

// Text goes in through textContent only: a hostile file name stays text.
function add(parent: HTMLElement, tag: string, text = "", className = ""): HTMLElement {
  const e = document.createElement(tag);
  e.textContent = text;
  if (className) e.className = className;
  parent.append(e);
  return e;
}

const kSymbols: Record<string, string> = { info: "i", caution: "!", refusal: "\u00d7" };
const kWords: Record<string, string> = { info: "Note", caution: "Caution", refusal: "Refused" };

export function fillPanel(doc: ViewerDocument): void {
  const panel = document.getElementById("panel")!;
  add(panel, "h2", "Forecast");
  add(panel, "p", doc.forecaster.explanation);
  add(panel, "p", `${doc.forecaster.name}; its context is the last ${doc.context} observed frames, one unit apart.`, "quiet");

  if (doc.uncertainty?.length) {
    add(panel, "h2", "How sure");
    add(panel, "p", "How far off the forecast may be, in codes of 255, nominally 80 (95) times in 100:");
    const rows = add(panel, "dl", "", "sure");
    const codes = (v: number) => (255 * v < 9.95 ? (255 * v).toFixed(1) : (255 * v).toFixed(0));
    for (const u of doc.uncertainty) {
      add(rows, "dt", `+${u.horizon}`);
      add(rows, "dd", `mean color ${codes(u.mean_80)} (${codes(u.mean_95)}), a pixel ${codes(u.pixel_80)} (${codes(u.pixel_95)})`);
    }
    if (doc.spread) {
      add(panel, "p", "Where it is more and where less: the map \u201cUncertainty\u201d (key 8), or laid over the " +
        "material (key U).", "quiet");
    }
  }

  if (doc.guards.length) add(panel, "h2", "Read this first");
  const list = doc.guards.length ? add(panel, "ul", "", "guards") : null;
  const weight: Record<string, number> = { refusal: 0, caution: 1, info: 2 };
  for (const g of [...doc.guards].sort((a, b) => (weight[a.severity] ?? 2) - (weight[b.severity] ?? 2))) {
    const item = add(list!, "li", "", g.severity);
    add(item, "span", kSymbols[g.severity] ?? "i", "symbol").setAttribute("aria-hidden", "true");
    const body = add(item, "p");
    add(body, "strong", `${kWords[g.severity] ?? "Note"}. `);
    body.append(g.sentence);
  }

  add(panel, "h2", "What a unit is");
  add(panel, "p", `One accelerated unit is a fixed fraction of the observed recording, which spans ` +
    `${doc.units_observed.toFixed(1)} of them. It is not calendar time: how fast a piece ages ` +
    `elsewhere cannot be read off this page.`);
  const first = Math.min(...doc.observed.map((o) => o.unit), 0);
  if (ageScale(first, Math.max(...doc.horizons, 1)).broken) {
    add(panel, "p", "On the age axis the observed stretch is drawn tighter than the forecast: the " +
      "scale changes at now, and the notches on both sides are the same number of units apart.");
  }

  add(panel, "h2", "How each map is known");
  const table = add(panel, "dl", "", "origins");
  for (const o of doc.origins) {
    const term = add(table, "dt", `${o.map} `);
    add(term, "span", o.origin, `origin ${o.origin}`);
    add(table, "dd", o.sentence);
  }
  add(panel, "p", `Verdigris ${doc.version}`, "quiet");
}

export function fillHelp(doc: ViewerDocument): void {
  const dialog = document.getElementById("help") as HTMLDialogElement;
  add(dialog, "h2", "Keyboard");
  const list = add(dialog, "dl"), maps = mapsOf(doc);
  const rows: [string, string][] = [
    ["\u2190 \u2192", "younger, older (with Shift: by 5 units)"], ["Home End", "first observed, last forecast"],
    ["Space", "play, pause"], [`1 \u2026 ${maps.length}`, maps.join(", ")],
    ["S P C", "sphere, plane, curved sheet"], ["W", "wipe against the last observed frame"],
    ...(doc.spread ? [["U", "the uncertainty over the material"] as [string, string]] : []),
    ["[ ]", "turn the light"], ["Arrows on the picture", "turn the shape, or move a flat map"],
    ["+ \u2212 0 on a flat map", "nearer, farther, all of it"], ["H", "this list"], ["Esc", "close"],
  ];
  for (const [keys, what] of rows) {
    add(list, "dt", keys);
    add(list, "dd", what);
  }
  const close = add(dialog, "button", "Close") as HTMLButtonElement;
  close.type = "button";
  close.addEventListener("click", () => dialog.close());
}
