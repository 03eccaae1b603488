// Coarser pictures while something changes where drawing is slow (software, weak graphics), fine ones when it rests.
import type { WebGLRenderer } from "three";

/** Milliseconds from a drawing to the next frame above which pictures in motion are coarser. */
const kSlow = 45;
const kCoarse = 0.5;
/** Milliseconds of rest before the fine picture. */
const kRest = 220;

export class AdaptiveResolution {
  private readonly fine = Math.min(2, devicePixelRatio);
  private cost = 0;
  private ratio = 0;
  private timer = 0;
  private isRest = false;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly redraw: () => void,
  ) {}

  /** Drawing takes long, as in software. */
  get isSlow(): boolean {
    return this.cost > kSlow;
  }
  /** Before a drawing. */
  begin(): void {
    const coarse = this.isSlow && !this.isRest;
    const ratio = coarse ? this.fine * kCoarse : this.fine;
    if (ratio !== this.ratio) this.renderer.setPixelRatio(ratio);
    this.ratio = ratio;
  }
  /** After it. */
  end(): void {
    const isFine = this.ratio === this.fine;
    const drawn = performance.now();
    // A coarse picture costs about a quarter of a fine one, whose cost decides.
    requestAnimationFrame(() => {
      if (isFine) this.cost = performance.now() - drawn;
    });
    clearTimeout(this.timer);
    this.isRest = false;
    if (isFine) return;
    this.timer = window.setTimeout(() => {
      this.isRest = true;
      this.redraw();
    }, kRest);
  }
}
