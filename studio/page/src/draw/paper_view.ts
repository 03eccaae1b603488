// Where the sheet lies on the screen: css pixel = offset + zoom * sheet pixel.
/** Least x, least y, width, height. */
type Rectangle = readonly [number, number, number, number];

const kLeastZoom = 0.1;
const kGreatestZoom = 24;

export class PaperView {
  zoom = 1;
  x = 0;
  y = 0;
  /** The rectangle that was fitted and not moved since: a new size fits it again. */
  private fitted: Rectangle | null;

  constructor(
    public sheet: [number, number],
    private width = 1,
    private height = 1,
  ) {
    this.fitted = [0, 0, ...sheet];
  }

  /** A rectangle of the sheet, or all of it, with a margin. */
  fit(rectangle: Rectangle = [0, 0, ...this.sheet]): void {
    const [left, top, width, height] = rectangle;
    const kMargin = 14;
    this.zoom = Math.min(
      kGreatestZoom,
      Math.max(kLeastZoom, Math.min((this.width - 2 * kMargin) / width, (this.height - 2 * kMargin) / height)),
    );
    this.x = this.width / 2 - this.zoom * (left + width / 2);
    this.y = this.height / 2 - this.zoom * (top + height / 2);
    this.fitted = rectangle;
  }
  resize(width: number, height: number): void {
    // A tab that is hidden has no size: the view waits for its return.
    if (width < 1 || height < 1) return;
    const dx = (width - this.width) / 2;
    const dy = (height - this.height) / 2;
    this.width = width;
    this.height = height;
    if (this.fitted) this.fit(this.fitted);
    else this.pan(dx, dy);
  }
  pan(dx: number, dy: number): void {
    this.fitted = null;
    // A corner of the sheet stays in sight.
    const kLeast = 60;
    this.x = Math.min(this.width - kLeast, Math.max(kLeast - this.zoom * this.sheet[0], this.x + dx));
    this.y = Math.min(this.height - kLeast, Math.max(kLeast - this.zoom * this.sheet[1], this.y + dy));
  }
  zoomAt(x: number, y: number, factor: number): void {
    const next = Math.min(kGreatestZoom, Math.max(kLeastZoom, this.zoom * factor));
    const ratio = next / this.zoom;
    this.zoom = next;
    this.fitted = null;
    this.x = x - ratio * (x - this.x);
    this.y = y - ratio * (y - this.y);
  }
  zoomMiddle(factor: number): void {
    this.zoomAt(this.width / 2, this.height / 2, factor);
  }
  get size(): [number, number] {
    return [this.width, this.height];
  }
}
