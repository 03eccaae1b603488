// A picture with the 68 landmarks of its face, which a person moves by pointer, by arrow keys or by typed numbers.
import type { Point } from "../api_types";
import { el } from "../dom";
import { button, newId } from "../widgets";
import { kLandmarkParts, landmarkTitle } from "./landmarks";
import { PictureBox } from "./picture_box";

const kSvg = "http://www.w3.org/2000/svg";
const kReach = { mouse: 14, touch: 26 };
export class LandmarkEditor {
  readonly element: HTMLElement;
  private readonly stage: HTMLElement;
  private readonly svg = document.createElementNS(kSvg, "svg");
  private readonly image = document.createElementNS(kSvg, "image");
  /** Paper below a drawing, whose ground may be transparent. */
  private readonly paper = document.createElementNS(kSvg, "rect");
  private readonly lines = kLandmarkParts.map((part) => document.createElementNS(kSvg, part.closed ? "polygon" : "polyline"));
  private readonly dots: SVGCircleElement[] = [];
  private readonly tools: HTMLElement;
  private readonly list: HTMLSelectElement;
  private readonly fields: [HTMLInputElement, HTMLInputElement];
  private readonly pointers = new Map<number, Point>();
  private readonly box = new PictureBox();
  private points: readonly Point[] = [];
  private selected: number | null = null;

