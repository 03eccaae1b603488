// The choices of an avatar: how the picture is read, style, caricature, hair.
import { el } from "../dom";
import { hairChoice } from "../head_options";
import { slider } from "../slider";
import { segments } from "../widgets";
import { isPortrait, type AvatarState } from "./state";

/** Writes into the state, then calls `changed`; `readAs` where the picture is to be read otherwise. */
export function optionsPart(state: AvatarState, changed: () => void, readAs: () => void): HTMLElement {
  const { source, options } = state;
  const portrait = isPortrait(source);
  const kinds = [{ value: "portrait", label: "Portrait" }, { value: "drawing", label: "Line drawing" }] as const;
  const kind =
    source.kind === "upload" &&
    segments("Read as", kinds, source.as, (as) => {
      source.as = as;
      readAs();
    });
  const styles = [{ value: "none", label: "As it is" }, { value: "toon", label: "Toon" }] as const;
  const style = segments("Style", styles, options.style, (value) => {
    options.style = value;
    changed();
  });
  const caricature = slider({
    name: "caricature",
    label: "Caricature",
    least: 0,
    greatest: 2,
    step: 0.05,
    change: (value) => {
      options.caricature = value;
      changed();
    },
  });
  caricature.set(options.caricature);
  const hair = hairChoice(portrait, options.hair === "auto" && !portrait ? "none" : options.hair, (value) => {
    options.hair = value;
    changed();
  });
  return el("div", { class: "p-options" }, kind && kind.element, portrait && style.element, caricature.element, hair.element);
}
