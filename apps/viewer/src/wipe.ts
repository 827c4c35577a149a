// SPDX-License-Identifier: MIT
// The border between the last observed state (left) and the current age (right).

export class Wipe {
  on = false;
  at = 0.5;  // share of the stage width
  private readonly handle = document.getElementById("wipe") as HTMLElement;
  private readonly left = document.getElementById("wipe-left") as HTMLElement;
  private readonly right = document.getElementById("wipe-right") as HTMLElement;
  private readonly button = document.getElementById("wipe-toggle") as HTMLButtonElement;

  constructor(private readonly stage: HTMLElement, private readonly onChange: () => void) {
    this.button.addEventListener("click", () => this.toggle());
    this.handle.addEventListener("pointerdown", (e) => {
      this.handle.setPointerCapture(e.pointerId);
      e.preventDefault();
    });
    this.handle.addEventListener("pointermove", (e) => {
      if (!this.handle.hasPointerCapture(e.pointerId)) return;
      const box = this.stage.getBoundingClientRect();
      this.move((e.clientX - box.left) / box.width);
    });
    this.handle.addEventListener("keydown", (e) => {
      const step = e.shiftKey ? 0.1 : 0.02;
      if (e.key === "ArrowLeft") this.move(this.at - step);
      else if (e.key === "ArrowRight") this.move(this.at + step);
      else if (e.key === "Home") this.move(0);
      else if (e.key === "End") this.move(1);
      else return;
      e.preventDefault();
      e.stopPropagation();
    });
    this.move(0.5);
  }

  toggle(): void {
    this.on = !this.on;
    this.button.setAttribute("aria-pressed", String(this.on));
    for (const e of [this.handle, this.left, this.right]) e.hidden = !this.on;
    this.onChange();
  }

  label(text: string, tone: string): void {
    this.right.textContent = text;
    this.right.className = `corner ${tone}`;
  }

  private move(at: number): void {
    this.at = Math.min(Math.max(at, 0), 1);
    this.handle.style.left = `${this.at * 100}%`;
    this.handle.setAttribute("aria-valuenow", String(Math.round(this.at * 100)));
    this.handle.setAttribute("aria-valuetext", `${Math.round(this.at * 100)} percent last observed`);
    this.onChange();
  }
}
