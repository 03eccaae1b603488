// The part of a picture that a frame of the window shows: the whole, zoomed, moved. All in pixels of the picture.
import type { Point } from "../api_types";

const kGreatestZoom = 24;

export class PictureBox {
  private size: Point = [1, 1];
  private aspect = 1;
  private x = 0;
  private y = 0;
  private wide = 1;
  /** Whether the whole picture is shown, whatever size the frame takes. */
  private whole = true;

  setPicture(size: Point): void {
    this.size = size;
    this.fit();
  }
  /** Width and height of the frame in pixels of the window. */
  setFrame(width: number, height: number): void {
    this.aspect = Math.max(1, width) / Math.max(1, height);
    this.limit();
  }

  get width(): number {
    return this.wide;
  }
  get height(): number {
    return this.wide / this.aspect;
  }
  get left(): number {
    return this.x;
  }
  get top(): number {
    return this.y;
  }
  get centre(): Point {
    return [this.x + this.width / 2, this.y + this.height / 2];
  }
  holds(point: Point): boolean {
    return point[0] > this.x && point[0] < this.x + this.width && point[1] > this.y && point[1] < this.y + this.height;
  }

  fit(): void {
    this.whole = true;
    this.limit();
  }
  /** Scales about a point that stays where it is. */
  zoom(factor: number, about: Point): void {
    const width = Math.min(this.wholeWidth, Math.max(this.wholeWidth / kGreatestZoom, this.wide / factor));
    const share = width / this.wide;
    this.x = about[0] - (about[0] - this.x) * share;
    this.y = about[1] - (about[1] - this.y) * share;
    this.wide = width;
    this.whole = width >= this.wholeWidth;
    this.limit();
  }
  shift(x: number, y: number): void {
    this.x += x;
    this.y += y;
    this.limit();
  }
  moveTo(centre: Point): void {
    this.shift(centre[0] - this.centre[0], centre[1] - this.centre[1]);
  }
  /** Shows points large, with as much around them, where they are a small part of the picture. */
  frame(points: readonly Point[]): void {
    const extent = (axis: 0 | 1) => {
      const values = points.map((point) => point[axis]);
      return [Math.min(...values), Math.max(...values)] as const;
    };
    const [left, right] = extent(0);
    const [top, bottom] = extent(1);
    const width = 2 * Math.max(right - left, (bottom - top) * this.aspect);
    if (!(width < 0.6 * this.wholeWidth)) return;
    this.whole = false;
    this.wide = width;
    this.moveTo([(left + right) / 2, (top + bottom) / 2]);
  }

  /** The box that holds the whole picture has the shape of the frame. */
  private get wholeWidth(): number {
    return Math.max(this.size[0], this.size[1] * this.aspect);
  }
  /** The picture never leaves the frame; a side that it does not fill has it in the middle. */
  private limit(): void {
    this.wide = this.whole ? this.wholeWidth : Math.min(this.wholeWidth, this.wide);
    const within = (at: number, length: number, most: number) => (length >= most ? (most - length) / 2 : Math.min(most - length, Math.max(0, at)));
    this.x = within(this.x, this.width, this.size[0]);
    this.y = within(this.y, this.height, this.size[1]);
  }
}
