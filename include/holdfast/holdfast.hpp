#pragma once

/// holdfast: what becomes of a container loading when the container brakes, corners or changes lane.
///
/// A `Screen` is made once from settings and accelerations, and then evaluates layouts, thousands of times: arrays in,
/// verdicts out. It gives the same bits as `holdfast screen` does on the same layouts, whatever the number of threads,
/// the batch and the order.
///
///     holdfast::Screen screen(holdfast::ScreenOptions{.norm = "road"});
///     for (const holdfast::WorldOutcome& world : screen.evaluate(layouts))
///       if (world.verdict != holdfast::Verdict::stayed) reject(layouts[world.layout]);
///
/// Frame: that of the container, right-handed; x along its length from the front wall to the door, y across, z up; the
/// origin is the lower corner at the front wall with the smallest coordinates. SI units throughout, unless stated.
///
/// Compatibility: versions follow semantic versioning. A minor version may add functions, and changes neither functions
/// nor types that are declared here; a major version may. Types that cross the border are from the C++ standard
/// library, so that program and library must be built with the same one. Bits of results may change with a minor
/// version; the changelog says so.

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <holdfast/outcomes.hpp>

/// Version of this header, for the preprocessor: 10000 * major + 100 * minor + patch.
#define HOLDFAST_VERSION 20000

#if defined(__GNUC__)
#define HOLDFAST_API __attribute__((visibility("default")))
#define HOLDFAST_LOCAL __attribute__((visibility("hidden")))
#else
#define HOLDFAST_API
#define HOLDFAST_LOCAL
#endif

namespace holdfast::internal {
struct ScreenCloser;
}  // namespace holdfast::internal

namespace holdfast {

/// Version of the library that is linked, such as "2.0.0". May be called from any thread.
HOLDFAST_API const char* version() noexcept;

/// One thing that is wrong with an input, in the parts that a message needs. Text that does not apply is empty, a place
/// in a file 0, an index -1.
struct Problem {
  std::string file;            ///< path of the file, or name of the layout or acceleration
  long line = 0;               ///< in the file, from 1
  long column = 0;             ///< in the line, from 1
  std::string what;            ///< what is wrong
  std::string value;           ///< the offending value
  std::string accepted;        ///< what would be accepted
  std::string message;         ///< all of it in one line: `file:line:column: what: value; accepted`
  std::ptrdiff_t layout = -1;  ///< index into the layouts of the call
  std::ptrdiff_t box = -1;     ///< index into the boxes of that layout
  int box_column = -1;         ///< index into that box's seven numbers, as in `LayoutView`
};

/// The one exception that the library throws: input that cannot be used, a file that cannot be written, memory that has
/// run out.
class HOLDFAST_API Error : public std::exception {
 public:
  explicit Error(std::vector<Problem> problems);
  ~Error() override;
  Error(const Error&);
  Error& operator=(const Error&);

  /// The message of the first problem, and how many more there are.
  const char* what() const noexcept override;

  /// All problems, in the order of the input; never empty.
  const std::vector<Problem>& problems() const noexcept { return problems_; }

