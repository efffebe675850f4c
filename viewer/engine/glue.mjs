// The native engine as WebAssembly, in a page, a worker or node: the same bits as the program. One thread; a worker that
// runs several worlds takes turns. `loadEngine` compiles it once and returns the functions of this file's `Engine`.
//
// Lengths are in metres, times in seconds, forces in newtons; the frame is that of the container: x along its length from
// the front wall to the door, y across, z up. What cannot be used is an `EngineError` with a sentence for the user.

const WASM_BASE64 = '@WASM@';

const NUMBERS_PER_BOX = 7;
const NUMBERS_PER_SEGMENT = 5;
/** Of `holdfast_layouts`: size, boxes, box_count, offsets, layout_count, names, masses, mats, box_names, containers. */
const LAYOUT_MEMBERS = 10;

/** What the user, or the calling program, has given that cannot be used. */
export class EngineError extends Error {}

function bytesOfBase64(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

const hexText = (number, digits) => number.toString(16).padStart(digits, '0');
/** state_hash: stateHash */
const memberName = (name) => name.replaceAll(/_(.)/g, (_, letter) => letter.toUpperCase());

/** A load as JSON, which begins with its name. */
const withoutName = (json) => json.replace(/^\{"name":"(?:[^"\\]|\\.)*",/, '{');

/** Compiles the engine. */
export async function loadEngine() {
  // Nothing of the system is there: what the C library could ask for fails, and only an abort gets here.
  const refused = () => 52; // ENOSYS
  const system = { proc_exit: (code) => { throw new Error(`the engine has ended with code ${code}`); } };
  const module = await WebAssembly.compile(bytesOfBase64(WASM_BASE64));
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    imports[from] ??= {};
    imports[from][name] = system[name] ?? (name === 'emscripten_notify_memory_growth' ? () => {} : refused);
  }
  const instance = await WebAssembly.instantiate(module, imports);
  instance.exports._initialize();
  return new Engine(instance.exports);
}

/** The engine: readers of inputs, whole worlds, and worlds that are taken forward in pieces. */
class Engine {
  /** @param {WebAssembly.Exports} wasm */
  constructor(wasm) {
    this.wasm = wasm;
    this.version = this.textAt(wasm.holdfast_version());
    const rows = this.textAt(wasm.page_outcome_rows()).trimEnd().split('\n').map((row) => row.split(' '));
    /** Types and names of what `screen` gives, in the order of its numbers. */
    this.outcomeFields = rows.filter(([kind]) => kind === 'field').map(([, type, name]) => [type, memberName(name)]);
    /** Names of the codes of a type. */
    this.names = {};
    for (const [type, code, name] of rows) if (type !== 'field') (this.names[type] ??= {})[code] = name;
  }

  /**
   * The boxes of a layout file's text: rows of seven numbers, two corners and a material, as `World` takes them.
   * @param {string} text
   * @param {object} [inputs] `config` and `settings`, as of `world`; `name` for messages
   */
  readLayout(text, inputs = {}) {
    return this.withSettings(inputs, (settings) =>
      this.withTexts([inputs.name ?? 'layout', text], ([name, from]) =>
        this.read(this.wasm.page_read_layout(settings, name, from))));
  }

  /** The segments of an acceleration file's text: rows of five numbers, start, duration and acceleration (m/s²). */
  readAcceleration(text, name = 'acceleration') {
    return this.withTexts([name, text], ([called, from]) => this.read(this.wasm.page_read_acceleration(called, from)));
  }

  /**
   * A world that is taken forward in pieces. Free it when it is no longer needed.
   * @param {object} inputs
   * @param {Float64Array} inputs.boxes rows of seven numbers, m
   * @param {Float64Array} inputs.segments rows of five numbers
   * @param {Float64Array} [inputs.masses] kg, one per box; not a number: by its material
   * @param {Float64Array} [inputs.mats] coefficients of friction of the mats beneath boxes; not a number: none
   * @param {string} [inputs.config] text of a config.ini
   * @param {[string, string, string][]} [inputs.settings] section, key and value, set after `config`
   */
  world(inputs) {
    return new World(this, inputs);
  }

