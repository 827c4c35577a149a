// SPDX-License-Identifier: MIT
// What lies under the age slider: the three stretches of the axis, their border, the ticks.
import { type AgeScale, evenStep, toTrack } from "./age_scale";
import { type AgeRange } from "./age_slider";
import { type ViewerDocument } from "./data";

const element = (id: string) => document.getElementById(id)!;
const unitText = (unit: number) => String(Math.round(unit * 100) / 100);

export function layTrack(doc: ViewerDocument, range: AgeRange, scale: AgeScale,
                         go: (unit: number) => void): void {
  const { first, last, trust } = range;
  // The thumb's center runs from half a thumb to the width less half a thumb.
  const at = (unit: number) => `calc(var(--thumb) / 2 + (100% - var(--thumb)) * ${toTrack(scale, unit)})`;

  const captions: { span: HTMLElement; labels: string[] }[] = [];
  const zone = (name: string, from: number, to: number, ...labels: string[]) => {
    if (to <= from) return;
    const div = document.createElement("div"), caption = document.createElement("span");
    div.className = name;
    div.style.left = at(from);
    div.style.right = `calc(100% - (${at(to)}))`;
    captions.push({ span: caption, labels });
    div.append(caption);
    element("zones").append(div);
  };
  if (scale.broken) zone("observed", first, 0, "observed, on a tighter scale", "observed");
  else zone("observed", first, 0, "observed");
  zone("forecast", 0, Math.min(trust, last), "forecast");
  zone("beyond", Math.max(trust, 0), last, "beyond the trust limit", "trust limit");
  const mark = (name: string, unit: number) => {
    const div = document.createElement("div");
    div.className = name;
    div.style.left = at(unit);
    element("zones").append(div);
  };
  // One notch per so many units on both sides: where they crowd, the scale is tighter. chosen: 15.
  const step = evenStep(scale, 15);
  for (let k = Math.ceil(first / step); k * step < last; k++) {
    if (k !== 0 && k * step > first) mark("notch", k * step);
  }
  if (scale.broken) mark("break", 0);
  mark("now", 0);
  element("caution").textContent = `Caution: past +${unitText(trust)}, twice the ${doc.context} ` +
    "frames fitted, it goes further than the observation supports.";

  const ticks: { button: HTMLButtonElement; unit: number; rank: number }[] = [];
  const tick = (unit: number, label: string, spoken: string, rank: number) => {
    const button = document.createElement("button"), text = document.createElement("span");
    button.type = "button";
    text.textContent = label;
    button.append(text);
    button.style.left = at(unit);
    button.setAttribute("aria-label", spoken);
    button.title = spoken;
    button.addEventListener("click", () => go(unit));
    ticks.push({ button, unit, rank });
  };
  const middle = Math.round(first / 2 / step) * step;
  if (middle < 0 && middle > first) {
    tick(middle, `\u2212${unitText(-middle)}`, `Go to ${unitText(-middle)} units before the last frame`, 4);
  }
  if (first < -1) tick(first, `\u2212${unitText(-first)}`, "Go to the first observed frame shown", 2);
  tick(0, "now", "Go to the last observed frame", 0);
  for (const h of doc.horizons) {
    tick(h, `+${unitText(h)}`, `Go to the forecast at +${unitText(h)} units`, h === last ? 1 : 3);
  }
  element("ticks").append(...ticks.map((t) => t.button));

  // Labels that would overlap give way, the less important first; their marks stay clickable.
  const makeRoom = () => {
    for (const { span, labels } of captions) {
      for (const label of [...labels, ""]) {
        span.textContent = label;
        if (span.scrollWidth <= span.clientWidth) break;
      }
    }
    const width = element("track").clientWidth, taken: [number, number][] = [];
    for (const { button, unit } of [...ticks].sort((a, b) => a.rank - b.rank || a.unit - b.unit)) {
      const label = button.firstElementChild as HTMLElement;
      const half = (label.textContent!.length * 7.5 + 8) / 2, x = toTrack(scale, unit) * width;
      const free = taken.every(([from, to]) => x + half < from || x - half > to);
      button.classList.toggle("tight", !free);
      if (free) taken.push([x - half, x + half]);
    }
  };
  new ResizeObserver(makeRoom).observe(element("track"));
}
