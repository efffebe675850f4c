/** What the time panel shows and moves: recorded time that plays, or a world that is simulated as it goes. */
export interface TimeControl {
  readonly playing: boolean;
  readonly speed: number;
  /** s, of all that is shown; negative where a load settles */
  readonly begin: number;
  readonly end: number;
  listen(listener: () => void): void;
  toggle(): void;
  pause(): void;
  seek(time: number): void;
  setSpeed(speed: number): void;
}