  /** Simulates a world to its end as `holdfast screen` does: its verdict, counts and state hash. Inputs as of `world`. */
  screen(inputs) {
    return this.outcomeOf(this.withInputs(inputs, (...places) => this.read(this.wasm.page_screen(...places))));
  }

  // ---- Loads: what files of loads say, in the form of docs/start/loads.md. ----

  /** What there is to choose from: containers, norms, pairs of materials with their friction, known formats of files. */
  catalogue() {
    return JSON.parse(this.readText(this.wasm.page_catalogue()));
  }

  /**
   * What a run has: all settings as the results file has them, the container of loads that have none of their own, and the norm that
   * the settings name, with its accelerations.
   * @param {object} [inputs] `config` and `settings`, as of `world`; `container` for all loads, also before their own
   */
  run(inputs = {}) {
    return this.withSettings(inputs, (settings) =>
      this.withTexts([inputs.container ?? ''], ([container]) =>
        JSON.parse(this.readText(this.wasm.page_run(settings, container)))));
  }

  /**
   * All loads of a file of any form that the program reads, with what is said of the file and of each load, and each as
   * the program writes it.
   * @param {string | Uint8Array} content its text, or its bytes
   * @param {string} name of the file, for messages and names of loads
   * @param {object} [inputs] `config` and `settings`, as of `world`; `container`, `unit`, `axes`, `format` and `columns`, as
   *   the options of the program
   */
  readLoads(content, name, inputs = {}) {
    const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : content;
    const choices = ['container', 'unit', 'axes', 'format', 'columns'].map((choice) => inputs[choice] ?? '');
    const lines = this.withSettings(inputs, (settings) =>
      this.withContent(bytes, (at) =>
        this.withTexts([name, ...choices], (places) =>
          this.readText(this.wasm.page_read_loads(settings, at, bytes.length, ...places)))));
    const [file, ...rest] = lines.trimEnd().split('\n');
    const loads = [];
    for (let i = 0; i < rest.length; i += 2)
      loads.push({ ...JSON.parse(rest[i]), load: JSON.parse(rest[i + 1]), json: withoutName(rest[i + 1]) });
    return { ...JSON.parse(file), loads };
  }

  /** The first rows of a table: `line` in the text, from 1, and `cells`. */
  preview(bytes, rows) {
    return this.withContent(bytes, (at) => JSON.parse(this.readText(this.wasm.page_preview(at, bytes.length, rows))));
  }

  /**
   * Simulates a load to its end under an acceleration, as `holdfast screen` does.
   * @param {object} load as `readLoads` gives it
   * @param {number | Float64Array} acceleration of the norm that the settings name, from 0; or rows of five numbers
   * @param {object} inputs `config` and `settings`, as of `world`; `container` as of `run`
   * @param {boolean} [recorded] also give what the results file has of boxes and samples
   * @returns {{outcome: object, columns: Record<string, Float64Array>}}
   */
  screenLoad(load, acceleration, inputs, recorded = false) {
    const [ofNorm, segments] = typeof acceleration === 'number' ? [acceleration, []] : [0, acceleration];
    const { outcome, ...columns } = this.withLoad(load, inputs, (settings, container, text) =>
      this.withNumbers(segments, (at) => this.readColumns(this.wasm.page_screen_load(
        settings, container, text, ofNorm, at, segments.length / NUMBERS_PER_SEGMENT, recorded ? 1 : 0))));
    return { outcome: this.outcomeOf(outcome), columns };
  }

  /**
   * How many g a load stands, in the directions front, rear, left and right, as `holdfast margins` finds it.
   * @param {number} [direction] that is searched alone; all without
   */
  loadMargins(load, inputs, direction = -1) {
    return this.withLoad(load, inputs, (...places) => this.readColumns(this.wasm.page_load_margins(...places, direction)));
  }

  /** What rests on each box of a load, kg, at least and at most, as `holdfast check --bearing` finds it. */
  loadBearing(load, inputs) {
    return this.withLoad(load, inputs, (...places) => this.readColumns(this.wasm.page_load_bearing(...places)));
  }

  // ---- Between JavaScript and the memory of the engine, which moves when it grows: views are made anew. ----

