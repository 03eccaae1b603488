// The tab Take away: what is taken, and a card for each format that it can become.
import type { SessionEntry, Shape } from "../api_types";
import { avatarKey, kWantedKey, kAvatarHeadsKey, kAvatarKey, kAvatarSubjectKey, kNoPinOfAvatar, type AvatarState } from "../avatar/state";
import { el } from "../dom";
import type { HistoryState } from "../history";
import type { Studio, Tab } from "../tab";
import { button, choice } from "../widgets";
import { FormatCard } from "./format_card";
import { kFormats } from "./formats";
import { targetKey, type FormatId, type Target } from "./targets";

export function createTakeAwayTab(studio: Studio): Tab {
  return new TakeAwayTab(studio);
}

class TakeAwayTab implements Tab {
  readonly id = "take-away";
  readonly title = "Take away";
  readonly useFaceLabel = "Take away";
  readonly element: HTMLElement;
  private readonly what = choice("Take away:", (key) => this.choose(key));
  private readonly other = el("div", { class: "p-row", hidden: true });
  private readonly cards: FormatCard[];
  private readonly empty: HTMLElement;
  private readonly grid: HTMLElement;
  private targets: Target[] = [];
  private chosen: Target | null = null;
  private sessions: SessionEntry[] = [];
  /** Newest first. */
  private avatars: AvatarState[] = [];
  /** What a person chose here; null: nothing yet. */
  private wanted: string | null = null;
  private shown = false;

  constructor(private readonly studio: Studio) {
    this.cards = kFormats.map((format) => new FormatCard(studio, format));
    // Two columns of their own: a card that grows moves no card of the other column.
    const column = (ids: readonly FormatId[]) =>
      el("div", { class: "p-column" }, ...this.cards.filter((card) => ids.includes(card.id)).map((card) => card.element));
    this.grid = el("div", { class: "p-cards" }, column(["glb", "obj", "session"]), column(["vrm", "stl", "turntable"]));
    this.empty = el(
      "div",
      { class: "p-state", hidden: true },
      el("p", {}, "There is no face yet. Draw one, or make one from a portrait."),
      el("div", { class: "p-row" }, button("Draw a face", () => studio.open("draw"), { kind: "primary" }), button("Use a portrait", () => studio.open("avatar"))),
    );
    this.element = el(
      "div",
      { class: "p-panel p-take-away" },
      el("div", { class: "p-scroll" }, el("div", { class: "p-what" }, el("h2", { class: "visually-hidden" }, "Take away"), this.what.element, this.other), this.empty, this.grid),
    );
    studio.faces.onChange(() => this.shown && this.offer());
  }

  async show(): Promise<void> {
    this.shown = true;
    [this.sessions, this.avatars] = await Promise.all([this.studio.api.sessions(), this.madeHeads()]);
    if (!this.shown) return;
    this.targets = this.allTargets();
    this.chosen = this.firstTarget();
    this.offer();
    // After a reload nothing is worked on yet: what is shown is.
    if (!this.studio.subject) this.takeSubject();
    await this.preview();
  }
  hide(): void {
    this.shown = false;
  }
  /** What is shown cannot be pinned. */
  whyNoPin(): string | null {
    return this.chosen?.kind === "avatar" ? kNoPinOfAvatar : null;
  }
  async useFace(face: { id: string }): Promise<void> {
    this.choose(face.id);
  }

