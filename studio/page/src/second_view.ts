// A small second view of the head in a corner of the first: the profile, or the front where the first shows a side.
import { PerspectiveCamera, type WebGLRenderer } from "three";
import { button, el } from "./dom";
import type { HeadScene } from "./head_scene";
import { type Frame, kFieldOfView, placeCamera } from "./view_camera";

/** Degrees of yaw of the first view from which on the second one shows the front. */
const kSideways = 45;
const kShare = 0.3;
const kWidths: readonly [number, number] = [96, 210];
const kHeightOfWidth = 1.15;
const kMargin = 10;
/** Width of a head, as a share of the height of its view. */
const kHeadWidth = 0.75;

export class SecondView {
  /** The border of the view: a press shows in the large view what the small one shows. */
  readonly element: HTMLButtonElement;
  readonly toggle: HTMLButtonElement;
  /** Receives whether it is shown, when a person changes that. */
  onToggle: (on: boolean) => void = () => undefined;
  private readonly camera = new PerspectiveCamera(kFieldOfView, 1, 1, 1000);
  private readonly word = el("span", { "aria-hidden": "true" });
  private view: "front" | "side" = "side";
  private on = false;

  constructor(look: (name: "front" | "side") => void, private readonly changed: () => void) {
    this.element = el("button", { type: "button", class: "view-second", hidden: true, onclick: () => look(this.view) }, this.word);
    this.toggle = button("+ Side", () => {
      this.set(!this.on);
      this.onToggle(this.on);
    }, { "aria-label": "+ Side: front and side at once", title: "Front and side at once" });
    this.set(false);
  }

  set(on: boolean): void {
    this.on = on;
    this.toggle.setAttribute("aria-pressed", String(on));
    this.changed();
  }

  /** Pixels by which the head of the first view makes way. */
  shift(width: number, height: number): number {
    return this.on ? Math.min(this.width(width, height) + kMargin, Math.max(0, (width - kHeadWidth * height) / 2)) : 0;
  }
  private width(width: number, height: number): number {
    return Math.round(Math.min(kWidths[1], Math.max(kWidths[0], kShare * Math.min(width, height))));
  }
  /** Draws into the lower left corner of the canvas, after the first view: there is least to see of a head from the front or from its right. */
  draw(renderer: WebGLRenderer, head: HeadScene, frame: Frame, yaw: number, width: number, height: number): void {
    this.element.hidden = !this.on;
    if (!this.on) return;
    const isSideways = Math.abs(yaw) > kSideways && Math.abs(yaw) < 180 - kSideways;
    this.view = isSideways ? "front" : "side";
    const name = isSideways ? "Front" : "Side";
    this.word.textContent = name;
    this.element.setAttribute("aria-label", `${name}, small view. Press to see it large`);
    const w = this.width(width, height);
    const h = Math.round(w * kHeightOfWidth);
    this.element.style.width = `${w}px`;
    this.element.style.height = `${h}px`;
    placeCamera(this.camera, frame, { yaw: isSideways ? 0 : -90, pitch: 0, zoom: 1, pan: [0, 0] }, w, h);
    head.lightFrom(this.camera);
    renderer.setScissorTest(true);
    renderer.setScissor(kMargin, kMargin, w, h);
    renderer.setViewport(kMargin, kMargin, w, h);
    renderer.render(head.scene, this.camera);
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, width, height);
  }
}
