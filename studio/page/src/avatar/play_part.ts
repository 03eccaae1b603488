// Playing a head: presets, motions, sliders, a clip of a file, a live stream.
import type { ShapeInfo } from "../api_types";
import { el } from "../dom";
import { expressionRows, expressionTitle, kPresets, type ExpressionRow, type Weights } from "../expressions";
import { fileButton } from "../file_choice";
import { sidesSlider, slider } from "../slider";
import type { Studio } from "../tab";
import type { RiggedHead } from "../viewer";
import { button, section, toggle } from "../widgets";
import { clipSeconds, parseClip, weightsAt, type Clip } from "./clip";
import { LiveStream } from "./live_stream";
import { kMotions } from "./motions";
import { Player } from "./player";

const kFew = ["jawOpen", "mouthSmileLeft", "eyeBlinkLeft", "browInnerUp"];

/** The expression that the head has, over a reload. */
export const kPoseKey = "avatar.pose";

interface Row {
  names: ExpressionRow["names"];
  element: HTMLElement;
  /** `passing`: the weights are those of a moment of a clip. */
  show(weights: Weights, passing?: boolean): void;
}

export class PlayPart {
  readonly element = el("div", { class: "p-play" });
  private readonly live: LiveStream;
  private player: Player | null = null;
  private weights: Weights = {};
  private readonly chips = new Map<string, HTMLButtonElement>();
  private readonly stopChip = button("Stop", () => this.pose(this.weights), { kind: "quiet", icon: "pause" });
  private rows: Row[] = [];
  private few: Row[] = [];
  private clip: Clip | null = null;
  private at = 0;
  private readonly clipBox = el("div", { class: "p-clip", hidden: true });
  private readonly liveWords = el("p", { class: "p-hint", role: "status" });
  private listen = toggle("Listen to a live stream", false, (on) => this.setLive(on));
  private showPlaying: (seconds: number | null) => void = () => {};

  constructor(private readonly studio: Studio, private readonly info: ShapeInfo) {
    this.live = new LiveStream(studio.api);
  }

  setHead(rig: RiggedHead): void {
    this.stop();
    this.player = new Player(this.studio.viewer, rig);
    const known = this.player.known(this.info.expressions);
    this.rows = expressionRows(known).map((row) => this.row(row));
    this.few = this.rows.filter((row) => kFew.includes(row.names[0]));
    const groups = Object.entries(this.info.expression_groups).map(([group, names]) => {
      const own = this.rows.filter((row) => names.includes(row.names[0]) && !this.few.includes(row));
      if (own.length === 0) return null;
      const part = section(group, false);
      part.element.classList.add("p-inner");
      part.body.append(...own.map((row) => row.element));
      return part.element;
    });
    const all = section("All expressions", false);
    all.body.append(...groups.filter((group) => group !== null));
    const chips = el(
      "div",
      { class: "p-chips", role: "group", "aria-label": "Expressions to play" },
      this.chip("Neutral", () => this.pose({})),
      ...kPresets.map((preset) => this.chip(preset.name, () => this.pose(preset.weights))),
      ...kMotions.map((motion) => this.chip(motion.name, () => this.playOnce(motion), "play")),
      this.stopChip,
    );
    const file = fileButton("Play a recording", ".csv,.json,.jsonl,.txt", (chosen) => void this.openClip(chosen), {
      title: "A CSV of Live Link Face or a JSON file of MediaPipe",
    });
    this.element.replaceChildren(chips, ...this.few.map((row) => row.element), all.element, el("div", { class: "p-row" }, file, this.listen.element), this.clipBox, this.liveWords, this.howToPost());
    this.pose(this.studio.recall<Weights>(kPoseKey, {}));
  }
  private chip(name: string, act: () => void, icon?: "play"): HTMLButtonElement {
    const made = button(name, act, { kind: "quiet", ...(icon ? { icon } : {}) });
    this.chips.set(name, made);
    return made;
  }
  /** The chip of what the head shows: a motion that runs, else the expression that it has. */
  private markChips(motion: string | null): void {
    const posed = kPresets.find((preset) => JSON.stringify(preset.weights) === JSON.stringify(this.weights))?.name;
    const shown = motion ?? posed ?? (Object.values(this.weights).some(Boolean) ? null : "Neutral");
    for (const [name, each] of this.chips) each.setAttribute("aria-pressed", String(name === shown));
    this.stopChip.hidden = motion === null;
  }

  /** Reads a recording and plays it. */
  async openClip(file: File): Promise<void> {
    try {
      const clip = parseClip(file.name, await file.text(), this.info.expressions);
      this.setLive(false);
      this.clip = clip;
      this.showClip(file.name, clip);
      this.playClip(0);
    } catch (error) {
      this.clip = null;
      this.player?.stop();
      const message = error instanceof Error ? error.message : String(error);
      this.clipBox.hidden = false;
      this.clipBox.replaceChildren(el("p", { class: "p-error", role: "alert" }, message));
    }
  }

