// SPDX-License-Identifier: MIT
// The age: a range input over observed and forecast units, the border between them, the trust
// limit, a tick per delivered horizon, play.
import { type ViewerDocument } from "./data";

export interface AgeRange { first: number; last: number; trust: number }

const element = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export function ageText(age: number): string {
  const units = Math.abs(age) < 0.05 ? "0" : Math.abs(age).toFixed(1);
  if (age < -0.05) return `observed, ${units} units before the last frame`;
  if (age < 0.05) return "last observed frame";
  return `forecast, +${units} accelerated units`;
}

export class AgeSlider {
  private readonly input = element<HTMLInputElement>("slider");
  private readonly readout = element<HTMLOutputElement>("readout");
  private readonly playButton = element<HTMLButtonElement>("play");
  private playing = 0;
  private lastTick = 0;

  constructor(
    doc: ViewerDocument, readonly range: AgeRange,
    private readonly onAge: (age: number) => void,
  ) {
    const { first, last, trust } = range, span = last - first;
    this.input.min = String(first);
    this.input.max = String(last);
    this.input.step = "0.1";
    const at = (unit: number) => `calc(var(--thumb) / 2 + (100% - var(--thumb)) * ${(unit - first) / span})`;
    const zones = element("zones");
    const zone = (className: string, from: number, to: number) => {
      if (to <= from) return;
      const div = document.createElement("div");
      div.className = className;
      div.style.left = at(from);
      div.style.right = `calc(100% - (${at(to)}))`;
      zones.append(div);
    };
    zone("observed", first, 0);
    zone("forecast", 0, Math.min(trust, last));
    zone("beyond", Math.max(trust, 0), last);
    const now = document.createElement("div");
    now.className = "now";
    now.style.left = at(0);
    zones.append(now);
    const ticks = element("ticks");
    const tick = (unit: number, label: string, spoken: string) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = label;
      button.style.left = at(unit);
      button.setAttribute("aria-label", spoken);
      button.addEventListener("click", () => this.set(unit));
      ticks.append(button);
    };
    tick(0, "now", "Go to the last observed frame");
    for (const h of doc.horizons) tick(h, `+${h}`, `Go to the forecast at +${h} units`);
    if (first < -1) tick(first, `\u2212${Math.abs(first).toFixed(0)}`, "Go to the first observed frame shown");
    this.input.addEventListener("input", () => { this.pause(); this.update(Number(this.input.value)); });
    this.playButton.addEventListener("click", () => this.toggle());
  }

  get age(): number { return Number(this.input.value); }

  set(age: number): void {
    this.input.value = String(Math.min(Math.max(age, this.range.first), this.range.last));
    this.update(Number(this.input.value));
  }

  toggle(): void {
    if (this.playing) { this.pause(); return; }
    if (this.age >= this.range.last) this.set(this.range.first);
    this.lastTick = performance.now();
    this.show(true);
    const frame = (now: number) => {
      // chosen: the whole axis in 14 seconds.
      const next = this.age + ((now - this.lastTick) / 14000) * (this.range.last - this.range.first);
      if (next - this.age >= 0.1) { this.lastTick = now; this.set(next); }
      if (this.age >= this.range.last) { this.pause(); return; }
      this.playing = requestAnimationFrame(frame);
    };
    this.playing = requestAnimationFrame(frame);
  }

  private pause(): void {
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    this.show(false);
  }

  private show(playing: boolean): void {
    this.playButton.textContent = playing ? "Pause" : "Play";
    this.playButton.setAttribute("aria-pressed", String(playing));
  }

  private update(age: number): void {
    const beyond = age > this.range.trust;
    const text = ageText(age) + (beyond ? ", beyond what the context supports" : "");
    this.input.setAttribute("aria-valuetext", text);
    this.readout.textContent = text;
    this.readout.className = age < -0.05 ? "observed" : beyond ? "beyond" : age > 0.05 ? "forecast" : "";
    this.onAge(age);
  }
}