  /** `change` receives all points while one moves (done = false) and when it stays. */
  constructor(private readonly change: (points: Point[], done: boolean) => void) {
    for (const line of this.lines) line.setAttribute("class", "p-landmark-line");
    this.svg.setAttribute("aria-hidden", "true");
    this.paper.setAttribute("fill", "#fff");
    this.svg.append(this.paper, this.image, ...this.lines);
    this.stage = el("div", {
      class: "p-landmarks",
      tabindex: 0,
      role: "application",
      "aria-label": "Picture with landmarks. Page Up and Page Down choose a landmark, arrow keys move it, with Alt all of them; plus and minus zoom, 0 shows all.",
    });
    this.stage.append(this.svg);
    const id = newId("landmark");
    this.list = el("select", { id, class: "p-select", onchange: () => this.select(this.list.value === "" ? null : Number(this.list.value), true) });
    const field = (axis: 0 | 1) => {
      const name = axis === 0 ? "x" : "y";
      const input = el("input", { type: "number", class: "p-number", step: 1, "aria-label": `${name} of the landmark, pixels` });
      input.addEventListener("change", () => {
        const own = this.selected === null ? undefined : this.points[this.selected];
        if (!own || !Number.isFinite(input.valueAsNumber)) return;
        this.move(axis === 0 ? [input.valueAsNumber, own[1]] : [own[0], input.valueAsNumber], true);
      });
      return input;
    };
    this.fields = [field(0), field(1)];
    const zoom = el(
      "div",
      { class: "p-zoom" },
      button("", () => this.zoom(1.4), { icon: "plus", name: "Zoom in" }),
      button("", () => this.zoom(1 / 1.4), { icon: "minus", name: "Zoom out" }),
      button("", () => this.fit(), { icon: "fit", name: "Show the whole picture" }),
    );
    this.tools = el(
      "div",
      { class: "p-row p-landmark-tools" },
      el("label", { for: id, class: "p-visually-hidden" }, "Landmark"),
      this.list,
      el("label", { class: "p-axis" }, "x", this.fields[0]),
      el("label", { class: "p-axis" }, "y", this.fields[1]),
    );
    this.element = el("div", { class: "p-landmark-editor" }, el("div", { class: "p-landmark-frame" }, this.stage, zoom), this.tools);
    this.stage.addEventListener("pointerdown", (event) => this.down(event));
    this.stage.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-0.0015 * event.deltaY), this.pictureAt(event));
    }, { passive: false });
    this.stage.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.showBox()).observe(this.stage);
  }

  setPicture(address: string, size: Point): void {
    this.image.setAttribute("href", address);
    for (const each of [this.paper, this.image]) {
      each.setAttribute("width", String(size[0]));
      each.setAttribute("height", String(size[1]));
    }
    this.stage.style.aspectRatio = `${size[0]} / ${size[1]}`;
    this.box.setPicture(size);
    this.showBox();
  }
  /** Shows the face large where it is a small part of the picture. */
  showFace(): void {
    if (this.points.length > 0) this.box.frame(this.points);
    this.showBox();
  }

  /** Shows points without calling `change`; none hides the tools. */
  setPoints(points: readonly Point[]): void {
    this.points = points;
    this.tools.hidden = points.length === 0;
    if (this.selected !== null && this.selected >= points.length) this.selected = null;
    while (this.dots.length < points.length) {
      const dot = document.createElementNS(kSvg, "circle");
      this.dots.push(dot);
      this.svg.append(dot);
    }
    while (this.dots.length > points.length) this.dots.pop()?.remove();
    if (this.list.options.length !== points.length + 1) {
      const title = points.length ? `${points.length} landmarks` : "No landmarks";
      this.list.replaceChildren(el("option", { value: "" }, title), ...points.map((_, index) => el("option", { value: index }, landmarkTitle(index))));
    }
    this.showPoints();
  }

  private showPoints(): void {
    // Dots of a small face do not hide it.
    const xs = this.points.map((point) => point[0]);
    const radius = Math.min(3, Math.max(1, (Math.max(...xs) - Math.min(...xs)) / this.pixel() / 50)) * this.pixel();
    kLandmarkParts.forEach((part, index) => {
      const own = this.points.slice(part.first, part.last + 1);
      this.lines[index]?.setAttribute("points", own.map((point) => point.join(",")).join(" "));
    });
    this.points.forEach((point, index) => {
      const dot = this.dots[index];
      const chosen = index === this.selected;
      dot?.setAttribute("cx", String(point[0]));
      dot?.setAttribute("cy", String(point[1]));
      dot?.setAttribute("r", String(chosen ? 2 * radius : radius));
      dot?.setAttribute("stroke-width", String(0.5 * radius));
      dot?.setAttribute("class", chosen ? "p-landmark p-chosen" : "p-landmark");
    });
    const own = this.selected === null ? undefined : this.points[this.selected];
    this.list.value = this.selected === null ? "" : String(this.selected);
    this.fields.forEach((field, axis) => {
      field.disabled = own === undefined;
      field.value = own ? String(Number((own[axis] ?? 0).toFixed(1))) : "";
    });
  }

  private select(index: number | null, show: boolean): void {
    this.selected = index;
    this.showPoints();
    const own = index === null ? undefined : this.points[index];
    if (!show || !own || this.box.holds(own)) return;
    this.box.moveTo(own);
    this.showBox();
  }

  /** Moves the chosen landmark to a place, and with it its part or all others. */
  private move(to: Point, done: boolean, which: "one" | "part" | "all" = "one", from: readonly Point[] = this.points): void {
    const chosen = this.selected;
    const own = chosen === null ? undefined : from[chosen];
    if (chosen === null || !own) return;
    const part = kLandmarkParts.find((each) => chosen >= each.first && chosen <= each.last);
    const goes = (index: number) =>
      which === "all" || index === chosen || (which === "part" && part !== undefined && index >= part.first && index <= part.last);
    const points = from.map((point, index): Point => (goes(index) ? [point[0] + to[0] - own[0], point[1] + to[1] - own[1]] : [...point]));
    this.points = points;
    this.showPoints();
    this.change(points, done);
  }

  /** Pixels of the picture a pixel of the window. */
  private pixel(): number {
    return this.box.width / (this.stage.clientWidth || 1);
  }
  private pictureAt(event: MouseEvent): Point {
    const frame = this.stage.getBoundingClientRect();
    return [
      this.box.left + ((event.clientX - frame.left) / frame.width) * this.box.width,
      this.box.top + ((event.clientY - frame.top) / frame.height) * this.box.height,
    ];
  }
  private fit(): void {
    this.box.fit();
    this.showBox();
  }
  private zoom(factor: number, about?: Point): void {
    const own = this.selected === null ? undefined : this.points[this.selected];
    this.box.zoom(factor, about ?? own ?? this.box.centre);
    this.showBox();
  }
  private showBox(): void {
    this.box.setFrame(this.stage.clientWidth, this.stage.clientHeight);
    this.svg.setAttribute("viewBox", `${this.box.left} ${this.box.top} ${this.box.width} ${this.box.height}`);
    this.showPoints();
  }

  private nearest(event: PointerEvent): number | null {
    const at = this.pictureAt(event);
    let best: number | null = null;
    let least = (event.pointerType === "touch" ? kReach.touch : kReach.mouse) * this.pixel();
    this.points.forEach((point, index) => {
      const distance = Math.hypot(point[0] - at[0], point[1] - at[1]);
      if (distance > least) return;
      least = distance;
      best = index;
    });
    return best;
  }

  private down(event: PointerEvent): void {
    if (event.button > 1) return;
    const grabbed = this.pointers.size === 0 && event.button === 0 ? this.nearest(event) : null;
    if (grabbed !== null || this.pointers.size === 0) this.select(grabbed, false);
    this.stage.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    const begin = this.pictureAt(event);
    const from = this.points;
    const own = grabbed === null ? undefined : from[grabbed];
    const which = event.altKey ? "all" : event.shiftKey ? "part" : "one";
    let moved = false;
    const place = (next: PointerEvent): Point => {
      const at = this.pictureAt(next);
      return [(own?.[0] ?? 0) + at[0] - begin[0], (own?.[1] ?? 0) + at[1] - begin[1]];
    };
    const move = (next: PointerEvent) => {
      const last = this.pointers.get(next.pointerId);
      if (next.pointerId !== event.pointerId || !last) return;
      if (own) {
        moved ||= Math.hypot(next.clientX - event.clientX, next.clientY - event.clientY) > 1;
        if (moved) this.move(place(next), false, which, from);
        return;
      }
      this.pinch(next, last);
      this.pointers.set(next.pointerId, [next.clientX, next.clientY]);
    };
    const end = (next: PointerEvent) => {
      if (next.pointerId !== event.pointerId) return;
      this.pointers.delete(event.pointerId);
      this.stage.removeEventListener("pointermove", move);
      this.stage.removeEventListener("pointerup", end);
      this.stage.removeEventListener("pointercancel", end);
      if (own && moved) this.move(place(next), true, which, from);
    };
    this.stage.addEventListener("pointermove", move);
    this.stage.addEventListener("pointerup", end);
    this.stage.addEventListener("pointercancel", end);
  }

  /** One pointer moves the picture, two scale it. */
  private pinch(next: PointerEvent, last: Point): void {
    const other = [...this.pointers].find(([id]) => id !== next.pointerId)?.[1];
    if (other) {
      const before = Math.hypot(last[0] - other[0], last[1] - other[1]);
      const after = Math.hypot(next.clientX - other[0], next.clientY - other[1]);
      if (before > 0) this.zoom(after / before, this.pictureAt(next));
      return;
    }
    this.box.shift(-(next.clientX - last[0]) * this.pixel(), -(next.clientY - last[1]) * this.pixel());
    this.showBox();
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey) return;
    const own = this.selected === null ? undefined : this.points[this.selected];
    const step = event.shiftKey ? 10 : 1;
    const moves: Record<string, Point> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
    const by = moves[event.key];
    const count = this.points.length;
    if (by && own) this.move([own[0] + by[0], own[1] + by[1]], true, event.altKey ? "all" : "one");
    else if (event.key === "PageDown" && count) this.select(this.selected === null ? 0 : (this.selected + 1) % count, true);
    else if (event.key === "PageUp" && count) this.select(this.selected === null ? count - 1 : (this.selected + count - 1) % count, true);
    else if (event.key === "+" || event.key === "=") this.zoom(1.25);
    else if (event.key === "-") this.zoom(1 / 1.25);
    else if (event.key === "0") this.fit();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
