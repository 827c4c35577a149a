// SPDX-License-Identifier: MIT
// The figures' Vega-Lite specifications, drawn to fit the page and in its light.
import embed, { type EmbedOptions, type Result } from "vega-embed";
import { expressionInterpreter } from "vega-interpreter";

export interface Panel { width: number; height: number; [key: string]: unknown }
export interface Specification {
  columns: number;
  concat: Panel[];
  usermeta: { inks: Record<string, string>; legend: Record<string, Record<string, string | number>> };
  [key: string]: unknown;
}

const kNarrowest = 280;    // px; below, panels stand under each other
const kAxisRoom = 90;      // px beside a panel: labels and title of its axis, and the gap
const kLetter = 7.2;       // px of a letter of the legend, and of what stands before its words
const kSample = 56;
const kMostWidth = 560;    // a panel alone is not drawn across a wide screen

/** As many names side by side as fit; Vega-Lite by itself puts all of them into one row. */
function wrapLegends(value: unknown, room: number): void {
  if (value === null || typeof value !== "object") return;
  for (const channel of Object.values(value)) wrapLegends(channel, room);
  const { legend, scale } = value as { legend?: { columns: number } | null; scale?: { domain: string[] } };
  if (!legend || !scale) return;
  const longest = Math.max(...scale.domain.map((name) => name.length));
  legend.columns = Math.max(1, Math.floor(room / (longest * kLetter + kSample)));
}

/** The specification for a page of this width; colors in their dark twins if need be. */
export function fitted(given: Specification, room: number, dark: boolean): Specification {
  const { inks } = given.usermeta;
  // Colors are whole strings in the ranges of scales; no text of a report is one by accident, and
  // if it were, only its letters would change.
  const spec = JSON.parse(JSON.stringify(given, (_, value) =>
    dark && typeof value === "string" ? inks[value] ?? value : value)) as Specification;
  const columns = Math.min(given.columns, room >= 2 * (kNarrowest + kAxisRoom) ? 2 : 1);
  const width = Math.min(Math.floor(room / columns) - kAxisRoom, kMostWidth);
  spec.columns = columns;
  for (const panel of spec.concat) {
    wrapLegends(panel.layer, room - kAxisRoom);
    panel.width = Math.max(width, 160);
    panel.height = Math.round(Math.min(300, Math.max(200, width * 0.62)));
  }
  return spec;
}

function look(dark: boolean): EmbedOptions["config"] {
  const text = dark ? "#d6d6d6" : "#303030", line = dark ? "#8a8a8a" : "#555555";
  const font = getComputedStyle(document.body).fontFamily;
  const words = { labelColor: text, titleColor: text, labelFont: font, titleFont: font };
  return {
    background: "transparent", font,
    axis: { ...words, labelFontSize: 12, titleFontSize: 13, titleFontWeight: "normal", titlePadding: 8,
      domainColor: line, tickColor: line, gridColor: dark ? "#3a3a3a" : "#e2e0dc" },
    legend: { ...words, labelFontSize: 13, columnPadding: 18 },
    title: { color: text, font, fontSize: 14, fontWeight: 600 },
    view: { stroke: "transparent" },
  };
}

interface Legend { encode?: { symbols?: { update?: Record<string, unknown> } } }

/** Gives the entries of the compiled chart's legends the looks that Vega-Lite cannot say. */
function dressLegends(legends: Legend[], looks: Specification["usermeta"]["legend"]): void {
  for (const legend of legends) {
    const symbols = (legend.encode ??= {}).symbols ??= {};
    symbols.update = { ...symbols.update };
    for (const [property, values] of Object.entries(looks)) {
      // Where the layout asks for sizes the datum is the name itself.
      const signal = `${JSON.stringify(values)}[isObject(datum) ? datum.value : datum]`;
      symbols.update[property] = { signal };
    }
  }
}

const drawn = new Map<string, Result>();
let turn = 0;

/** Draws every figure; where one fails its drawing stays in place. */
export async function drawCharts(figures: Record<string, Specification>, dark: boolean,
                                 charts: Record<string, unknown>): Promise<void> {
  const mine = ++turn;
  for (const [id, given] of Object.entries(figures)) {
    const figure = document.getElementById(`figure-${id}`);
    const place = figure?.querySelector<HTMLElement>(".chart");
    if (!figure || !place || given.concat.length === 0) continue;
    try {
      const spec = fitted(given, figure.clientWidth, dark);
      drawn.get(id)?.finalize();
      const result = await embed(place, spec as never, {
        mode: "vega-lite", renderer: "svg", actions: false, defaultStyle: false,
        // The interpreter reads expressions without eval, which the page's policy forbids.
        ast: true, expr: expressionInterpreter,
        tooltip: { disableDefaultStyle: true }, config: look(dark),
        patch: (compiled) => {
          dressLegends((compiled.legends ?? []) as Legend[], given.usermeta.legend);
          return compiled;
        },
      });
      drawn.set(id, result);
      charts[id] = result.view;
      figure.classList.add("charted");
    } catch (error) {
      figure.classList.remove("charted");
      console.error(`figure ${id}`, error);
    }
    if (mine !== turn) return;  // a newer width or light is being drawn
  }
}
