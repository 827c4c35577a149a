// SPDX-License-Identifier: MIT
// How to read what is shown: a bar whose two ends have words, a sentence, or both.
import { type MapView, mapNote } from "./flat";
import { magmaGradient } from "./magma";
import { type ViewerDocument } from "./data";

const element = (id: string) => document.getElementById(id) as HTMLElement;

export class Legend {
  private readonly box = element("legend");
  private readonly bar = element("legend-bar");

  constructor(private readonly doc: ViewerDocument) {}

  /** `over`: the uncertainty is laid over the material. */
  show(view: MapView, over: boolean, age: number): void {
    const unsure = view === "uncertainty" || (over && (view === "lit" || view === "albedo"));
    const { note, scale } = unsure ? this.uncertainty(view, age)
      : mapNote(view, this.doc.material.observed_is_clean);
    this.box.hidden = !note && !scale;
    this.box.classList.toggle("scaled", scale !== undefined);
    this.box.classList.toggle("noted", scale !== undefined && note !== "");
    this.box.dataset.map = view;
    this.bar.style.background = unsure ? magmaGradient() : "";
    this.put("legend-low", scale?.[0] ?? "");
    this.put("legend-high", scale?.[1] ?? "");
    this.put("legend-note", note);
  }

  /** Pixels from the bottom of the stage to its upper edge. */
  get below(): number {
    return this.box.hidden ? 0 : this.box.parentElement!.clientHeight - this.box.offsetTop;
  }

  private uncertainty(view: MapView, age: number): { note: string; scale: [string, string] } {
    const codes = Number((this.doc.spread?.full_codes ?? 0).toPrecision(4));
    const scale: [string, string] = ["0", `${codes} codes of 255 or more`];
    if (age < 0.05) return { note: "Observed: nothing is forecast here, so there is no interval.", scale };
    const rest = view === "uncertainty" ? "Gray: held." : "Unpainted: surest, or held.";
    return { note: "Nominally 4 times in 5 a pixel is off by at most this (root mean square of R, G, B). " + rest, scale };
  }

  private put(id: string, text: string): void {
    const e = element(id);
    if (e.textContent !== text) e.textContent = text;
    e.hidden = text === "";
  }
}
