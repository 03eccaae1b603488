// Light and dark: as the system has it until a person chooses.
import { iconButton } from "./dom";
import { iconOf } from "./icons";
import type { Studio } from "./tab";

export class Theme {
  readonly button: HTMLButtonElement;

  constructor(private readonly studio: Pick<Studio, "remember" | "recall">) {
    this.button = iconButton("moon", "Dark", () => this.flip());
    const chosen = studio.recall<string>("theme", "");
    if (chosen !== "") document.documentElement.dataset["theme"] = chosen;
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.show());
    this.show();
  }
  private get dark(): boolean {
    const chosen = document.documentElement.dataset["theme"];
    return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  }
  private flip(): void {
    const next = this.dark ? "light" : "dark";
    document.documentElement.dataset["theme"] = next;
    this.studio.remember("theme", next);
    this.show();
    document.dispatchEvent(new Event("themechange"));
  }
  private show(): void {
    const label = this.dark ? "Light colours" : "Dark colours";
    this.button.replaceChildren(iconOf(this.dark ? "sun" : "moon"));
    this.button.setAttribute("aria-label", label);
    this.button.title = label;
  }
}
