// A picture under the paper to draw after. It stays in the page: the server does not need it.
export class ReferencePicture {
  picture: ImageBitmap | null = null;
  opacity = 0.4;

  constructor(private readonly changed: () => void) {}

  async read(file: Blob): Promise<void> {
    let picture: ImageBitmap;
    try {
      picture = await createImageBitmap(file);
    } catch {
      throw new Error("This file is no picture that the browser reads. Choose a PNG or JPEG file.");
    }
    this.picture?.close();
    this.picture = picture;
    this.changed();
  }
  remove(): void {
    this.picture?.close();
    this.picture = null;
    this.changed();
  }
  setOpacity(opacity: number): void {
    this.opacity = opacity;
    this.changed();
  }
  get content(): { picture: ImageBitmap; width: number; height: number; opacity: number } | null {
    return this.picture && { picture: this.picture, width: this.picture.width, height: this.picture.height, opacity: this.opacity };
  }
}
