// The question whether a new drawing is begun.
import { button, el } from "../dom";

export function askNew(): Promise<boolean> {
  return new Promise((done) => {
    const dialog = el("dialog", { class: "choose", "aria-labelledby": "new-title" });
    const close = (is: boolean) => {
      done(is);
      dialog.close();
      dialog.remove();
    };
    dialog.append(
      el("h2", { id: "new-title" }, "Draw a new face?"),
      el("p", {}, "The lines of this drawing are those of its face now. Lines that you drew before come back by undo. A new drawing leaves this one as it is."),
      button("New drawing", () => close(true), { class: "primary" }),
      button("Stay here", () => close(false)),
    );
    dialog.addEventListener("cancel", () => close(false));
    document.body.append(dialog);
    dialog.showModal();
  });
}
