import { boxText } from "../box/box_text";
import { compareTable, type Shown } from "../box/compare_table";
import { WorldPanel } from "../box/world_panel";
import type { World } from "../data/results";
import { Clock } from "../time/clock";
import { times } from "../time/poses";
import { TimePanel } from "../time/time_panel";
import { element, oncePerFrame } from "../ui/dom";
import { pictureOf } from "../ui/picture";
import type { Store, ViewState } from "../ui/state";
import { seconds } from "../ui/text";
import { onTheme } from "../ui/theme";
import { Video } from "../ui/video";
import { CameraRig } from "./camera_rig";
import { LoadScene } from "./load_scene";
import { OptionsBar } from "./options_bar";
import { outside } from "./outside";
import { viewButtons } from "./view_buttons";

/** A world that is open, or two side by side with one camera and one clock. */
export class WorldView {
  readonly node: HTMLElement;
  readonly clock: Clock;
  readonly timePanel: TimePanel;
  readonly scenes: LoadScene[];
  private readonly rig: CameraRig;
  private readonly panel: WorldPanel;
  private readonly options: OptionsBar;
  private readonly hint = element("div", { class: "hint", hidden: true });
  private readonly observer: ResizeObserver;
  private readonly quit: (() => void)[];
  private legend = "";
  private recording = false;

  /**
   * @param extra  stands above the numbers of the world
   * @param before a view of the same load, whose camera it takes over
   */
  constructor(
    private readonly shown: Shown[],
    private readonly store: Store,
    chooser: HTMLElement | null,
    actions: HTMLElement[],
    extra: HTMLElement | null = null,
    before: WorldView | null = null,
  ) {
    const { results, world } = shown[0];
    const worlds = shown.map((of) => of.world);
    const { state } = store;
    this.rig = new CameraRig(() => {
      for (const scene of this.scenes ?? []) scene.redraw();
    });
    const most = (axis: number) => Math.max(...worlds.map(({ container }) => container.size[axis]));
    this.rig.setContainer([most(0), most(1), most(2)]);
    const spans = worlds.map(times);
    this.clock = new Clock(
      store,
      Math.min(...spans.map((span) => span[0])),
      Math.max(...spans.map((span) => span[span.length - 1])),
    );
    this.scenes = shown.map((of) => new LoadScene(of.results, of.world, this.rig, state));
    const first = this.scenes[0];
    this.panel = new WorldPanel(
      results,
      world,
      store,
      (box) => this.focus(box),
      (box) => first.hover(box),
    );
    this.options = new OptionsBar(results, world, store, actions);
    this.timePanel = new TimePanel(world, this.clock, store);
    const pictures = element(
      "div",
      { class: "pictures" },
      ...this.scenes.map((scene, i) => {
        if (worlds.length > 1) scene.node.append(this.caption(worlds[i], i === 1 ? chooser : null));
        return scene.node;
      }),
      viewButtons((index) => this.view(index)),
      this.hint,
    );
    this.node = element(
      "main",
      { class: "world" },
      element("div", { class: "work" }, this.options.node, pictures, this.timePanel.node),
      this.panel.node,
    );
    if (shown.length > 1) this.panel.node.prepend(compareTable(shown));
    if (extra) this.panel.node.prepend(extra);
    for (const scene of this.scenes) this.listen(scene);
    let placed = false;
    this.observer = new ResizeObserver(() => {
      for (const scene of this.scenes) scene.resize();
      if (!placed && pictures.clientWidth > 0) {
        placed = true;
        if (before) this.rig.lookAs(before.rig);
        else this.view(0);
      }
    });
    this.observer.observe(pictures);
    this.quit = [
      store.listen((next, changed) => this.update(next, changed)),
      onTheme(() => {
        for (const scene of this.scenes) scene.recolour();
        this.timePanel.redraw();
        this.showLegend();
      }),
    ];
    this.showLegend();
  }

  private caption(world: World, chooser: HTMLElement | null): HTMLElement {
    return element(
      "div",
      { class: "caption" },
      element("i", { class: `swatch verdict-${world.verdict}` }),
      chooser ?? element("span", {}, `${world.layout} · ${world.acceleration}`),
    );
  }