 private:
  std::vector<Problem> problems_;
  std::string text_;
};

/// Unit of the lengths of layouts.
enum class LengthUnit : std::uint8_t { metre, centimetre };

/// A box of a layout as it is loaded, its edges along the axes of the container. What is absent is as its material and
/// the settings say (docs/start/loads.md). Lengths are in the unit of its layout.
struct Box {
  std::array<double, 3> corner_min = {};  ///< corner with the smallest coordinates
  std::array<double, 3> corner_max = {};  ///< corner with the largest coordinates
  int material = 0;                       ///< id, from 0; `[Material N]` of the settings says what it means
  std::string material_name = {};         ///< in place of the id where it is not empty: `[Material pallet]`
  std::string name = {};                  ///< shown in messages and results; up to 120 bytes of UTF-8 are kept
  std::optional<double> mass = {};        ///< kg, from 1e-6 to 1e6
  std::optional<std::array<double, 3>> centre_of_mass = {};  ///< offset from the middle of the box
  /// Coefficient of friction on whatever the box stands on, of an anti-slip mat beneath it, from 0.
  std::optional<double> mat = {};
  bool fixed = false;                        ///< part of the container
  std::optional<std::int64_t> order = {};    ///< when it is loaded; absent: in the order of the boxes
  std::optional<double> bearing_limit = {};  ///< most that may rest on it, kg
};

/// A wall that is lower than the container: a drop side, over which boxes may tip.
struct DropSide {
  std::string side;     ///< "front", "rear", "left" or "right"
  double height = 0.0;  ///< above the floor, in the unit of the layout
};

/// The container of a layout. What is absent is as the type says, or, without a type, as the settings do. Lengths are
/// in the unit of the layout.
struct Container {
  std::string type = {};  ///< name of one of `container_types`, such as "40hc"; empty: none of them
  std::optional<std::array<double, 3>> size = {};  ///< inner length, width and height
  std::optional<std::vector<std::string>> open_sides =
      {};                                                ///< without a wall: "front", "rear", "left", "right", "roof"
  std::optional<std::vector<DropSide>> drop_sides = {};  ///< walls that are lower than the container
  std::optional<double> bed_height = {};                 ///< of the floor above the ground; 0: a floor without end
};

/// A candidate loading. Boxes may touch; they overlap each other, or protrude from the container, by 0.1 mm at most.
struct Layout {
  std::string name;  ///< labels results and messages; need not be unique; empty: `layout` and its index in the call
  std::vector<Box> boxes;
  std::optional<Container> container = {};  ///< its own; absent: that of the settings
  std::optional<LengthUnit> unit = {};      ///< of all its lengths; absent: that of the screen or world
};

/// The same in memory of the caller, which is read where it is: rows of seven numbers, one row per box. They are x, y,
/// z of the corner with the smallest coordinates, x, y, z of that with the largest, and the material, a whole number.
struct LayoutView {
  std::string_view name;            ///< as in `Layout`
  std::span<const double> numbers;  ///< seven times as many as there are boxes
  /// What is wrong with the layout, if no numbers could be had for it; it is then a bad one, see `BadLayouts`.
  const Problem* problem = nullptr;
  std::span<const double> masses = {};          ///< kg, one per box; not a number: by its material; or empty
  std::span<const double> mats = {};            ///< as `Box::mat`, one per box; not a number: none; or empty
  std::span<const char* const> box_names = {};  ///< one per box, ends with a zero byte; null: none; or empty
  std::string_view container = {};              ///< type, as `Container::type`; empty: that of the settings
  std::optional<LengthUnit> unit = {};          ///< as in `Layout`
  /// A layout to take in place of all that is above but the name, so that a call may mix both; or null.
  const Layout* layout = nullptr;
};

/// A type of container, vehicle body or pallet (docs/reference/containers.md).
struct ContainerType {
  std::string name;                     ///< as `Container::type` takes it
  std::string sentence;                 ///< what it is
  std::array<double, 3> size = {};      ///< inner length, width and height, m
  double payload = 0.0;                 ///< kg
  std::vector<std::string> open_sides;  ///< as `Container::open_sides`
  double bed_height = 0.0;              ///< of the floor above the ground, m
};

/// The types of containers that are known by name. May be called from any thread.
HOLDFAST_API std::vector<ContainerType> container_types();

/// How a file of loads is read, where it does not say it itself; as the options of `holdfast check`
/// (docs/start/loads.md).
struct LoadFileOptions {
  std::optional<std::string> unit = {};       ///< of lengths: "m", "dm", "cm", "mm", "in" or "ft"
  std::optional<std::string> axes = {};       ///< such as "-z x y": those of the file that are length, width, height
  std::optional<std::string> format = {};     ///< a known format of tables, such as "planner"
  std::optional<std::string> columns = {};    ///< words of a header and what they mean, such as "Artikel = name"
  std::optional<std::string> container = {};  ///< type that all loads get, whatever the file says
  std::string config = {};                    ///< text of a config.ini: [Loads], [Container], materials; may be empty
};

/// Reads all loads of a file: StableCargo's text, a table, or JSON. Lengths of the layouts are metres. A load without a
/// container of its own is checked in that of `options.config`. Throws `Error` with everything that is wrong with any
/// load. May be called from any thread.
/// @param notes gets what is to be known though all can be used: items without a place, overlaps that were trimmed; or
///              null
HOLDFAST_API std::vector<Layout> read_loads(const std::string& path, const LoadFileOptions& options = {},
                                            std::vector<Problem>* notes = nullptr);

/// The same of the text of a file.
/// @param name of the file, for messages and names of the loads
HOLDFAST_API std::vector<Layout> parse_loads(const std::string& text, const std::string& name,
                                             const LoadFileOptions& options = {},
                                             std::vector<Problem>* notes = nullptr);

/// A stretch of time in which the container has one acceleration.
struct Segment {
  double start = 0.0;                       ///< s, from the beginning of the simulated time
  double duration = 0.0;                    ///< s, positive
  std::array<double, 3> acceleration = {};  ///< of the container, m/s²; a vehicle that brakes has +x
};

/// What the container does: segments by rising time, without overlap; between and after them it has no acceleration.
struct Acceleration {
  std::string name;  ///< labels results and messages; need not be unique
  std::vector<Segment> segments;
  /// What a norm states it for alone, "sliding" or "tipping"; else empty. Worlds under such a one never end early.
  std::string purpose = {};
};

/// Reads an acceleration file: a header line, then one segment per line, `start duration x y z`.
/// Throws `Error`. May be called from any thread.
HOLDFAST_API Acceleration read_acceleration(const std::string& path);

/// The accelerations of a norm, such as "road" or "eumos-40509:0.5" (docs/reference/norms.md). Throws `Error`, which
/// says what is accepted. May be called from any thread.
HOLDFAST_API std::vector<Acceleration> norm_accelerations(const std::string& name);

/// What `evaluate` and `record` do with a layout that cannot be used.
enum class BadLayouts : std::uint8_t {
  raise,  ///< `evaluate` throws an `Error` with every problem of every layout, before anything is simulated
  mark,   ///< its worlds have `status::bad_layout` and a message; the others are simulated
};

/// A key of config.ini and its value, such as {"Native", "Accuracy", "screening"} or {"Material 3", "Density", "300"}.
struct Setting {
  std::string section, key, value;
};

/// The keys that the text of a config.ini gives (docs/reference/config.md), in the order of that page. Throws `Error`
/// with every mistake, by line and column. May be called from any thread.
HOLDFAST_API std::vector<Setting> read_settings(const std::string& text);

/// How a `Screen` works. What is absent is as `config` says.
struct ScreenOptions {
  std::string config = {};             ///< text of a config.ini, see docs/reference/config.md; empty: all defaults
  std::vector<Setting> settings = {};  ///< keys that are set after `config`, in this order
  /// Name of a norm whose accelerations the screen has before those that it is given, such as "road"
  /// (docs/reference/norms.md); "": none.
  std::optional<std::string> norm = {};
  std::optional<std::string> engine = {};    ///< such as "native"; see `engines`
  std::optional<std::string> accuracy = {};  ///< of the native engine: "screening", "standard", "reference"
  /// Ends a world when its verdict is decided: "moved", as soon as a box is beyond any limit; "fallen", as soon as one
  /// has fallen; "end", never. Its verdict is then at least what it says; whether a world stayed never depends on this.
  std::optional<std::string> stop_when = {};
  std::optional<std::string> scheduler = {};  ///< "tbb", "openmp" or "serial"; never changes a result
  std::optional<int> threads = {};            ///< worlds that are simulated at the same time; 0: one per core
  /// Leaves the worlds of a layout out once one of them neither stayed nor failed to be simulated: they are
  /// `Verdict::not_needed`. In a call the accelerations that failed most layouts come first; a layout that is submitted
  /// takes them in their order.
  std::optional<bool> first_failure = {};
  LengthUnit unit = LengthUnit::metre;  ///< of layouts that have none of their own; layout files have centimetres
  BadLayouts bad_layouts = BadLayouts::raise;
  bool keep_boxes = false;         ///< fill `WorldOutcome::box_outcomes`
  bool keep_series = false;        ///< fill `WorldOutcome::series`
  std::size_t most_in_flight = 0;  ///< layouts that `submit` takes before `poll` gives one back; 0: 16 per thread
  /// Called whenever a submitted layout is finished, on a thread of the screen, so that the program need not wait in
  /// `poll`: it may write into a pipe or wake a loop of events. It returns soon, throws nothing and calls no function
  /// of the screen. May be empty.
  std::function<void()> on_finished = {};
};

/// How `Screen::record` treats its file.
struct RecordOptions {
  bool series = true;             ///< write time series too
  bool resume = false;            ///< continue a run of the same layouts that was stopped or killed
  bool overwrite = false;         ///< replace the results of an earlier run; not together with `resume`
  std::string command_line = {};  ///< noted in the file; may be empty
};

/// A submitted layout that is finished.
struct FinishedLayout {
  std::uint64_t ticket = 0;          ///< what `Screen::submit` gave
  std::vector<WorldOutcome> worlds;  ///< one per acceleration; `WorldOutcome::layout` is the ticket
};

/// Which finished layout `Screen::poll` gives.
enum class PollOrder : std::uint8_t {
  as_finished,   ///< the one that was finished first
  as_submitted,  ///< the one that was submitted first, and none before it is finished
};

/// What analyses find of a world beside the verdict, in the order of `WorldOutcome::numbers`. May be called from any
/// thread.
HOLDFAST_API std::vector<AnalysisNumber> analysis_numbers();

/// Evaluates layouts under a set of accelerations.
///
/// Construction reads the settings, loads the engine and may throw `Error`; it starts no thread. A screen may be used
/// by one thread at a time, and only `cancel` may be called by others meanwhile. Screens are independent of each other.
/// An object that was moved from may only be destroyed or assigned to. In a process that was forked, a screen of the
/// parent has nothing in flight; `evaluate` and `record` then work on one thread, if the parent has used several.
class HOLDFAST_API Screen {
 public:
  /// @param accelerations at least one, unless there is a norm; a bad one is an `Error`
  explicit Screen(std::vector<Acceleration> accelerations, const ScreenOptions& options = {});
  /// A screen that its norm and `add_acceleration` give its accelerations.
  explicit Screen(const ScreenOptions& options);
  /// Drops what is in flight and waits until all threads have let go of it.
  ~Screen();
  Screen(Screen&&) noexcept;
  Screen& operator=(Screen&&) noexcept;

