// Where the sheet lies on the screen: css pixel = offset + zoom * sheet pixel.
export class PaperView {
  zoom = 1;
  x = 0;
  y = 0;
  private fitted = true;

  constructor(public sheet: [number, number], private width = 1, private height = 1) {}

  /** The whole sheet with a margin. */
  fit(): void {
    const kMargin = 14;
    this.zoom = Math.max(0.05, Math.min((this.width - 2 * kMargin) / this.sheet[0], (this.height - 2 * kMargin) / this.sheet[1]));
    this.x = (this.width - this.zoom * this.sheet[0]) / 2;
    this.y = (this.height - this.zoom * this.sheet[1]) / 2;
    this.fitted = true;
  }
  resize(width: number, height: number): void {
    const dx = (width - this.width) / 2;
    const dy = (height - this.height) / 2;
    this.width = width;
    this.height = height;
    if (this.fitted) this.fit();
    else this.pan(dx, dy);
  }
  pan(dx: number, dy: number): void {
    this.fitted = false;
    // A corner of the sheet stays in sight.
    const kLeast = 60;
    this.x = Math.min(this.width - kLeast, Math.max(kLeast - this.zoom * this.sheet[0], this.x + dx));
    this.y = Math.min(this.height - kLeast, Math.max(kLeast - this.zoom * this.sheet[1], this.y + dy));
  }
  zoomAt(x: number, y: number, factor: number): void {
    const next = Math.min(16, Math.max(0.2, this.zoom * factor));
    const ratio = next / this.zoom;
    this.zoom = next;
    this.fitted = false;
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
