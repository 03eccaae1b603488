// The first view of Avatar: where a picture is dropped or chosen, or a drawing used.
import { el } from "../dom";
import { fileButton } from "../file_choice";
import type { Studio } from "../tab";
import { button } from "../widgets";
import type { AvatarSource } from "./state";

export const kPictures = ".png,.jpg,.jpeg,.bmp,.webp,.svg,.gif,.tif,.tiff";

/** `back`: the picture that is worked on, which stays until another one is chosen. */
export async function startView(
  studio: Studio,
  takeFile: (file: File) => void,
  takeSource: (source: AvatarSource) => void,
  back: { title: string; act: () => void } | null,
): Promise<HTMLElement> {
  const [sessions, info] = await Promise.all([studio.api.sessions().catch(() => []), studio.api.info()]);
  // The drawing that is open in Draw.
  const open = studio.recall<string>("session", "");
  const drawing = sessions.find((session) => session.id === open) ?? sessions[0];
  const use = drawing && button(`Use the drawing “${drawing.name}”`, () => takeSource({ kind: "session", id: drawing.id, name: drawing.name }), { icon: "pen" });
  return el(
    "div",
    { class: "p-scroll p-start" },
    back && el("div", { class: "p-row" }, button(`Back to ${back.title}`, back.act, { icon: "undo" })),
    el(
      "div",
      { class: "p-drop" },
      el("h2", {}, "A head from a picture"),
      el("p", {}, "Drop a portrait here: a cartoon, a caricature, a photograph or a line drawing."),
      fileButton("Choose a picture", kPictures, takeFile, { kind: "primary" }),
      use && el("p", { class: "p-or" }, "or"),
      use,
      !info.can.portraits && el("p", { class: "p-hint" }, "The weights of portraits are not installed: line drawings alone can be read."),
    ),
    el(
      "ol",
      { class: "p-steps" },
      el("li", {}, el("b", {}, "Check"), " the points that were found, and move those that are wrong."),
      el("li", {}, el("b", {}, "Make"), " the head: shape, 52 expressions, texture, hair."),
      el("li", {}, el("b", {}, "Play"), " its expressions, a recording or a live stream."),
    ),
  );
}