  /// Adds an acceleration, the last one of `accelerations`. Throws `Error`, also while layouts are in flight.
  void add_acceleration(Acceleration acceleration);

  /// Reads a layout file by the settings of this screen: a header line, then one box per line. Its boxes are in the
  /// unit of this screen. Throws `Error`.
  Layout read_layout(const std::string& path) const;

  /// Every layout under every acceleration: one world each, layout by layout, acceleration fastest. Layouts need to
  /// live until the call returns. Throws `Error`; worlds that are lost to `cancel` have `StopReason::not_run`.
  std::vector<WorldOutcome> evaluate(std::span<const Layout> layouts);

  std::vector<WorldOutcome> evaluate(std::initializer_list<Layout> layouts) {
    return evaluate(std::span<const Layout>(layouts.begin(), layouts.size()));
  }

  /// The same into memory of the caller, whose capacity is used again.
  void evaluate(std::span<const Layout> layouts, std::vector<WorldOutcome>& worlds);

  /// The same of layouts in memory of the caller.
  void evaluate(std::span<const LayoutView> layouts, std::vector<WorldOutcome>& worlds);

  /// Whether each layout stays under every acceleration: all of its worlds are `Verdict::stayed`. The same answer as of
  /// `evaluate`, sooner: a world ends when its verdict is decided, and a layout with the first world that rejects it.
  /// False too for a layout that cannot be used, and after `cancel`. Throws `Error`.
  std::vector<bool> holds(std::span<const Layout> layouts);
  std::vector<bool> holds(std::span<const LayoutView> layouts);
  std::vector<bool> holds(std::initializer_list<Layout> layouts) {
    return holds(std::span<const Layout>(layouts.begin(), layouts.size()));
  }