  view() {
    return new DataView(this.wasm.memory.buffer);
  }

  textAt(at) {
    const bytes = new Uint8Array(this.wasm.memory.buffer);
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  }

  numbersAt(at, count) {
    return new Float64Array(this.wasm.memory.buffer, at, count).slice();
  }

  withBytes(size, work) {
    const at = this.wasm.malloc(Math.max(size, 1));
    if (at === 0) throw new EngineError('the engine has no memory left');
    try {
      return work(at);
    } finally {
      this.wasm.free(at);
    }
  }

  withNumbers(numbers, work) {
    return this.withBytes(8 * numbers.length, (at) => {
      new Float64Array(this.wasm.memory.buffer, at, numbers.length).set(numbers);
      return work(at);
    });
  }

  withContent(bytes, work) {
    return this.withBytes(bytes.length, (at) => {
      new Uint8Array(this.wasm.memory.buffer).set(bytes, at);
      return work(at);
    });
  }

  withTexts(texts, work, places = []) {
    if (texts.length === 0) return work(places);
    const bytes = new TextEncoder().encode(`${texts[0]}\0`);
    return this.withContent(bytes, (at) => this.withTexts(texts.slice(1), work, [...places, at]));
  }

  withSettings({ config = '', settings = [] }, work) {
    const handle = this.wasm.holdfast_settings_new();
    const check = (status) => {
      if (status !== 0) throw new EngineError(this.textAt(this.wasm.holdfast_settings_message(handle)));
    };
    try {
      if (config !== '') this.withTexts([config], ([text]) => check(this.wasm.holdfast_settings_read(handle, text)));
      for (const setting of settings)
        this.withTexts(setting, (places) => check(this.wasm.holdfast_settings_set(handle, ...places)));
      return work(handle);
    } finally {
      this.wasm.holdfast_settings_free(handle);
    }
  }

  withInputs(inputs, work) {
    const { boxes, segments } = inputs;
    return this.withSettings(inputs, (settings) =>
      this.withNumbers(boxes, (boxesAt) =>
        this.withNumbers(segments, (segmentsAt) =>
          work(settings, boxesAt, boxes.length / NUMBERS_PER_BOX, segmentsAt, segments.length / NUMBERS_PER_SEGMENT))));
  }

  /** One layout as `holdfast_layouts` has it, whose members have four bytes each here. */
  withLayout(boxes, boxCount, { masses = null, mats = null }, work) {
    const withOptional = (numbers, then) => (numbers === null ? then(0) : this.withNumbers(numbers, then));
    const size = 4 * LAYOUT_MEMBERS;
    return withOptional(masses, (massesAt) =>
      withOptional(mats, (matsAt) =>
        this.withBytes(size + 8, (at) => {
          const offsets = at + size;
          const members = [size, boxes, boxCount, offsets, 1, 0, massesAt, matsAt, 0, 0, 0, boxCount];
          for (const [i, member] of members.entries()) this.view().setUint32(at + 4 * i, member, true);
          return work(at);
        })));
  }

  withLoad(load, inputs, work) {
    const text = JSON.stringify({ holdfast: 1, loads: [load] });
    return this.withSettings(inputs, (settings) =>
      this.withTexts([inputs.container ?? '', text], (places) => work(settings, ...places)));
  }

  checkPage(status) {
    if (status !== 0) throw new EngineError(this.textAt(this.wasm.page_message()));
  }

  read(status) {
    this.checkPage(status);
    return this.numbersAt(this.wasm.page_numbers(), this.wasm.page_number_count());
  }

  readText(status) {
    this.checkPage(status);
    return this.textAt(this.wasm.page_text());
  }

  /** Columns of numbers by their names. */
  readColumns(status) {
    const numbers = this.read(status);
    let begin = 0;
    return Object.fromEntries(this.textAt(this.wasm.page_columns()).trimEnd().split('\n').map((row) => {
      const [name, count] = row.split(' ');
      return [name, numbers.subarray(begin, (begin += Number(count)))];
    }));
  }

