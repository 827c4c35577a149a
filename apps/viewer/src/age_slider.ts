// SPDX-License-Identifier: MIT
// The age: a range input over observed and forecast units, the border between them, the trust
// limit, a tick per delivered horizon, play. The input holds a place on the track (age_scale.ts);
// the age itself, in units, is kept here, so that what is set is what is read.
import { type AgeScale, ageScale, toAge, toTrack } from "./age_scale";
import { layTrack } from "./age_track";
import { type ViewerDocument } from "./data";

/** `held`: the forecast is the last observed state at every age. */
export interface AgeRange { first: number; last: number; trust: number; held: boolean }

const element = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export function ageText(age: number, held: boolean): string {
  const units = Math.abs(age).toFixed(1);
  if (age <= -0.05) return `observed, ${units} units before the last frame`;
  if (age < 0.05) return "last observed frame";
  // Else a picture that stays the same would look like a forecast that nothing will happen.
  return `forecast, +${units} accelerated units` + (held ? ", held" : "");
}

/** The same for a corner of the picture. */
export function shortAge(age: number, held: boolean): string {
  if (Math.abs(age) < 0.05) return "last observed";
  if (age < 0) return `observed, \u2212${(-age).toFixed(1)}`;
  return `forecast, +${age.toFixed(1)}` + (held ? ", held" : "");
}

/** The color that goes with an age. */
export function ageTone(age: number, range: AgeRange): "observed" | "forecast" | "beyond" {
  return age < 0.05 ? "observed" : age > range.trust ? "beyond" : "forecast";
}

export class AgeSlider {
  private readonly input = element<HTMLInputElement>("slider");
  private readonly readout = element<HTMLOutputElement>("readout");
  private readonly playButton = element<HTMLButtonElement>("play");
  private readonly scale: AgeScale;
  private current = 0;
  private playing = 0;
  private lastStep = 0;

  constructor(doc: ViewerDocument, readonly range: AgeRange, private readonly onAge: (age: number) => void) {
    this.scale = ageScale(range.first, range.last);
    this.input.min = "0";
    this.input.max = "1";
    this.input.step = "any";
    layTrack(doc, range, this.scale, (unit) => { this.pause(); this.set(unit); });
    this.input.addEventListener("input", () => {
      this.pause();
      this.update(toAge(this.scale, Number(this.input.value)));
    });
    this.playButton.addEventListener("click", () => this.toggle());
  }

  get age(): number { return this.current; }

  set(age: number): void {
    const held = Math.min(Math.max(age, this.range.first), this.range.last);
    this.input.value = String(toTrack(this.scale, held));
    this.update(held);
  }

  /** To the next multiple of the step: 0.5 from +3.2 is +3.5. */
  step(by: number): void {
    this.pause();
    const size = Math.abs(by), grid = this.age / size;
    const next = by > 0 ? Math.floor(grid + 1e-6) + 1 : Math.ceil(grid - 1e-6) - 1;
    this.set(next * size);
  }

  toggle(): void {
    if (this.playing) { this.pause(); return; }
    if (this.age >= this.range.last) this.set(this.range.first);
    this.lastStep = performance.now();
    this.show(true);
    // chosen: the whole axis in 14 seconds, in units and not along the track: at the break the metal
    // must not seem to age slower. Who asked for less motion gets two steps a second.
    const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    const frame = (now: number) => {
      const past = Math.max(now - this.lastStep, 0);
      if (past >= (still ? 500 : 0)) {
        this.lastStep = now;
        this.set(this.age + (past / 14000) * (this.range.last - this.range.first));
      }
      if (this.age >= this.range.last) { this.pause(); return; }
      this.playing = requestAnimationFrame(frame);
    };
    this.playing = requestAnimationFrame(frame);
  }

  private pause(): void {
    if (!this.playing) return;
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    this.show(false);
  }

  private show(playing: boolean): void {
    this.playButton.textContent = playing ? "Pause" : "Play";
    this.playButton.setAttribute("aria-pressed", String(playing));
  }

  private update(age: number): void {
    this.current = age;
    const beyond = age > this.range.trust;
    const text = ageText(age, this.range.held);
    this.input.setAttribute("aria-valuetext",
      text + (beyond ? ", beyond what the context supports" : ""));
    this.readout.textContent = text;
    this.readout.className = Math.abs(age) < 0.05 ? "" : ageTone(age, this.range);
    element("caution").hidden = !beyond;
    this.onAge(age);
  }
}
