// A button that opens the system's choice of a file.
import { el } from "./dom";
import { button, type ButtonOptions } from "./widgets";

export function fileButton(label: string, accept: string, take: (file: File) => void, options: ButtonOptions = {}): HTMLButtonElement {
  return button(label, () => {
    const input = el("input", { type: "file", accept });
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) take(file);
    });
    input.click();
  }, { icon: "upload", ...options });
}