  /** A world by the names of its fields. */
  outcomeOf(numbers) {
    const values = numbers.values();
    const next = () => values.next().value;
    const value = (type) => {
      if (type === 'hash') return hexText(next(), 8) + hexText(next(), 8);
      const number = next();
      return this.names[type]?.[number] ?? number;
    };
    return Object.fromEntries(this.outcomeFields.map(([type, name]) => [name, value(type)]));
  }
}

/** One layout under one acceleration, from time 0, after settling. */
class World {
  constructor(engine, inputs) {
    this.engine = engine;
    this.wasm = engine.wasm;
    this.boxCount = inputs.boxes.length / NUMBERS_PER_BOX;
    const metre = 0;
    engine.withInputs(inputs, (settings, boxes, boxCount, segments, segmentCount) =>
      engine.withLayout(boxes, boxCount, inputs, (layout) =>
        engine.withBytes(4, (at) => {
          const status = this.wasm.holdfast_world_new_of_layout(settings, layout, metre, segments, segmentCount, at);
          this.handle = engine.view().getUint32(at, true);
          try {
            this.check(status);
          } catch (error) {
            this.free();
            throw error;
          }
        })));
    /** The latest time at which the world ends, s: it has `RunOutSeconds` after its acceleration to come to rest. */
    this.endTime = this.times()[1];
  }

  /** Ends the world; it cannot be used afterwards. */
  free() {
    this.wasm.holdfast_world_free(this.handle);
    this.handle = 0;
  }

  /** The time that was asked for last, s. */
  get time() {
    return this.times()[0];
  }

  /** Takes the world forward until it has reached a time, s, or its end. */
  advance(time) {
    this.check(this.wasm.holdfast_world_advance(this.handle, time));
  }

  /** Where the boxes are: rows of seven numbers, the centre of mass (m) and the quaternion w x y z. */
  poses() {
    return this.rows(this.wasm.holdfast_world_poses, this.boxCount, 7);
  }

  /** How they move: rows of six numbers, velocity (m/s) and angular velocity (rad/s). */
  velocities() {
    return this.rows(this.wasm.holdfast_world_velocities, this.boxCount, 6);
  }

  /** Forces on floor, front, rear, left, right, roof, ground and fixed boxes (N), rows of three; with the setting WallForces. */
  sideForces() {
    return this.rows(this.wasm.holdfast_world_side_forces, 8, 3);
  }

  /** Of poses and velocities at the last step end, 16 hexadecimal digits as of `holdfast screen --json`. */
  stateHash() {
    return this.engine.withBytes(8, (at) => {
      this.check(this.wasm.holdfast_world_hash(this.handle, at));
      return hexText(this.engine.view().getBigUint64(at, true), 16);
    });
  }

  /** Gives the container a constant acceleration from now on, three numbers, m/s². */
  setAcceleration(acceleration) {
    this.engine.withNumbers(acceleration, (at) => this.check(this.wasm.holdfast_world_set_acceleration(this.handle, at)));
  }

  /** Sets the coefficients of friction of two boxes, of box and floor, of box and wall, from now on. */
  setFriction(boxBox, boxFloor, boxWall) {
    this.check(this.wasm.holdfast_world_set_friction(this.handle, boxBox, boxFloor, boxWall));
  }

  /** Pushes a box from now on, three numbers, N; at a point of the container frame that then goes with the box, or at its
   * centre of mass. Zero takes the force away. */
  setForce(box, force, point = null) {
    this.engine.withNumbers(force, (forceAt) => {
      const set = (pointAt) => this.check(this.wasm.holdfast_world_set_force(this.handle, box, forceAt, pointAt));
      if (point === null) set(0);
      else this.engine.withNumbers(point, set);
    });
  }

  times() {
    return this.engine.withBytes(16, (at) => {
      this.check(this.wasm.holdfast_world_times(this.handle, at, at + 8));
      return this.engine.numbersAt(at, 2);
    });
  }

  rows(fill, count, width) {
    return this.engine.withBytes(8 * count * width, (at) => {
      this.check(fill(this.handle, at, count));
      return this.engine.numbersAt(at, count * width);
    });
  }

  check(status) {
    if (status !== 0) throw new EngineError(this.engine.textAt(this.wasm.holdfast_world_message(this.handle)));
  }
}
