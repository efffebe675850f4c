import { WorldPanel } from "../box/world_panel";
import type { Results, World } from "../data/results";
import type { EngineClient } from "../engine/engine_client";
import { CameraRig } from "../load/camera_rig";
import { LoadScene } from "../load/load_scene";
import { OptionsBar } from "../load/options_bar";
import { outside } from "../load/outside";
import { viewButtons } from "../load/view_buttons";
import { TimePanel } from "../time/time_panel";
import { element, oncePerFrame } from "../ui/dom";
import type { Keymap } from "../ui/keys";
import { pictureOf } from "../ui/picture";
import type { Store, ViewState } from "../ui/state";
import { seconds } from "../ui/text";
import { onTheme } from "../ui/theme";
import { LiveDriver } from "./live_driver";
import { liveKeys } from "./live_keys";
import { LivePanel } from "./live_panel";
import { LivePointer } from "./live_pointer";
import { LivePoses } from "./live_poses";
import { saveFile } from "./save";

/** A world that runs in the engine of this page. */
export class LiveView {
  readonly node: HTMLElement;
  readonly driver: LiveDriver;
  readonly keys: Keymap;
  private readonly scene: LoadScene;
  private readonly rig: CameraRig;
  private readonly panel: WorldPanel;
  private readonly drive: LivePanel;
  private readonly timePanel: TimePanel;
  private readonly options: OptionsBar;
  private readonly pointer: LivePointer;
  private readonly hint = element("div", { class: "hint", hidden: true });
  private readonly observer: ResizeObserver;
  private readonly quit: (() => void)[];
  private legend = "";
  private closed = false;
  private readonly showDriver = oncePerFrame(() => this.update(this.store.state, new Set(["time"])));

  constructor(
    private readonly file: Results,
    of: World,
    private readonly client: EngineClient,
    version: string,
    private readonly store: Store,
    actions: HTMLElement[],
  ) {
    this.driver = new LiveDriver(
      client,
      file,
      of,
      store,
      oncePerFrame(() => this.takeSamples()),
    );
    const { record } = this.driver;
    this.rig = new CameraRig(() => this.scene?.redraw());
    this.rig.setContainer(of.container.size);
    this.scene = new LoadScene(record.results, record.world, this.rig, store.state, new LivePoses(this.driver));
    this.panel = new WorldPanel(
      record.results,
      record.world,
      store,
      (box) => this.focus(box),
      (box) => this.scene.hover(box),
    );
    this.drive = new LivePanel(this.driver, file, of, version, {
      leave: () => store.update({ live: false }),
      save: (kind) => saveFile(kind, this.driver, file, of, client).then((text) => this.drive.say(text)),
    });
    this.timePanel = new TimePanel(record.world, this.driver, store, true);
    this.options = new OptionsBar(record.results, record.world, store, actions);
    this.rig.attach(this.scene.canvas);
    this.pointer = new LivePointer(this.scene, this.rig, this.driver, store, (box, event) => this.point(box, event));
    this.driver.force = (time) => this.pointer.force(time);
    this.keys = liveKeys(this.driver, this.drive, this.pointer, store);
    const pictures = element(
      "div",
      { class: "pictures" },
      this.drive.node,
      this.scene.node,
      viewButtons((index) => this.view(index)),
      this.hint,
    );
    this.node = element(
      "main",
      { class: "world live" },
      element("div", { class: "work" }, this.options.node, pictures, this.timePanel.node),
      this.panel.node,
    );
    let placed = false;
    this.observer = new ResizeObserver(() => {
      this.scene.resize();
      if (!placed && pictures.clientWidth > 0) {
        placed = true;
        this.view(0);
      }
    });
    this.observer.observe(pictures);
    let playing = false;
    this.driver.listen(() => {
      this.showDriver();
      if (playing && !this.driver.playing) this.panel.refresh();
      playing = this.driver.playing;
    });
    this.quit = [
      store.listen((next, changed) => this.update(next, changed)),
      onTheme(() => {
        this.scene.recolour();
        this.timePanel.redraw();
        this.legend = "";
        this.showDriver();
      }),
    ];
    this.drive.showBox(store.state.box);
  }

  /** The world at its start. */
  begin(): Promise<void> {
    return this.driver.restart("drive");
  }

  /** Samples more: what is computed from all of them. */
  private takeSamples(): void {
    if (this.closed) return;
    this.scene.refresh();
    this.timePanel.refresh();
    // Rows keep their places while numbers change.
    this.panel.refresh(!this.driver.playing);
  }

  private point(box: number | null, event: PointerEvent | null): void {
    this.scene.hover(box);
    this.hint.hidden = box === null || event === null;
    if (box === null || !event) return;
    const home = this.hint.parentElement!.getBoundingClientRect();
    this.hint.textContent = this.panel.hint(box, this.store.state.time);
    this.hint.style.transform = `translate(${event.clientX - home.left + 14}px, ${event.clientY - home.top + 14}px)`;
  }

  private update(state: ViewState, changed: ReadonlySet<keyof ViewState>): void {
    if (this.closed) return;
    this.scene.show(state);
    this.pointer.draw();
    this.timePanel.redraw();
    if (changed.has("box")) {
      this.panel.showBox(state.box);
      this.drive.showBox(state.box);
    }
    this.drive.show(this.pointer.strength);
    this.options.show(state);
    const legend = JSON.stringify(this.scene.legend);
    if (legend !== this.legend) this.options.legend(this.scene.legend);
    this.legend = legend;
  }

  view(index: number): void {
    const { results, world } = this.driver.record;
    this.rig.view(index, outside(results, world));
  }

  focus(box = this.store.state.box): void {
    if (box === null) return;
    const { place, radius } = this.scene.placeOf(box);
    this.rig.focus(place, radius);
  }

  /** The picture at twice the size, with what it shows below it. */
  picture(): Promise<Blob> {
    const { world } = this.driver.record;
    return pictureOf(
      [this.scene.picture(2 * devicePixelRatio)],
      [`${world.layout}, live`],
      `${this.file.name}, ${seconds(this.store.state.time)}`,
    );
  }

  close(): void {
    this.closed = true;
    for (const quit of this.quit) quit();
    this.driver.pause();
    this.client.close();
    this.observer.disconnect();
    this.rig.detach();
    this.scene.dispose();
  }
}