  /// How many g each layout stands, one entry per layout; the accelerations of the screen play no part. Throws `Error`,
  /// also where the engine cannot: native can.
  std::vector<LayoutMargins> margins(std::span<const Layout> layouts);
  std::vector<LayoutMargins> margins(std::span<const LayoutView> layouts);
  std::vector<LayoutMargins> margins(std::initializer_list<Layout> layouts) {
    return margins(std::span<const Layout>(layouts.begin(), layouts.size()));
  }

  /// What geometry alone says of each layout; nothing is simulated, and the accelerations play no part. Numbers are not
  /// numbers where `BadLayouts::mark` lets a layout pass that cannot be used. Throws `Error`.
  std::vector<LayoutIndicators> indicators(std::span<const Layout> layouts);
  std::vector<LayoutIndicators> indicators(std::span<const LayoutView> layouts);
  std::vector<LayoutIndicators> indicators(std::initializer_list<Layout> layouts) {
    return indicators(std::span<const Layout>(layouts.begin(), layouts.size()));
  }

  /// The same as `evaluate` into a results file, as `holdfast screen` writes it, with everything that a later analysis
  /// needs. What is finished survives whatever ends the process. Throws `Error`, also when the file exists and
  /// `options` do not say what to do with it.
  /// @return false when `cancel` ended it: the finished worlds are kept for `RecordOptions::resume`
  bool record(std::span<const Layout> layouts, const std::string& path, const RecordOptions& options = {});
  bool record(std::span<const LayoutView> layouts, const std::string& path, const RecordOptions& options = {});

