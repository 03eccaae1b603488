// The picture of an avatar: its landmarks with undo, files of them, or the lines of a drawing.
import type { Point, SessionState } from "../api_types";
import { download, el } from "../dom";
import { fileButton } from "../file_choice";
import { History } from "../history";
import type { Studio } from "../tab";
import { button } from "../widgets";
import { LandmarkEditor } from "./landmark_editor";
import { placedLandmarks, readPts, writePts } from "./landmarks";

const kSvg = "http://www.w3.org/2000/svg";

export class PicturePart {
  readonly element = el("div", { class: "p-picture" });
  private readonly editor = new LandmarkEditor((points, done) => this.moved(points, done));
  private readonly note = el("p", { class: "p-hint" });
  private readonly again: HTMLButtonElement;
  private readonly save: HTMLButtonElement;
  private readonly place: HTMLButtonElement;
  private readonly tools: HTMLElement;
  private size: [number, number] = [1, 1];
  private history = new History<Point[]>({ past: [], present: [], future: [] });
  private found: readonly Point[] = [];
  private name = "";
  private address = "";

  constructor(private readonly studio: Studio, private readonly changed: (points: Point[]) => void) {
    this.again = button("As found", () => this.moved(this.found.map((point): Point => [...point]), true), {
      kind: "quiet",
      icon: "reset",
      title: "The landmarks as the network found them",
    });
    this.save = button("Save .pts", () => download(new Blob([writePts(this.points)], { type: "text/plain" }), this.name.replace(/\.\w+$/, "") + ".pts"), {
      kind: "quiet",
      icon: "download",
    });
    const open = fileButton("Open .pts", ".pts,.txt", (file) => void this.openPts(file), { kind: "quiet" });
    this.place = button("Place the points by hand", () => this.moved(placedLandmarks(...this.size), true), { icon: "point" });
    const files = el("details", { class: "p-how" }, el("summary", {}, "Files of points"), el("div", { class: "p-row" }, this.save, open));
    this.tools = el("div", { class: "p-row" }, this.place, this.again, files);
  }

  get points(): Point[] {
    return this.history.present;
  }
  get canUndo(): boolean {
    return this.history.canUndo;
  }
  get canRedo(): boolean {
    return this.history.canRedo;
  }
  undo(): void {
    if (this.history.undo()) this.show();
  }
  redo(): void {
    if (this.history.redo()) this.show();
  }

  /** Shows a picture without landmarks; returns its size in pixels. @throws Error if the browser cannot read it. */
  async setPicture(name: string, bytes: Blob): Promise<[number, number]> {
    this.name = name;
    URL.revokeObjectURL(this.address);
    this.address = URL.createObjectURL(bytes);
    const image = new Image();
    image.src = this.address;
    try {
      await image.decode();
    } catch {
      throw new Error(`The browser cannot show ${name}. Choose a PNG or a JPEG picture.`);
    }
    const size: [number, number] = [image.naturalWidth || 512, image.naturalHeight || 512];
    this.size = size;
    this.element.replaceChildren(this.editor.element, this.note, this.tools);
    this.editor.setPicture(this.address, size);
    this.setLandmarks(null, null);
    return size;
  }
  /** `found`: of the network; `now`: with what a person moved. null: there are none. */
  setLandmarks(found: readonly Point[] | null, now: readonly Point[] | null): void {
    this.found = found ?? [];
    this.history = new History<Point[]>({ past: [], present: (now ?? this.found).map((point): Point => [...point]), future: [] });
    this.editor.setPoints(this.points);
    this.editor.showFace();
    this.tools.hidden = this.points.length === 0;
    this.showNote();
    this.studio.refresh();
  }
  /** The network found no face: a person can place the points, or open a file of them. */
  offerByHand(): void {
    this.element.prepend(this.tools);
    this.tools.hidden = false;
    this.showNote();
  }
  /** A drawing has no landmarks to move: its lines are shown. */
  setDrawing(session: SessionState): void {
    const svg = document.createElementNS(kSvg, "svg");
    svg.setAttribute("viewBox", `0 0 ${session.sheet[0]} ${session.sheet[1]}`);
    svg.setAttribute("class", "p-drawing");
    svg.setAttribute("role", "img");
    svg.setAttribute("aria-label", `The drawing ${session.name}`);
    for (const line of session.lines) {
      const path = document.createElementNS(kSvg, "polyline");
      path.setAttribute("points", line.points.map((point) => point.join(",")).join(" "));
      svg.append(path);
    }
    this.history = new History<Point[]>({ past: [], present: [], future: [] });
    this.element.replaceChildren(svg);
    this.studio.refresh();
  }

  private moved(points: Point[], done: boolean): void {
    this.history.change(points, "landmarks", done);
    if (done) this.show();
    else this.showNote();
  }
  private show(): void {
    this.element.append(this.tools);
    this.editor.setPoints(this.points);
    this.showNote();
    this.changed(this.points);
    this.studio.refresh();
  }
  private showNote(): void {
    const moved = this.points.filter((point, index) => point[0] !== this.found[index]?.[0] || point[1] !== this.found[index]?.[1]).length;
    this.save.hidden = this.points.length === 0;
    this.place.hidden = this.points.length > 0;
    this.again.hidden = moved === 0 || this.found.length === 0;
    this.note.hidden = this.points.length === 0;
    this.note.replaceChildren(
      this.found.length === 0
        ? "Drag each point to its place. With Alt all of them move, with Shift those of the same part."
        : moved ? `${moved} of ${this.points.length} landmarks moved by hand.` : "Does a point sit wrong? Drag it to its place before the head is made.",
    );
  }
  private async openPts(file: File): Promise<void> {
    try {
      this.moved(readPts(file.name, await file.text()), true);
    } catch (error) {
      this.studio.fail(error);
    }
  }
}