  /** The heads that Avatar made, where the server still has their files: jobs end with the server that ran them. */
  private async madeHeads(): Promise<AvatarState[]> {
    const last = this.studio.recall<AvatarState | null>(kAvatarKey, null);
    const earlier = this.studio.recall<AvatarState[]>(kAvatarHeadsKey, []);
    const made = [...(last?.job ? [last] : []), ...earlier.filter((each) => each.job !== last?.job)];
    const isKept = await Promise.all(made.map((each) => this.studio.api.get(`/api/jobs/${each.job}`).then(() => true, () => false)));
    return made.filter((_, index) => isKept[index]);
  }
  private allTargets(): Target[] {
    const shape = this.studio.recall<HistoryState<Shape> | null>("shape.history", null);
    return [
      ...this.sessions.map((session): Target => ({ kind: "session", id: session.id, title: session.name, changed: session.changed })),
      ...(shape ? [{ kind: "shape", shape: shape.present, title: "The shape" } as const] : []),
      ...this.avatars.map((state): Target => ({ kind: "avatar", state, title: state.source.name })),
      ...this.studio.faces.faces.map((face): Target => ({ kind: "face", id: face.id, title: face.name })),
    ];
  }
  /** What a person chose here, then what was worked on last, where it is still there. */
  private firstTarget(): Target | null {
    const next = this.studio.recall(kWantedKey, "");
    if (next !== "") {
      this.wanted = next;
      this.studio.remember("take-away.target", next);
    }
    this.studio.remember(kWantedKey, "");
    const byHand = this.wanted ?? (this.studio.subject ? null : this.studio.recall("take-away.target", ""));
    return this.find(byHand) ?? this.find(this.lastKey()) ?? this.targets[0] ?? null;
  }
  private find(key: string | null): Target | null {
    return this.targets.find((target) => targetKey(target) === key) ?? null;
  }
  /** What a person worked on last. */
  private lastKey(): string | null {
    return this.isAvatarLast() && this.avatars[0] ? avatarKey(this.avatars[0]) : this.subjectKey();
  }
  private isAvatarLast(): boolean {
    return this.studio.recall(kAvatarSubjectKey, "") === JSON.stringify(this.studio.subject);
  }
  private subjectKey(): string | null {
    const body = this.studio.subject?.body;
    // After a reload: the drawing that is open in Draw.
    if (!body) return this.studio.recall("session", "");
    return "session" in body ? body.session : "face" in body ? body.face : "shape";
  }

  private offer(): void {
    this.targets = this.allTargets();
    const groups = { session: "Drawings", face: "Pinned faces", shape: "Shape", avatar: "Avatar" };
    this.what.set(
      this.targets.map((target) => ({ value: targetKey(target), label: target.title, group: groups[target.kind] })),
      this.chosen ? targetKey(this.chosen) : "",
    );
    const nothing = this.targets.length === 0;
    this.what.element.hidden = nothing;
    this.grid.hidden = nothing;
    this.empty.hidden = !nothing;
    for (const card of this.cards) card.setTarget(this.chosen);
    this.offerLast();
  }
  /** The choice stays while a person works on something else, which is offered. */
  private offerLast(): void {
    const last = this.find(this.lastKey());
    const isOther = this.chosen !== null && last !== null && targetKey(last) !== targetKey(this.chosen);
    this.other.hidden = !isOther || (this.chosen?.kind === "avatar" && this.isAvatarLast());
    if (last) this.other.replaceChildren(el("span", { class: "p-hint" }, "You worked on something else since:"), button(`Take “${last.title}”`, () => this.choose(targetKey(last))));
  }
  private choose(key: string): void {
    this.chosen = this.targets.find((target) => targetKey(target) === key) ?? null;
    this.wanted = key;
    this.studio.remember("take-away.target", key);
    this.takeSubject();
    this.offer();
    this.preview().catch((error) => this.studio.fail(error));
  }

  /** What is chosen here is what a person works on: the tray pins it. */
  private takeSubject(): void {
    const target = this.chosen;
    if (target?.kind === "avatar") this.studio.remember(kAvatarSubjectKey, JSON.stringify(this.studio.subject));
    this.studio.refresh();
    if (!target || target.kind === "avatar") return;
    this.studio.remember(kAvatarSubjectKey, "");
    const body = target.kind === "shape" ? { shape: target.shape } : target.kind === "session" ? { session: target.id } : { face: target.id };
    this.studio.subject = { kind: target.kind, title: target.title, body };
    this.studio.refresh();
  }

  /** The 3-D view shows what is taken. */
  private async preview(): Promise<void> {
    const { api, viewer } = this.studio;
    const target = this.chosen;
    if (!target) {
      viewer.clear("There is no face yet.");
      return;
    }
    if (target.kind === "avatar") {
      const job = target.state.job ?? "";
      const bytes = await (await api.jobFile(job, "head.glb")).arrayBuffer();
      if (this.shown && this.chosen === target) await viewer.loadGlb(bytes);
      return;
    }
    const vertices =
      target.kind === "shape"
        ? await api.shapeVertices(target.shape)
        : target.kind === "face"
          ? await api.faceVertices(target.id)
          : await api.session(target.id).then((state) => api.sessionVertices(target.id, state.revision));
    if (!this.shown || this.chosen !== target) return;
    if (vertices) viewer.setVertices(vertices);
    else viewer.clear("This drawing has no face yet. Draw its outline and its eyes first.");
  }
}
