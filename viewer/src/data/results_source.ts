import type { Results, World } from "./results";

/** Where results come from: a file, or the engine of this page. */
export interface ResultsSource {
  readonly results: Results;
  world(index: number): Promise<World>;
  /** Names of the critical boxes of all worlds; empty where there is none, or it has no name. */
  criticalNames(): Promise<string[]>;
}
