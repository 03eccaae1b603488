// What acts on the whole face: the face it begins with, a pinned face it goes toward, caricature, exaggeration, chance.
import type { Face, SessionEntry, Shape, ShapeInfo } from "../api_types";
import { el } from "../dom";
import { slider } from "../slider";
import { button, choice, section } from "../widgets";
import type { Memory } from "./controls_part";
import { matches, type Editor, type Part } from "./editor";

export interface WholePart extends Part {
  /** The button of a new random face, for the top of the panel. */
  readonly random: HTMLElement;
  /** Faces and drawings that can be begun with, and faces to go toward. */
  offer(faces: readonly Pick<Face, "id" | "name">[], sessions: readonly SessionEntry[]): void;
}

export interface Random {
  seed: number;
  spread: number;
}

export function wholePart(info: ShapeInfo, editor: Editor, folded: Memory, roll: (random: Random) => void): WholePart {
  const base = choice("Begin with", (value) => editor.change({ base: value }, "base", true));
  const toward = choice("Go toward", (value) => {
    const share = editor.document.toward?.share ?? 0.5;
    editor.change({ toward: value ? { face: value, share } : undefined }, "toward", true);
  });
  const share = slider({
    name: "share of the other face",
    label: "Share",
    least: 0,
    greatest: 1,
    change: (value, done) => {
      const other = editor.document.toward;
      if (other) editor.change({ toward: { ...other, share: value } }, "share", done);
    },
  });
  const none = el("p", { class: "p-hint" }, "Pin a face to go toward it.");
  const caricature = slider({
    name: "caricature",
    label: "Caricature",
    least: info.caricature[0],
    greatest: info.caricature[1],
    change: (value, done) => editor.change({ caricature: value }, "caricature", done),
  });
  const exaggeration = slider({
    name: "exaggeration",
    label: "Exaggeration",
    least: info.exaggeration[0],
    greatest: info.exaggeration[1],
    change: (value, done) => editor.change({ exaggeration: value }, "exaggeration", done),
  });
  const ofCaricature = el("p", { class: "p-hint" }, "Enlarges what differs from the average face: a long nose grows longer.");
  const ofExaggeration = el("p", { class: "p-hint" }, "Enlarges what is curved, whoever the face is: deeper folds, rounder forms.");

  const random: Random = { seed: 1, spread: 0.5 };
  const seed = el("input", { type: "number", class: "p-number", min: 0, max: 999999, step: 1, value: random.seed, "aria-label": "seed of the random face" });
  seed.addEventListener("change", () => {
    random.seed = Math.max(0, Math.round(Number.isFinite(seed.valueAsNumber) ? seed.valueAsNumber : 1));
    seed.value = String(random.seed);
    roll(random);
  });
  const spread = slider({
    name: "spread of the random face",
    label: "Spread",
    least: 0,
    greatest: 1.5,
    neutral: 0.5,
    change: (value, done) => {
      random.spread = value;
      if (done) roll(random);
    },
  });
  const next = button("Random face", () => {
    random.seed = Math.floor(Math.random() * 100000);
    seed.value = String(random.seed);
    roll(random);
  }, { icon: "dice" });
  const seedField = el("div", { class: "p-slider" }, el("span", { class: "p-slider-label", "aria-hidden": "true" }, "Seed"), seed);

  const face = section("face", folded.get("face") ?? true, (open) => folded.set("face", open));
  face.body.append(base.element, toward.element, share.element, none, caricature.element, ofCaricature, exaggeration.element, ofExaggeration);
  const chance = section("chance", folded.get("random") ?? false, (open) => folded.set("random", open));
  chance.body.append(spread.element, seedField);
  const element = el("div", {}, face.element, chance.element);

  let offered = 0;
  return {
    element,
    random: next,
    offer: (faces, sessions) => {
      offered = faces.length;
      const { base: chosen, toward: other } = editor.document;
      const choices = [
        { value: "mean", label: "The average face" },
        ...faces.map((each) => ({ value: each.id, label: each.name, group: "Pinned faces" })),
        ...sessions.map((each) => ({ value: each.id, label: each.name, group: "Drawings" })),
      ];
      if (!choices.some((each) => each.value === chosen)) choices.push({ value: chosen, label: "A face that was deleted" });
      base.set(choices, chosen);
      toward.set([{ value: "", label: "No other face" }, ...faces.map((each) => ({ value: each.id, label: each.name }))], other?.face ?? "");
      toward.element.hidden = offered === 0;
      none.hidden = offered > 0;
    },
    show: (document: Shape) => {
      base.select.value = document.base;
      toward.select.value = document.toward?.face ?? "";
      share.element.hidden = document.toward === undefined;
      share.set(document.toward?.share ?? 0);
      caricature.set(document.caricature ?? 0);
      exaggeration.set(document.exaggeration ?? 0);
      const changed = [document.caricature, document.exaggeration, document.toward?.share].filter(Boolean).length;
      face.note(changed ? `${changed} changed` : "");
    },
    search: (words) => {
      const hit = matches("begin with mean drawing pinned go toward share interpolation caricature exaggeration", words);
      const hitChance = matches("random face seed spread chance", words);
      face.element.hidden = !hit;
      chance.element.hidden = !hitChance;
      return hit || hitChance;
    },
  };
}