  /// Hands a layout over, and returns while it is evaluated on threads of the screen. Layouts of one screen, and those
  /// of a call of `evaluate` meanwhile, share nothing: results are the same as of `evaluate`. Throws `Error`, and then
  /// nothing is handed over.
  /// @return the ticket by which `poll` names it, counted from 0; nothing when `ScreenOptions::most_in_flight` layouts
  ///         are in flight, which are those handed over that `poll` has not given back
  std::optional<std::uint64_t> submit(const Layout& layout);
  std::optional<std::uint64_t> submit(const LayoutView& layout);

  /// Gives a finished layout back, whose memory is used again. Throws `Error` where memory ran out in the evaluation of
  /// the layout that `finished` names then, which is no longer in flight.
  /// @param seconds how long to wait for one, at most
  /// @return false when there is none: none in flight, or none finished in time
  bool poll(FinishedLayout& finished, double seconds = 0.0, PollOrder order = PollOrder::as_finished);

  /// Number of layouts that were submitted and that `poll` has not given back.
  std::size_t in_flight() const noexcept;

  /// Ends the running call early, and all layouts in flight: their unfinished worlds have `StopReason::not_run`. May be
  /// called from any thread; without a running call and layouts in flight it does nothing.
  void cancel() noexcept;

  /// Whether `cancel` has ended the last call of `evaluate`, `holds` or `margins`.
  bool cancelled() const noexcept;

  /// What is wrong with the layouts of the last call of `evaluate`, `record` or `submit`, with `BadLayouts::mark`; at
  /// most some twenty per layout. Valid until the next call.
  std::span<const Problem> problems() const noexcept;

  /// The accelerations of the screen: those of its norm, and those that it was given.
  std::span<const Acceleration> accelerations() const noexcept;

