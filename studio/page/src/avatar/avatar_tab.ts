// The tab Avatar: a portrait or a drawing becomes a head with expressions, which is played in the 3-D view.
import type { Job, Point, ShapeInfo } from "../api_types";
import { el } from "../dom";
import { JobCard } from "../job_card";
import type { Studio, Tab } from "../tab";
import { button, section } from "../widgets";
import { optionsPart } from "./options_part";
import { PicturePart } from "./picture_part";
import { ResultPart } from "./result_part";
import { kPictures, startView } from "./start_view";
import {
  avatarBody,
  avatarKey,
  isPortrait,
  kWantedKey,
  kAvatarHeadsKey,
  kAvatarKey,
  kAvatarSubjectKey,
  kFirstOptions,
  kMostHeads,
  kNoPinOfAvatar,
  type AvatarSource,
  type AvatarState,
} from "./state";

export function createAvatarTab(studio: Studio): Tab {
  return new AvatarTab(studio);
}

class AvatarTab implements Tab {
  readonly id = "avatar";
  readonly title = "Avatar";
  readonly element = el("div", { class: "p-panel p-avatar" });
  private state: AvatarState | null;
  private readonly picture: PicturePart;
  private readonly pictureSection = section("picture", true);
  private readonly landmarksJob: JobCard;
  private readonly avatarJob: JobCard;
  private readonly make: HTMLButtonElement;
  private readonly result: ResultPart;
  private info: ShapeInfo | null = null;
  /** The network found no face, and a person has placed no points. */
  private noFace = false;
  private shown = false;
  private restored = false;

  constructor(private readonly studio: Studio) {
    this.state = studio.recall<AvatarState | null>(kAvatarKey, null);
    this.picture = new PicturePart(studio, (points) => this.setLandmarks(points));
    this.landmarksJob = new JobCard(studio.api, false);
    this.avatarJob = new JobCard(studio.api);
    this.result = new ResultPart(studio, () => {
      this.markLast();
      if (this.state) studio.remember(kWantedKey, avatarKey(this.state));
      studio.open("take-away");
    });
    this.pictureSection.body.append(this.landmarksJob.element, this.picture.element);
    this.make = button("Make the head", () => this.run(this.makeHead()), { kind: "primary" });
  }

  async show(): Promise<void> {
    this.shown = true;
    this.info ??= await this.studio.api.shapeInfo();
    if (!this.restored) {
      this.restored = true;
      await this.restore();
    } else if (!this.state) {
      await this.showStart();
    }
    if (this.shown) await this.result.show();
  }
  hide(): void {
    this.shown = false;
    this.result.hide();
  }
  undo(): void {
    this.picture.undo();
  }
  redo(): void {
    this.picture.redo();
  }
  canUndo(): boolean {
    return this.picture.canUndo;
  }
  canRedo(): boolean {
    return this.picture.canRedo;
  }

  whyNoPin(): string | null {
    return kNoPinOfAvatar;
  }

