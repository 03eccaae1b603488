// What a dropped picture is for: to draw after it, a drawing to read, or a portrait.
import { button, el } from "../dom";

export type PictureUse = "under" | "drawing" | "portrait";

/** The choice of a person; null: the question was closed. */
export function choosePictureUse(name: string, looksLike: "portrait" | "drawing" | null): Promise<PictureUse | null> {
  return new Promise((done) => {
    const dialog = el("dialog", { class: "choose", "aria-labelledby": "choose-title" });
    const choose = (use: PictureUse | null) => {
      dialog.close();
      dialog.remove();
      done(use);
    };
    const choice = (use: PictureUse, title: string, about: string) => el("button", {
      type: "button", class: "choose-use", autofocus: use === (looksLike ?? "under"), onclick: () => choose(use),
    }, el("b", {}, title), el("span", {}, about));
    dialog.append(
      el("h2", { id: "choose-title" }, `What is ${name}?`),
      choice("under", "A picture to draw after", "It lies under the paper, as faint as you like."),
      choice("drawing", "A drawing of a face", "Its lines become a 3-D face in the tray."),
      choice("portrait", "A portrait", "It becomes a textured head in the tab Avatar."),
      button("Cancel", () => choose(null)));
    dialog.addEventListener("cancel", (event) => {
      event.preventDefault();
      choose(null);
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}
