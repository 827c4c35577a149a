// SPDX-License-Identifier: MIT
// A row of buttons of which exactly one is pressed.

export class ButtonRow<T extends string> {
  private readonly buttons = new Map<T, HTMLButtonElement>();
  constructor(id: string, names: readonly T[], hints: (name: T, index: number) => string,
              onPick: (name: T) => void) {
    const row = document.getElementById(id)!;
    names.forEach((name, index) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = name[0]!.toUpperCase() + name.slice(1);
      button.title = `Key ${hints(name, index)}`;
      button.setAttribute("aria-keyshortcuts", hints(name, index));
      button.addEventListener("click", () => { this.press(name); onPick(name); });
      this.buttons.set(name, button);
      row.append(button);
    });
    this.press(names[0]!);
  }
  press(name: T): void {
    for (const [n, b] of this.buttons) b.setAttribute("aria-pressed", String(n === name));
    // On a phone the row scrolls: what a key picked must be in sight.
    this.buttons.get(name)?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }
}
