// A head that was made: it is shown in the 3-D view, played, and seen in its stages.
import type { Job, ShapeInfo } from "../api_types";
import { el } from "../dom";
import { warningList } from "../job_card";
import type { Studio } from "../tab";
import { button, section } from "../widgets";
import { kPoseKey, PlayPart } from "./play_part";
import { StagesStrip } from "./stages_strip";

export class ResultPart {
  readonly element = el("div", { class: "p-result", hidden: true });
  private readonly stages: StagesStrip;
  private play: PlayPart | null = null;
  private bytes: ArrayBuffer | null = null;
  private isShown = false;

  constructor(private readonly studio: Studio, private readonly takeAway: () => void) {
    this.stages = new StagesStrip(studio.api);
  }

  /** Reads the files of a job. @throws Error if the server no longer has them. */
  async takeJob(job: Job, info: ShapeInfo): Promise<void> {
    const file = job.files.find((each) => each.name.endsWith(".glb"));
    if (!file) throw new Error("The job wrote no head.");
    this.bytes = await (await this.studio.api.jobFile(job.id, file.name)).arrayBuffer();
    this.isShown = false;
    this.play?.stop();
    this.play = new PlayPart(this.studio, info);
    const playing = section("Play", true);
    playing.body.append(this.play.element);
    this.stages.clear();
    const stages = section("Stages", false, (open) => {
      if (open && this.stages.isEmpty) this.stages.show(job).catch((error) => this.studio.fail(error));
    });
    stages.body.append(this.stages.element);
    const warnings = warningList(job.warnings);
    this.element.hidden = false;
    this.element.replaceChildren(
      el(
        "div",
        { class: "p-row p-spread" },
        el("p", { role: "status" }, `The head is made, in ${job.seconds.toFixed(1)} s.`),
        button("Take this head away", this.takeAway, { icon: "download" }),
      ),
      ...(warnings ? [warnings] : []),
      playing.element,
      stages.element,
    );
  }

  /** Puts the head into the 3-D view, or a sentence where there is none. */
  async show(): Promise<void> {
    const { viewer } = this.studio;
    const { play, bytes } = this;
    if (!bytes || !play) {
      viewer.clear("The head appears here.");
      return;
    }
    const rig = await viewer.loadGlb(bytes);
    play.setHead(rig);
    this.isShown = true;
  }
  hide(): void {
    this.play?.stop();
    this.isShown = false;
  }
  /** Plays a recording; false while no head is shown. */
  openClip(file: File): boolean {
    if (!this.play || !this.isShown) return false;
    void this.play.openClip(file);
    return true;
  }
  forget(): void {
    this.hide();
    this.studio.remember(kPoseKey, {});
    this.play = null;
    this.bytes = null;
    this.element.hidden = true;
    this.stages.clear();
  }
}
