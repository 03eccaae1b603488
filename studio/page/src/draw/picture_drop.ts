// What a dropped picture is for: to draw after it, a drawing to read, or a portrait.
import { button, el } from "../dom";
import type { Studio } from "../tab";
import type { ReferencePicture } from "./reference_picture";
import type { SessionDesk } from "./session_desk";

type PictureUse = "under" | "drawing" | "portrait";

/** The choice of a person; null: the question was closed. */
function choosePictureUse(name: string, looksLike: "portrait" | "drawing" | null): Promise<PictureUse | null> {
  return new Promise((done) => {
    const dialog = el("dialog", { class: "choose", "aria-labelledby": "choose-title" });
    const choose = (use: PictureUse | null) => {
      dialog.close();
      dialog.remove();
      done(use);
    };
    const choice = (use: PictureUse, title: string, about: string) =>
      el(
        "button",
        {
          type: "button",
          class: "choose-use",
          autofocus: use === (looksLike ?? "under"),
          onclick: () => choose(use),
        },
        el("b", {}, title),
        el("span", {}, about),
      );
    dialog.append(
      el("h2", { id: "choose-title" }, `What is ${name}?`),
      choice("under", "A picture to draw after", "It lies under the paper, as faint as you like."),
      choice("drawing", "A drawing of a face", "Its lines become a 3-D face in the tray."),
      choice("portrait", "A portrait", "It becomes a textured head in the tab Avatar."),
      button("Cancel", () => choose(null)),
    );
    dialog.addEventListener("cancel", (event) => {
      event.preventDefault();
      choose(null);
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}

/** Takes a file that was dropped on the tab Draw; false: another tab may take it. */
export async function takePicture(file: File, studio: Studio, desk: SessionDesk, reference: ReferencePicture): Promise<boolean> {
  if (!file.type.startsWith("image/")) return false;
  const use = await choosePictureUse(file.name, file.type === "image/svg+xml" ? "drawing" : null);
  if (use === "portrait") {
    // The tab Avatar takes the file next.
    studio.open("avatar");
    return false;
  }
  if (use === "drawing") await desk.readDrawing(file);
  if (use === "under") {
    if (!desk.hasDrawing) await desk.create({ begin: "blank", name: file.name });
    await reference.read(file);
    studio.say("The picture lies under the paper. “Options”, below the mirror, changes how strong it is.");
  }
  return true;
}