  async drop(file: File): Promise<boolean> {
    const isClip = /\.(csv|jsonl)$/i.test(file.name) || (/\.json$/i.test(file.name) && /lendshape|categoryName|jawOpen/.test(await file.text()));
    if (isClip) {
      if (!this.shown) this.studio.open("avatar");
      if (!this.result.openClip(file)) this.studio.say("Make a head first, then drop the recording to play it.", "warning");
      return true;
    }
    if (!/^image\//.test(file.type) && !kPictures.split(",").some((end) => file.name.toLowerCase().endsWith(end))) return false;
    if (!this.shown) this.studio.open("avatar");
    await this.takeFile(file);
    return true;
  }

  private run(work: Promise<void>): void {
    work.catch((error) => this.studio.fail(error));
  }

  // The beginning: a file or a drawing.

  private async showStart(): Promise<void> {
    const before = this.state;
    const view = await this.makeStart();
    // A file may have been dropped meanwhile.
    if (this.state !== before) return;
    this.element.replaceChildren(view);
    if (this.shown && !before) await this.result.show();
  }
  /** While a picture is worked on, it stays until another one is chosen. */
  private makeStart(): Promise<HTMLElement> {
    const { state } = this;
    const back = state && { title: state.source.name, act: () => this.run(this.showWork(undefined, true)) };
    return startView(this.studio, (file) => this.run(this.takeFile(file)), (source) => this.run(this.takeSource(source)), back);
  }

  private async takeFile(file: File): Promise<void> {
    this.restored = true;
    this.cancelJobs();
    this.element.replaceChildren(el("p", { class: "p-state", role: "status" }, `Loading ${file.name} …`));
    try {
      const upload = await this.studio.api.upload(file, file.name);
      if (upload.kind !== "picture" && upload.kind !== "drawing") throw new Error(`${file.name} is no picture and no drawing.`);
      const as = upload.kind === "drawing" || upload.looks_like === "drawing" ? "drawing" : "portrait";
      await this.takeSource({ kind: "upload", id: upload.id, name: upload.name, as }, file);
    } catch (error) {
      // What was shown before is shown again.
      if (this.state) await this.showWork();
      else await this.showStart();
      throw error;
    }
  }

  private async takeSource(source: AvatarSource, bytes?: Blob): Promise<void> {
    const before = this.state;
    if (before) this.keepHead(before);
    this.state = { source, options: { ...kFirstOptions, ...before?.options }, found: null, landmarks: null, job: null, made: null };
    try {
      await this.showWork(bytes);
    } catch (error) {
      this.state = before;
      throw error;
    }
    this.result.forget();
    this.pictureSection.element.open = true;
    if (this.shown) await this.result.show();
    this.keep();
    await this.findLandmarks();
  }

  private async findLandmarks(): Promise<void> {
    const { state } = this;
    if (!state || !isPortrait(state.source) || state.source.kind !== "upload" || state.landmarks) return;
    const job = await this.landmarksJob.run({ do: "landmarks", upload: state.source.id }, "Looking for the face");
    if (state !== this.state || state.landmarks || !isPortrait(state.source)) return;
    const points = job?.result?.["landmarks"];
    if (Array.isArray(points)) {
      state.found = state.landmarks = points as Point[];
      this.picture.setLandmarks(state.found, state.landmarks);
    } else {
      this.noFace = true;
      this.picture.offerByHand();
    }
    this.keep();
  }

  // The work: picture, options, the head.

  /** `again`: the picture that was worked on, with what is known of it. */
  private async showWork(bytes?: Blob, again = false): Promise<void> {
    const { state } = this;
    if (!state) return;
    const { source } = state;
    if (!again) {
      this.noFace = false;
      this.cancelJobs();
    }
    if (again) {
      // The part of the picture keeps its points and their undo.
    } else if (source.kind === "session") {
      this.picture.setDrawing(await this.studio.api.session(source.id));
    } else {
      await this.picture.setPicture(source.name, bytes ?? (await this.studio.api.blob(`/api/uploads/${source.id}`)));
      if (isPortrait(source)) this.picture.setLandmarks(state.found, state.landmarks);
    }
    const readAgain = async () => {
      this.keep();
      await this.showWork(bytes);
      await this.findLandmarks();
    };
    const options = optionsPart(state, () => this.keep(), () => this.run(readAgain()));
    const other = button("Another picture", () => this.run(this.showStart()), { kind: "quiet" });
    const heading = el("div", { class: "p-row p-spread p-heading" }, el("h2", { title: source.name }, source.name), other);
    const make = el("div", { class: "p-make" }, this.make);
    this.element.replaceChildren(
      el("div", { class: "p-scroll" }, heading, options, this.pictureSection.element, this.avatarJob.element, this.result.element),
      make,
    );
    this.showMake();
  }

  private cancelJobs(): void {
    this.landmarksJob.cancel();
    this.avatarJob.cancel();
  }
  private setLandmarks(points: Point[]): void {
    if (!this.state) return;
    this.state.landmarks = points.length ? points : null;
    this.keep();
  }
  private keep(): void {
    this.studio.remember(kAvatarKey, this.state);
    this.showMake();
  }
  /** A head that was made can be taken away after another picture was chosen. */
  private keepHead(state: AvatarState): void {
    if (!state.job) return;
    const others = this.studio.recall<AvatarState[]>(kAvatarHeadsKey, []).filter((each) => each.job !== state.job);
    this.studio.remember(kAvatarHeadsKey, [state, ...others].slice(0, kMostHeads));
  }
  /** Take away begins with this head until a person works on another face. */
  private markLast(): void {
    this.studio.remember(kAvatarSubjectKey, JSON.stringify(this.studio.subject));
  }

  private showMake(): void {
    const { state, make } = this;
    if (!state) return;
    const body = avatarBody(state);
    const isMade = state.made === JSON.stringify(body);
    const before = state.made === null ? null : (JSON.parse(state.made) as { landmarks?: Point[] });
    const moved = before !== null && JSON.stringify(body.landmarks) !== JSON.stringify(before.landmarks);
    make.replaceChildren(before === null ? "Make the head" : moved ? "Refit the head" : isMade ? "Make the head again" : "Make it with these choices");
    make.classList.toggle("p-primary", !isMade);
    make.classList.toggle("p-plain", isMade);
    make.disabled = this.avatarJob.isBusy || (this.noFace && !state.landmarks);
  }

  private async makeHead(): Promise<void> {
    const { state } = this;
    if (!state || !this.info || this.avatarJob.isBusy) return;
    // The job finds the landmarks itself: their search need not end first.
    this.landmarksJob.cancel();
    const body = avatarBody(state);
    const work = this.avatarJob.run(body, state.job ? "Making the head again" : "Making the head");
    this.showMake();
    this.avatarJob.element.scrollIntoView({ block: "nearest" });
    const job = await work;
    if (state !== this.state) return;
    if (job) {
      // The first head of a picture is seen as the picture shows it; later ones stay as they were turned.
      if (state.job === null && this.shown) this.studio.viewer.lookFrom("front");
      state.job = job.id;
      state.made = JSON.stringify(body);
      this.markLast();
      this.keep();
      await this.takeJob(job, this.info);
      if (this.shown) await this.result.show();
      await this.findLandmarks();
    }
    this.keep();
  }
  private async takeJob(job: Job, info: ShapeInfo): Promise<void> {
    await this.result.takeJob(job, info);
    // The picture makes room for what can be played.
    this.pictureSection.element.open = false;
  }

  /** Shows what an earlier page worked on, where the server still has it. */
  private async restore(): Promise<void> {
    if (!this.state) {
      await this.showStart();
      return;
    }
    this.element.replaceChildren(el("p", { class: "p-state", role: "status" }, "Loading the last picture …"));
    try {
      await this.showWork();
    } catch {
      this.state = null;
      this.keep();
      await this.showStart();
      return;
    }
    const { state } = this;
    if (state.job && this.info) {
      try {
        await this.takeJob(await this.studio.api.get<Job>(`/api/jobs/${state.job}`), this.info);
      } catch {
        // Jobs end with the server that ran them.
        state.job = state.made = null;
        this.keep();
      }
    }
    this.run(this.findLandmarks());
  }
}