 private:
  friend struct internal::ScreenCloser;
  struct HOLDFAST_LOCAL State;
  std::unique_ptr<State> state_;
};

/// Where a box is.
struct Pose {
  std::array<double, 3> position = {};               ///< of the centre of mass, m
  std::array<double, 4> orientation = {1, 0, 0, 0};  ///< quaternion w x y z, container from body
};

/// How a box moves.
struct Velocity {
  std::array<double, 3> linear = {};   ///< of the centre of mass, m/s
  std::array<double, 3> angular = {};  ///< container frame, rad/s
};

/// One layout under one acceleration, taken forward as far as the caller wants: for pictures, and for analyses of one's
/// own. It needs neither files nor threads, never ends early and is part of `holdfast::core` too, which has the engines
/// that are no plug-ins. Objects are independent of each other; one is used by one thread at a time. At the end its
/// hash is that of the same world of a `Screen`, unless a `set_` function has changed what acts on it.
class HOLDFAST_API World {
 public:
  /// Throws `Error` when a setting, the layout or the acceleration cannot be used.
  /// @param unit of a layout that has none of its own
  World(const Layout& layout, const Acceleration& acceleration, std::span<const Setting> settings = {},
        LengthUnit unit = LengthUnit::metre);
  World(const LayoutView& layout, const Acceleration& acceleration, std::span<const Setting> settings = {},
        LengthUnit unit = LengthUnit::metre);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Takes the world forward until it has reached `time`, s, or its end. Times that have passed change nothing.
  void advance(double time);

  /// The time that `advance` was asked for last, or the end, s. It starts at 0, after settling.
  double time() const noexcept;
  /// Time at which the world ends, s.
  double end_time() const noexcept;

  /// Where the boxes are at `time()`, in the order of the layout: interpolated between the steps around it.
  std::vector<Pose> poses() const;

  /// How the boxes move at `time()`, in the order of the layout: interpolated as `poses`.
  std::vector<Velocity> velocities() const;

  /// The `set_` functions change what acts on the boxes from now on: from the end of the step that `time()` is in, or,
  /// where nothing moves, from `time()` itself. All boxes are awake then. They throw `Error`, and change nothing, where
  /// a number cannot be used; after `end_time()` they have no effect.

  /// Gives the container a constant acceleration, container frame, m/s², in place of what is left of that which the
  /// world was made with. The world ends when it would have ended ([Simulation Settings] Timeout).
  void set_acceleration(const std::array<double, 3>& acceleration);

  /// Sets the coefficients of static friction of two boxes, of box and floor, and of box and wall or roof, whatever the
  /// settings and materials say; the share that is kinetic stays. For the engine native.
  void set_friction(double box_box, double box_floor, double box_wall);

  /// Pushes a box with a force, container frame, N, until it is set again; zero takes it away. A box has one force. For
  /// the engine native.
  /// @param box   index into the boxes of the layout
  /// @param point where it acts, container frame at `time()`, m; from then on it goes with the box. Absent: the centre
  ///              of mass
  void set_force(std::size_t box, const std::array<double, 3>& force,
                 const std::optional<std::array<double, 3>>& point = {});

  /// Forces of the boxes on floor, front, rear, left, right, roof, ground and the fixed boxes together, mean over the
  /// last step, container frame, N; before the first one, of the load as it has settled. Empty without the setting
  /// `WallForces` or `Walls`, or where the engine does not measure them.
  std::vector<std::array<double, 3>> side_forces() const;

  /// Of poses and velocities at the last step end: equal bits, equal hash.
  std::uint64_t state_hash() const;

 private:
  struct HOLDFAST_LOCAL State;
  std::unique_ptr<State> state_;
};

/// An engine that moves boxes.
struct EngineInfo {
  std::string name;      ///< as `ScreenOptions::engine` takes it
  std::string sentence;  ///< what it is
  std::string missing;   ///< why it cannot be used here; empty when it can
};

/// All engines that this build knows, the default first. Loads their plug-ins. May be called from any thread.
HOLDFAST_API std::vector<EngineInfo> engines();

}  // namespace holdfast
