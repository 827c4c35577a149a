// SPDX-License-Identifier: MIT
import { type AgeSlider } from "./age_slider";
import { type MapView } from "./flat";
import { type FlatGestures } from "./flat_gestures";
import { type Stage } from "./scene";
import { type Shape } from "./shapes";
import { type Wipe } from "./wipe";

export interface Actions {
  slider: AgeSlider; wipe: Wipe; stage: Stage; gestures: FlatGestures;
  /** In the order of their keys, from 1. */
  maps: readonly MapView[];
  toggleOverlay(): void;
  turnLight(degrees: number): void;
  pickMap(view: MapView): void;
  pickShape(shape: Shape): void;
}

export function listen(actions: Actions): void {
  const canvas = document.getElementById("view")!;
  const help = document.getElementById("help") as HTMLDialogElement;
  const toggleHelp = () => (help.open ? help.close() : help.showModal());
  document.getElementById("help-toggle")!.addEventListener("click", toggleHelp);
  document.addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || e.defaultPrevented) return;
    const target = e.target as HTMLElement;
    const key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
    if (key === "h") { toggleHelp(); return; }
    if (help.open) return;
    if (target === canvas && actions.gestures.key(key)) { e.preventDefault(); return; }
    if (target === canvas && key.startsWith("Arrow") && !actions.gestures.on) {
      const turn = 0.12;
      if (key === "ArrowLeft") actions.stage.turn(-turn, 0);
      if (key === "ArrowRight") actions.stage.turn(turn, 0);
      if (key === "ArrowUp") actions.stage.turn(0, turn);
      if (key === "ArrowDown") actions.stage.turn(0, -turn);
      e.preventDefault();
      return;
    }
    if (target.id === "light" && /^(Arrow|Home|End|Page)/.test(key)) return;   // its own keys
    const { slider } = actions, step = e.shiftKey ? 5 : 0.5;
    // The browser's own keys on the slider would step along the track, not in units.
    const onSlider = target.id === "slider";
    if (onSlider && key === "PageDown") slider.step(-5);
    else if (onSlider && key === "PageUp") slider.step(5);
    else if (key === "ArrowLeft" || (onSlider && key === "ArrowDown")) slider.step(-step);
    else if (key === "ArrowRight" || (onSlider && key === "ArrowUp")) slider.step(step);
    else if (key === "Home") slider.set(slider.range.first);
    else if (key === "End") slider.set(slider.range.last);
    else if (key === " " && target.tagName !== "BUTTON") slider.toggle();
    else if (key === "[") actions.turnLight(-15);
    else if (key === "]") actions.turnLight(15);
    else if (key === "w") actions.wipe.toggle();
    else if (key === "s") actions.pickShape("sphere");
    else if (key === "p") actions.pickShape("plane");
    else if (key === "c") actions.pickShape("curved");
    else if (key === "u") actions.toggleOverlay();
    else if (/^[1-9]$/.test(key) && actions.maps[Number(key) - 1]) actions.pickMap(actions.maps[Number(key) - 1]!);
    else return;
    e.preventDefault();
  });
}
