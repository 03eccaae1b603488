// The tab Avatar: a portrait or a drawing becomes a head with expressions, which is played in the 3-D view.
import type { Job, Point, ShapeInfo } from "../api_types";
import { el } from "../dom";
import { fileButton } from "../file_choice";
import { hairChoice } from "../head_options";
import { JobCard, warningList } from "../job_card";
import { slider } from "../slider";
import type { Studio, Tab } from "../tab";
import type { RiggedHead } from "../viewer";
import { button, section, segments } from "../widgets";
import { PicturePart } from "./picture_part";
import { PlayPart } from "./play_part";
import { StagesStrip } from "./stages_strip";
import { avatarBody, kAvatarKey, kAvatarSubjectKey, kFirstOptions, type AvatarSource, type AvatarState } from "./state";

const kPictures = ".png,.jpg,.jpeg,.bmp,.webp,.svg,.gif,.tif,.tiff";

export function createAvatarTab(studio: Studio): Tab {
  return new AvatarTab(studio);
}

class AvatarTab implements Tab {
  readonly id = "avatar";
  readonly title = "Avatar";
  readonly element = el("div", { class: "p-panel p-avatar" });
  private state: AvatarState | null;
  private readonly picture: PicturePart;
  private readonly stages: StagesStrip;
  private readonly landmarksJob: JobCard;
  private readonly avatarJob: JobCard;
  private readonly make: HTMLButtonElement;
  private readonly result = el("div", { class: "p-result", hidden: true });
  private readonly pictureSection = section("picture and landmarks", true);
  private play: PlayPart | null = null;
  private info: ShapeInfo | null = null;
  private bytes: ArrayBuffer | null = null;
  private rig: RiggedHead | null = null;
  private shown = false;
  private restored = false;

