import { element } from "./dom";
import { colour } from "./theme";

/** Pictures a second of a video. */
const RATE = 30;
/** Bits a second: sharp edges of a thousand boxes. */
const BITS = 12_000_000;

/** A picture that a video is made of: where it is drawn, and what is painted over it. */
export interface Film {
  canvas: HTMLCanvasElement;
  paint(context: CanvasRenderingContext2D): void;
}

/** Records what the pictures show, side by side, from now until `stop`. */
export class Video {
  private readonly canvas: HTMLCanvasElement;
  private readonly context: CanvasRenderingContext2D;
  private readonly recorder: MediaRecorder;
  private readonly pieces: Blob[] = [];
  private readonly done: Promise<Blob>;
  /** Resolves when the first picture is taken. */
  readonly started: Promise<void>;

  constructor(private readonly films: readonly Film[]) {
    const width = films.reduce((sum, film) => sum + film.canvas.width, 0);
    this.canvas = element("canvas", { width, height: films[0].canvas.height });
    this.context = this.canvas.getContext("2d")!;
    this.recorder = new MediaRecorder(this.canvas.captureStream(RATE), {
      mimeType: "video/webm",
      videoBitsPerSecond: BITS,
    });
    this.recorder.ondataavailable = (event) => this.pieces.push(event.data);
    this.done = new Promise((resolve) => {
      this.recorder.onstop = () => resolve(new Blob(this.pieces, { type: "video/webm" }));
    });
    this.started = new Promise((resolve) => {
      this.recorder.onstart = () => resolve();
    });
    this.recorder.start();
    this.draw();
  }

  /** Takes the pictures as they are now. */
  draw(): void {
    const { context } = this;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = colour("scene");
    context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    let x = 0;
    for (const film of this.films) {
      context.setTransform(1, 0, 0, 1, x, 0);
      context.drawImage(film.canvas, 0, 0);
      context.scale(devicePixelRatio, devicePixelRatio);
      film.paint(context);
      x += film.canvas.width;
    }
  }

  stop(): Promise<Blob> {
    if (this.recorder.state !== "inactive") this.recorder.stop();
    return this.done;
  }
}
