// A study: a picture and what methods made of it, without their names. The best one is chosen, or each is rated.
import type { Api } from "../api";
import { button, el } from "../dom";
import { PlainPage, setPicture } from "../plain_page";
import { VoteSheet, kMeanings, type Question } from "./vote_sheet";

interface Item {
  number: number;
  results: { views: string[] }[];
}
interface State {
  participant: number;
  done: number;
  total: number;
  kind: "best" | "ratings";
  questions: Question[];
  greatest: number;
  item: Item | null;
  next: Item | null;
}

const kLetters = "ABCDEF";

export class StudyPage {
  readonly page = new PlainPage("Compare");
  private readonly nextButton = button("Next", () => this.next(), { class: "primary" });
  private votes: VoteSheet | null = null;
  private state: State | null = null;
  private shownAt = 0;
  private busy = false;

  constructor(private readonly api: Api) {}

  async start(): Promise<void> {
    this.take(await this.api.get<State>("/api/study"));
  }

  /** A participant begins or continues. */
  private take(state: State): void {
    this.state = state;
    this.showProgress();
    if (!state.item) {
      this.thank(state);
      return;
    }
    const task = state.kind === "best"
      ? ["You will see pictures, and two or more models of each. Choose one of the models:", kMeanings.best]
      : ["You will see pictures, and two or more models of each. Rate every model from 1 (very poor) to 5 (very good):",
        ...state.questions.map((question) => `${titleOf(question)}: ${kMeanings[question]}`)];
    this.page.showCard(`Participant ${state.participant}`, [...task, "Models come in another order each time. No vote is right or wrong, and no limit of time."],
      { label: state.done === 0 ? "Begin" : "Continue", run: () => void this.showItem().catch((error) => this.page.fail(error)) });
  }
  private thank(state: State): void {
    this.page.showCard("Thank you", [`Participant ${state.participant} has voted on all ${state.total}. You can close this page.`],
      { label: "Next participant", run: () => {
        this.api.post<State>("/api/study/participants").then((next) => this.take(next), (error) => this.page.fail(error));
      } });
  }
  private showProgress(): void {
    if (!this.state) return;
    const { done, total, item } = this.state;
    this.page.progress(done, total, item ? `${done + 1} of ${total}` : `${done} of ${total}`);
  }
  private async showItem(): Promise<void> {
    const state = this.state;
    const item = state?.item;
    if (!state || !item) return;
    const waiting: Promise<void>[] = [];
    const picture = (path: string, alt: string): HTMLImageElement => {
      const image = el("img", { alt });
      waiting.push(setPicture(image, this.picture(item, path)));
      return image;
    };
    const votes = new VoteSheet(state.kind, state.questions, item.results.length, state.greatest, () => this.changed());
    const columns = item.results.map((result, index) => {
      const letter = kLetters[index] ?? String(index + 1);
      return el("section", { class: "study-result", "aria-label": `Model ${letter}` }, el("h2", {}, letter),
        el("div", { class: "study-pictures" }, ...result.views.map((view) => picture(`results/${index + 1}/${view}`, `Model ${letter}, ${view}`))),
        votes.elementAt(index + 1, letter));
    });
    const layout = el("div", { class: "study" },
      el("section", { class: "study-source", "aria-label": "Picture" }, el("h2", {}, "Picture"), picture("source", "The picture")),
      el("div", { class: "study-results" }, ...columns),
      el("div", { class: "study-actions" },
        el("p", {}, state.kind === "best" ? kMeanings.best : "1 = very poor, 5 = very good"), this.nextButton));
    await Promise.all(waiting);
    this.votes = votes;
    this.showProgress();
    this.page.show(layout);
    this.shownAt = performance.now();
    this.changed();
    // The server draws the next item while a person looks at this one.
    const next = state.next;
    next?.results.forEach(({ views }, index) => {
      for (const view of views) this.picture(next, `results/${index + 1}/${view}`).catch(() => undefined);
    });
  }
  private picture(item: Item, path: string): Promise<Blob> {
    return this.api.blob(`/api/study/items/${item.number}/${path}`);
  }
  private changed(): void {
    this.nextButton.disabled = this.busy || !this.votes?.complete;
  }
  private next(): void {
    const item = this.state?.item;
    if (this.busy || !item || !this.votes?.complete) return;
    this.setBusy(true);
    const body = { item: item.number, seconds: Math.round(performance.now() - this.shownAt) / 1000, votes: this.votes.list };
    this.api.post<State>("/api/study/votes", body).then(async (state) => {
      this.state = state;
      if (state.item) await this.showItem();
      else this.take(state);
    }).catch((error) => this.page.fail(error)).finally(() => this.setBusy(false));
  }
  /** What was voted on stays until the next item is there, and takes no more votes. */
  private setBusy(busy: boolean): void {
    this.busy = busy;
    const shown = this.page.element.querySelector<HTMLElement>(".study");
    if (shown) shown.inert = busy;
    this.changed();
  }
}

function titleOf(question: Question): string {
  return question.charAt(0).toUpperCase() + question.slice(1);
}
