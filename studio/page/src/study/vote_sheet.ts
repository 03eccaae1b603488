// What a participant says about the results of an item.
import { el } from "../dom";
import { newId } from "../widgets";

export type Question = "best" | "aesthetics" | "accuracy" | "similarity";
export interface Vote {
  place: number;
  question: Question;
  value: number;
}

/** As participants read them [Pan et al. 2024, section 4.2.3; Han et al. 2017, section 6.1]. */
export const kMeanings: Record<Question, string> = {
  best: "Which one looks more natural and is more like the picture?",
  aesthetics: "Is it pleasing to look at?",
  accuracy: "Are the overall shape and the place of each part of the face right?",
  similarity: "Does it look like the picture?",
};

export class VoteSheet {
  private readonly values = new Map<string, Vote>();
  private readonly group = newId("best");

  constructor(private readonly kind: "best" | "ratings", private readonly questions: readonly Question[], private readonly numPlaces: number,
    private readonly greatest: number, private readonly changed: () => void) {}

  get list(): Vote[] {
    return [...this.values.values()];
  }
  get complete(): boolean {
    return this.values.size === (this.kind === "best" ? 1 : this.numPlaces * this.questions.length);
  }
  /** The controls below the result at a place. */
  elementAt(place: number, letter: string): HTMLElement {
    if (this.kind === "best") {
      const input = el("input", { type: "radio", name: this.group, onchange: () => this.set("best", { place, question: "best", value: 1 }) });
      return el("label", { class: "study-pick" }, input, el("span", {}, `Choose ${letter}`));
    }
    return el("div", { class: "study-ratings" }, ...this.questions.map((question) => this.rating(place, letter, question)));
  }

  private rating(place: number, letter: string, question: Question): HTMLElement {
    const name = newId(question);
    const row = el("div", { class: "p-segments-row" });
    for (let value = 1; value <= this.greatest; ++value) {
      const input = el("input", { type: "radio", name, value, "aria-label": `${question} of ${letter}: ${value}`,
        onchange: () => this.set(`${place} ${question}`, { place, question, value }) });
      row.append(el("label", {}, input, el("span", { "aria-hidden": "true" }, String(value))));
    }
    return el("fieldset", { class: "p-segments" }, el("legend", { title: kMeanings[question] }, question), row);
  }
  private set(key: string, vote: Vote): void {
    this.values.set(key, vote);
    this.changed();
  }
}