  private listen(scene: LoadScene): void {
    this.rig.attach(scene.canvas);
    let down: [number, number] | null = null;
    // Pointers tell of themselves more often than pictures are drawn.
    let at: PointerEvent | null = null;
    const point = oncePerFrame(() => this.point(scene, at));
    scene.canvas.addEventListener("pointermove", (event) => {
      at = event.buttons === 0 ? event : null;
      point();
    });
    scene.canvas.addEventListener("pointerleave", () => {
      at = null;
      point();
    });
    scene.canvas.addEventListener("pointerdown", (event) => {
      down = [event.clientX, event.clientY];
    });
    scene.canvas.addEventListener("click", (event) => {
      // The end of a drag is no click.
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
      this.store.update({ box: scene.pick(event) });
    });
    scene.canvas.addEventListener("dblclick", (event) => {
      const box = scene.pick(event);
      if (box !== null) this.focus(box);
    });
  }

  private point(scene: LoadScene, event: PointerEvent | null): void {
    const box = event ? scene.pick(event) : null;
    scene.hover(box);
    this.hint.hidden = box === null;
    if (box === null || !event) return;
    const home = this.hint.parentElement!.getBoundingClientRect();
    const panel = scene === this.scenes[0] ? this.panel : null;
    this.hint.textContent = panel?.hint(box, this.store.state.time) ?? boxText(scene.world.boxes, box);
    this.hint.style.transform = `translate(${event.clientX - home.left + 14}px, ${event.clientY - home.top + 14}px)`;
  }

  private update(state: ViewState, changed: ReadonlySet<keyof ViewState>): void {
    for (const scene of this.scenes) scene.show(state);
    if (changed.has("time")) {
      this.timePanel.redraw();
      this.panel.showTime(state.time);
    }
    if (changed.has("box")) this.panel.showBox(state.box);
    this.options.show(state);
    this.showLegend();
  }

  private showLegend(): void {
    const { legend } = this.scenes[0];
    const text = JSON.stringify(legend);
    if (text === this.legend) return;
    this.legend = text;
    this.options.legend(legend);
  }

  /** Shows numbers anew that have become known. */
  refresh(): void {
    this.panel.refresh(false);
  }

  view(index: number): void {
    this.rig.view(
      index,
      this.shown.flatMap((of) => outside(of.results, of.world)),
    );
  }

  /** Looks at a box, the chosen one when none is named. */
  focus(box = this.store.state.box): void {
    if (box === null) return;
    const { place, radius } = this.scenes[0].placeOf(box);
    this.rig.focus(place, radius);
  }

  /** The picture at twice the size, with what it shows below it. */
  picture(): Promise<Blob> {
    const { state } = this.store;
    return pictureOf(
      this.scenes.map((scene) => scene.picture(2 * devicePixelRatio)),
      this.shown.map(({ world }) => `${world.layout}, ${world.acceleration}, ${world.engine}`),
      `${this.shown[0].results.name}, ${seconds(state.time)}`,
    );
  }

  /** Records one run through time from its beginning, or ends the record; the video when it is done. */
  async video(): Promise<Blob | null> {
    if (this.recording) {
      this.clock.pause();
      return null;
    }
    const films = this.scenes.map((scene) => ({
      canvas: scene.canvas,
      paint: (context: CanvasRenderingContext2D) => scene.paintLabels(context),
    }));
    this.clock.pause();
    this.clock.seek(this.clock.begin);
    const video = new Video(films);
    this.recording = true;
    for (const scene of this.scenes) scene.drawn = () => video.draw();
    await video.started;
    this.clock.play();
    await this.clock.stopped();
    for (const scene of this.scenes) scene.drawn = () => {};
    this.recording = false;
    return video.stop();
  }

  close(): void {
    for (const quit of this.quit) quit();
    this.clock.pause();
    this.observer.disconnect();
    this.rig.detach();
    for (const scene of this.scenes) scene.dispose();
  }
}