  constructor(private readonly studio: Studio) {
    this.state = studio.recall<AvatarState | null>(kAvatarKey, null);
    this.picture = new PicturePart(studio, (points) => this.setLandmarks(points));
    this.stages = new StagesStrip(studio.api);
    this.landmarksJob = new JobCard(studio.api);
    this.avatarJob = new JobCard(studio.api);
    this.pictureSection.body.append(this.picture.element, this.landmarksJob.element);
    this.make = button("Make the head", () => void this.makeHead(), { kind: "primary" });
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
    if (this.shown) await this.showHead();
  }
  hide(): void {
    this.shown = false;
    this.play?.stop();
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

  async drop(file: File): Promise<boolean> {
    const isClip = /\.(csv|jsonl)$/i.test(file.name) || (/\.json$/i.test(file.name) && /lendshape|categoryName|jawOpen/.test(await file.text()));
    if (isClip) {
      if (!this.shown) this.studio.open("avatar");
      if (this.play && this.rig) await this.play.openClip(file);
      else this.studio.say("Make a head first, then drop the recording to play it.", "warning");
      return true;
    }
    if (!/^image\//.test(file.type) && !kPictures.split(",").some((end) => file.name.toLowerCase().endsWith(end))) return false;
    if (!this.shown) this.studio.open("avatar");
    await this.takeFile(file);
    return true;
  }

  // The beginning: a file or a drawing.

  private async showStart(): Promise<void> {
    const sessions = await this.studio.api.sessions().catch(() => []);
    const choose = fileButton("Choose a picture", kPictures, (file) => void this.takeFile(file).catch((error) => this.studio.fail(error)), { kind: "primary" });
    const current = this.studio.subject?.body;
    const own = sessions.find((session) => current && "session" in current && current.session === session.id) ?? sessions[0];
    const drawing = own && button(`Use the drawing “${own.name}”`, () => void this.takeSource({ kind: "session", id: own.id, name: own.name }).catch((error) => this.studio.fail(error)), { icon: "pen" });
    const info = await this.studio.api.info();
    const noPortraits = !info.can.portraits && el("p", { class: "p-hint" }, "This program was built without portraits. Drawings work.");
    this.element.replaceChildren(
      el(
        "div",
        { class: "p-scroll p-start" },
        el(
          "div",
          { class: "p-drop" },
          el("h2", {}, "A head from a picture"),
          el("p", {}, "Drop a portrait here: a cartoon, a caricature, a photograph or a line drawing."),
          choose,
          drawing && el("p", { class: "p-or" }, "or"),
          drawing,
          noPortraits,
        ),
        el(
          "ol",
          { class: "p-steps" },
          el("li", {}, el("b", {}, "Check"), " the points that were found, and move those that are wrong."),
          el("li", {}, el("b", {}, "Make"), " the head: shape, 52 expressions, texture, hair."),
          el("li", {}, el("b", {}, "Play"), " its expressions, a recording or a live stream."),
        ),
      ),
    );
    if (this.shown) this.studio.viewer.clear("The head appears here.");
  }

  private async takeFile(file: File): Promise<void> {
    if (this.avatarJob.isBusy || this.landmarksJob.isBusy) this.cancelJobs();
    this.element.replaceChildren(el("p", { class: "p-state", role: "status" }, `Loading ${file.name} …`));
    try {
      const upload = await this.studio.api.upload(file, file.name);
      if (upload.kind !== "picture" && upload.kind !== "drawing") throw new Error(`${file.name} is no picture and no drawing.`);
      const as = upload.kind === "drawing" || upload.looks_like === "drawing" ? "drawing" : "portrait";
      await this.takeSource({ kind: "upload", id: upload.id, name: upload.name, as }, file);
    } catch (error) {
      if (this.state) await this.showWork();
      else await this.showStart();
      throw error;
    }
  }

  private async takeSource(source: AvatarSource, bytes?: Blob): Promise<void> {
    const options = { ...kFirstOptions, ...this.state?.options };
    this.state = { source, options, found: null, landmarks: null, job: null, made: null };
    this.forgetHead();
    this.pictureSection.element.open = true;
    await this.showWork(bytes);
    this.keep();
    await this.findLandmarks();
  }

  private async findLandmarks(): Promise<void> {
    const { state } = this;
    if (!state || state.source.kind !== "upload" || state.source.as !== "portrait" || state.found) return;
    const job = await this.landmarksJob.run({ do: "landmarks", upload: state.source.id }, "Looking for the face");
    const points = job?.result?.["landmarks"];
    if (state !== this.state || !Array.isArray(points)) return;
    state.found = points as Point[];
    state.landmarks = state.found;
    this.picture.setLandmarks(state.found, state.landmarks);
    this.keep();
  }

  // The work: picture, options, the head.

  private async showWork(bytes?: Blob): Promise<void> {
    const { state } = this;
    if (!state) return;
    const { source, options } = state;
    if (source.kind === "session") {
      this.picture.setDrawing(await this.studio.api.session(source.id));
    } else {
      await this.picture.setPicture(source.name, bytes ?? (await this.studio.api.blob(`/api/uploads/${source.id}`)));
      if (source.as === "portrait") this.picture.setLandmarks(state.found, state.landmarks);
    }
    const isPortrait = source.kind === "upload" && source.as === "portrait";
    const readAs =
      source.kind === "upload" &&
      segments("Read as", [{ value: "portrait", label: "Portrait" }, { value: "drawing", label: "Line drawing" }] as const, source.as, (as) => {
        source.as = as;
        this.keep();
        this.showWork(bytes).then(() => this.findLandmarks()).catch((error) => this.studio.fail(error));
      });
    const style = segments("Style", [{ value: "none", label: "As it is" }, { value: "toon", label: "Toon" }] as const, options.style, (value) => {
      options.style = value;
      this.keep();
    });
    const caricature = slider({
      name: "caricature",
      label: "Caricature",
      least: 0,
      greatest: 2,
      step: 0.05,
      change: (value) => {
        options.caricature = value;
        this.keep();
      },
    });
    caricature.set(options.caricature);
    const hair = hairChoice(isPortrait, options.hair === "auto" && !isPortrait ? "none" : options.hair, (value) => {
      options.hair = value;
      this.keep();
    });
    const other = button("Another picture", () => void this.startAgain(), { kind: "quiet" });
    const choices = el("div", { class: "p-options" }, readAs && readAs.element, isPortrait && style.element, caricature.element, hair.element);
    this.element.replaceChildren(
      el(
        "div",
        { class: "p-scroll" },
        el("div", { class: "p-row p-spread p-heading" }, el("h2", { title: source.name }, source.name), other),
        this.pictureSection.element,
        choices,
        el("div", { class: "p-make" }, this.make),
        this.avatarJob.element,
        this.result,
      ),
    );
    this.showMake();
  }

  private async startAgain(): Promise<void> {
    this.cancelJobs();
    this.forgetHead();
    this.state = null;
    this.keep();
    await this.showStart();
  }
  private cancelJobs(): void {
    this.landmarksJob.cancel();
    this.avatarJob.cancel();
  }

  private setLandmarks(points: Point[]): void {
    if (!this.state) return;
    this.state.landmarks = points;
    this.keep();
  }
  private keep(): void {
    this.studio.remember(kAvatarKey, this.state);
    this.showMake();
  }
  private showMake(): void {
    const { state } = this;
    if (!state) return;
    const now = JSON.stringify(avatarBody(state));
    const refit = state.made !== null && JSON.stringify(avatarBody(state).landmarks) !== JSON.stringify((JSON.parse(state.made) as { landmarks?: Point[] }).landmarks);
    this.make.replaceChildren(!state.job ? "Make the head" : refit ? "Refit the head" : state.made === now ? "Make the head again" : "Make it with these choices");
    this.make.classList.toggle("p-primary", state.made !== now);
    this.make.classList.toggle("p-plain", state.made === now);
    this.make.disabled = this.avatarJob.isBusy;
  }

  private async makeHead(): Promise<void> {
    const { state } = this;
    if (!state || this.avatarJob.isBusy) return;
    // Found landmarks are in the picture's file already; the search for them need not end first.
    this.landmarksJob.cancel();
    const body = avatarBody(state);
    const run = this.avatarJob.run(body, state.job ? "Making the head again" : "Making the head");
    this.showMake();
    this.avatarJob.element.scrollIntoView({ block: "nearest" });
    const job = await run;
    if (state !== this.state) return;
    if (job) {
      state.job = job.id;
      state.made = JSON.stringify(body);
      this.keep();
      this.markLast();
      await this.takeJob(job);
      await this.showHead();
    }
    this.showMake();
  }

  // The head.

  private async takeJob(job: Job): Promise<void> {
    const file = job.files.find((each) => each.name.endsWith(".glb"));
    if (!file || !this.info) throw new Error("The job wrote no head.");
    this.bytes = await (await this.studio.api.jobFile(job.id, file.name)).arrayBuffer();
    this.rig = null;
    this.play = new PlayPart(this.studio, this.info);
    const playing = section("Play", true);
    playing.body.append(this.play.element);
    const stages = section("Stages", false, (open) => {
      if (open && this.stages.element.hidden) this.stages.show(job).catch((error) => this.studio.fail(error));
    });
    this.stages.clear();
    stages.body.append(this.stages.element);
    const take = button("Take this head away", () => {
      this.markLast();
      this.studio.open("take-away");
    }, { icon: "download" });
    const warnings = warningList(job.warnings);
    // The picture makes room for what can be played.
    this.pictureSection.element.open = false;
    this.result.hidden = false;
    this.result.replaceChildren(
      el("div", { class: "p-row p-spread" }, el("p", { role: "status" }, `The head is made, in ${job.seconds.toFixed(1)} s.`), take),
      ...(warnings ? [warnings] : []),
      playing.element,
      stages.element,
    );
  }
  private markLast(): void {
    this.studio.remember(kAvatarSubjectKey, JSON.stringify(this.studio.subject));
  }
  private async showHead(): Promise<void> {
    if (!this.shown) return;
    const { viewer } = this.studio;
    if (!this.bytes) {
      viewer.clear("The head appears here.");
      return;
    }
    this.rig = await viewer.loadGlb(this.bytes);
    if (this.shown) this.play?.setHead(this.rig);
  }
  private forgetHead(): void {
    this.play?.stop();
    this.play = null;
    this.rig = null;
    this.bytes = null;
    this.result.hidden = true;
    this.avatarJob.clear();
    this.landmarksJob.clear();
    this.stages.clear();
    if (this.shown) this.studio.viewer.clear("The head appears here.");
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
    if (!state.job) {
      void this.findLandmarks().catch((error) => this.studio.fail(error));
      return;
    }
    try {
      await this.takeJob(await this.studio.api.get<Job>(`/api/jobs/${state.job}`));
    } catch {
      // Jobs end with the server that ran them.
      state.job = state.made = null;
      this.keep();
    }
  }
}