  stop(): void {
    this.player?.stop();
    this.setLive(false);
    this.showPlaying(null);
    this.markChips(null);
  }

  private row(row: ExpressionRow): Row {
    const [first, second] = row.names;
    const label = row.title.charAt(0).toUpperCase() + row.title.slice(1);
    const change = (values: Weights) => this.pose({ ...this.weights, ...values });
    if (second === undefined) {
      const one = slider({ name: expressionTitle(first), label, least: 0, greatest: 1, change: (value) => change({ [first]: value }) });
      return { names: row.names, element: one.element, show: (weights) => one.set(weights[first] ?? 0) };
    }
    const both = sidesSlider({
      name: row.title,
      label,
      least: 0,
      greatest: 1,
      linked: true,
      onLink: () => {},
      change: ({ left, right }) => change({ [first]: left, [second]: right }),
    });
    return { names: row.names, element: both.element, show: (weights, passing) => both.set({ left: weights[first] ?? 0, right: weights[second] ?? 0 }, passing) };
  }

  private pose(weights: Weights): void {
    this.player?.stop();
    this.setLive(false);
    this.showPlaying(null);
    this.weights = weights;
    for (const row of this.rows) row.show(weights);
    this.player?.set(weights);
    this.studio.remember(kPoseKey, weights);
    this.markChips(null);
  }
  /** The head returns to its expression at the end. */
  private playOnce({ name, clip }: { name: string; clip: Clip }): void {
    const { weights } = this;
    this.pose(weights);
    this.markChips(name);
    this.player?.play(clip, 0, (seconds) => {
      if (seconds === null) this.pose(weights);
    });
  }

  private playClip(from: number): void {
    if (!this.clip) return;
    this.player?.play(this.clip, from, (seconds, weights) => {
      this.at = seconds ?? 0;
      for (const row of this.few) row.show(weights, true);
      this.showPlaying(seconds);
    });
    this.showPlaying(from);
  }
  private showClip(name: string, clip: Clip): void {
    const length = clipSeconds(clip);
    let playing = false;
    const press = button("Play", () => {
      if (!playing) {
        this.setLive(false);
        this.playClip(this.at >= length ? 0 : this.at);
        return;
      }
      this.player?.stop();
      this.showPlaying(null);
    });
    const time = slider({
      name: "time of the recording, seconds",
      label: "Time",
      least: 0,
      greatest: Math.max(0.01, length),
      unit: "s",
      change: (seconds) => {
        this.player?.stop();
        this.showPlaying(null);
        this.at = seconds;
        this.player?.set(weightsAt(clip, seconds));
      },
    });
    this.showPlaying = (seconds) => {
      playing = seconds !== null;
      press.replaceChildren(playing ? "Pause" : "Play");
      if (playing) time.set(this.at);
    };
    const frames = `${clip.kind}: ${clip.frames.length} ${clip.frames.length === 1 ? "frame" : "frames"}, ${length.toFixed(length < 1 ? 2 : 1)} s.`;
    this.clipBox.hidden = false;
    this.clipBox.replaceChildren(
      el("p", { class: "p-clip-name" }, name),
      el("p", { class: "p-hint" }, [frames, ...clip.notes].join(" ")),
      el("div", { class: "p-row p-clip-row" }, press, time.element),
    );
  }

  private setLive(on: boolean): void {
    if (on === this.live.isOn) return;
    this.listen.set(on);
    if (!on) {
      this.live.stop();
      this.liveWords.replaceChildren();
      return;
    }
    this.player?.stop();
    this.showPlaying(null);
    this.liveWords.replaceChildren("Waiting for frames.");
    let words = "";
    this.live.start(
      (weights) => {
        const now = weights ? "Frames arrive." : "Waiting for frames.";
        if (now !== words) this.liveWords.replaceChildren(now);
        words = now;
        if (!weights) return;
        this.player?.set(weights);
        for (const row of this.few) row.show(weights, true);
      },
      (error) => {
        this.listen.set(false);
        this.liveWords.replaceChildren();
        this.studio.fail(error);
      },
    );
  }

  private howToPost(): HTMLElement {
    return el(
      "details",
      { class: "p-how" },
      el("summary", {}, "How a program sends a live stream"),
      el("p", { class: "p-hint" }, "It posts each frame to this address, with the token of the address that the program printed:"),
      el("pre", { tabindex: 0 }, `POST ${location.origin}/api/drive\nAuthorization: Bearer TOKEN\nContent-Type: application/json\n\n{"weights": {"jawOpen": 0.4}}`),
      el("p", { class: "p-hint" }, "Results of MediaPipe's FaceLandmarker are read as they are."),
    );
  }
}
