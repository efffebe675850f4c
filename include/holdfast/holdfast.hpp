#pragma once

/// holdfast: what becomes of a container loading when the container brakes, corners or changes lane.
///
/// A `Screen` is made once from settings and accelerations, and then evaluates layouts, thousands of times: arrays in,
/// verdicts out. It gives the same bits as `holdfast screen` does on the same layouts, whatever the number of threads,
/// the batch and the order.
///
///     holdfast::Screen screen({.norm = "road"});
///     for (const holdfast::WorldOutcome& world : screen.evaluate(layouts))
///       if (world.verdict != holdfast::Verdict::stayed) reject(layouts[world.layout]);
///
/// Frame: that of the container, right-handed; x along its length from the front wall to the door, y across, z up; the
/// origin is the lower corner at the front wall with the smallest coordinates. SI units throughout, unless stated.
///
/// Compatibility: versions follow semantic versioning. Before 1.0 a minor version may change what is declared here, and
/// a patch version may not; from 1.0 on only a major version may. Types that cross the border are from the C++ standard
/// library, so that program and library must be built with the same one. Bits of results may change with a minor
/// version; the changelog says so.

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Version of this header, for the preprocessor: 10000 * major + 100 * minor + patch.
#define HOLDFAST_VERSION 200

#if defined(__GNUC__)
#define HOLDFAST_API __attribute__((visibility("default")))
#define HOLDFAST_LOCAL __attribute__((visibility("hidden")))
#else
#define HOLDFAST_API
#define HOLDFAST_LOCAL
#endif

namespace holdfast {

/// Version of the library that is linked, such as "0.2.0". May be called from any thread.
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

/// A box of a layout as it is loaded, its edges along the axes of the container.
struct Box {
  std::array<double, 3> corner_min = {};  ///< corner with the smallest coordinates, in `ScreenOptions::unit`
  std::array<double, 3> corner_max = {};  ///< corner with the largest coordinates, in `ScreenOptions::unit`
  int material = 0;                       ///< id, from 0; `[Material N]` of the settings says what it means
};

/// A candidate loading. Boxes may touch; they overlap each other, or protrude from the container, by 0.1 mm at most.
struct Layout {
  std::string name;  ///< labels results and messages; need not be unique; empty: `layout` and its index in the call
  std::vector<Box> boxes;
};

/// The same in memory of the caller: rows of seven numbers, one row per box. They are x, y, z of the corner with the
/// smallest coordinates, x, y, z of that with the largest, and the material, a whole number.
struct LayoutView {
  std::string_view name;            ///< as in `Layout`
  std::span<const double> numbers;  ///< seven times as many as there are boxes
  /// What is wrong with the layout, if no numbers could be had for it; it is then a bad one, see `BadLayouts`.
  const Problem* problem = nullptr;
};

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
};

/// Reads an acceleration file: a header line, then one segment per line, `start duration x y z`.
/// Throws `Error`. May be called from any thread.
HOLDFAST_API Acceleration read_acceleration(const std::string& path);

/// The accelerations of a norm, such as "road" or "eumos-40509:0.5" (docs/norms.md). Throws `Error`, which says what is
/// accepted. May be called from any thread.
HOLDFAST_API std::vector<Acceleration> norm_accelerations(const std::string& name);

/// What became of a world as a whole, by the worst that happened in it.
enum class Verdict : std::uint8_t {
  stayed = 0,      ///< no box fell, moved or tilted, nor was any unstable
  moved = 1,       ///< a box moved or tilted at the end, and none fell
  fell = 2,        ///< a box had fallen at the end
  unstable = 3,    ///< a box fell or moved while settling, before any acceleration, and all stayed since
  failed = 4,      ///< `WorldOutcome::status` is not 0: nothing can be said
  gave_way = 5,    ///< with `ScreenOptions::stop_when`: a box left its place, and the world ended there
  not_needed = 6,  ///< with `ScreenOptions::first_failure`: the layout failed another acceleration; not simulated
};

/// Bits of `WorldOutcome::status`: what went wrong with a world.
namespace status {
enum Bit : std::uint32_t {
  ok = 0,
  bad_layout = 1,        ///< the layout cannot be used; not simulated
  bad_acceleration = 2,  ///< the acceleration cannot be used; not simulated
  non_finite = 4,        ///< a state became infinite or undefined
  not_converged = 8,     ///< the solver's residual stayed above its bound
  capacity = 16,         ///< a device had no room for all contacts, or failed
  too_large = 32,        ///< its series would take too much memory; not simulated
  not_needed = 64,       ///< with `ScreenOptions::first_failure`: no problem, see `Verdict::not_needed`
};
}  // namespace status

/// Why a world ended.
enum class StopReason : std::uint8_t {
  not_run = 0,   ///< it was not simulated: a bad input, or `Screen::cancel`
  timeout = 1,   ///< the simulated time was up
  sleeping = 2,  ///< all boxes had come to rest
  failed = 3,    ///< the status says why
  decided = 4,   ///< with `ScreenOptions::stop_when`: the verdict is `Verdict::gave_way`
};

/// How one box ended. The reference pose is that of the layout, or by `ReferencePose` the one after settling.
struct BoxOutcome {
  std::array<float, 3> displacement = {};  ///< of the centre of mass, from the reference pose, at the end, m
  float tilt = 0;                          ///< angle of the rotation from the reference pose, at the end, degrees
  float kinetic_energy = 0;                ///< at the end, J
  float peak_displacement = 0;             ///< largest over all steps, m
  float peak_kinetic_energy = 0;           ///< largest over all steps, J
  bool fallen = false;                     ///< its centre of mass sank by more than `DropThreshold`
  bool moved = false;                      ///< displaced by more than `MoveThreshold`
  bool tilted = false;                     ///< rotated by more than `TiltThreshold`
  bool unstable = false;                   ///< fell or moved while settling
};

/// Time series of a world, one sample every `ResultsIntervalInSeconds`, and at the end. Columns of boxes hold sample
/// after sample: entry = sample * number of boxes + box.
struct Series {
  std::vector<double> time;                            ///< one per sample, s
  std::vector<std::array<float, 3>> displacement;      ///< per sample and box, of the centre of mass, m
  std::vector<std::array<float, 4>> orientation;       ///< per sample and box, quaternion w x y z, container from body
  std::vector<std::array<float, 3>> angular_velocity;  ///< per sample and box, rad/s
};

/// What the boxes did to a side of the container: docs/walls.md. Forces are outwards.
struct WallForce {
  double peak_force = 0;                  ///< largest mean over a step, N
  double peak_time = 0;                   ///< start of that step, s
  std::array<double, 3> peak_point = {};  ///< centre of pressure then, m; not a number where nothing presses
  double lasting_force = 0;               ///< largest mean over 0.05 s, N
  double limit = 0;                       ///< test force of the norm `Walls`, N; not a number where there is none
  std::array<double, 3> impulse = {};     ///< from t = 0 to the end, N s
};

/// What the replicas of a world say of it.
enum class ReplicaVerdict : std::uint8_t {
  none = 0,       ///< there are no replicas
  holds = 1,      ///< the share that fails is surely below 1/8
  fails = 2,      ///< it is surely above 1/2
  uncertain = 3,  ///< neither
};

/// What became of the replicas of a world, with [Screening] Replicas: docs/confidence.md.
struct ReplicaOutcome {
  ReplicaVerdict verdict = ReplicaVerdict::none;
  std::uint32_t count = 0;   ///< of the replicas whose end is known
  std::uint32_t failed = 0;  ///< of these, those in which a box fell, moved or tilted, or was unstable
  double share = 0;          ///< failed / count; not a number without replicas, as the next two
  double wilson_low = 0;     ///< ends of the interval in which the share is at 95 %
  double wilson_high = 0;
  double cpu_seconds = 0;        ///< processor time for all of them, s
  std::vector<float> box_share;  ///< per box, share of the replicas in which it did, with `ScreenOptions::keep_boxes`
};

/// What became of a world: one layout under one acceleration.
struct WorldOutcome {
  std::size_t layout = 0;        ///< index into the layouts of the call
  std::size_t acceleration = 0;  ///< index into the accelerations of the screen
  Verdict verdict = Verdict::failed;
  std::uint32_t status = status::ok;  ///< bits, see `status`
  std::string message;                ///< what the status means here, and what to do; empty when it is `ok`
  StopReason stop_reason = StopReason::not_run;
  std::uint32_t boxes = 0;   ///< number of boxes; 0 in a world that was not simulated, as are all that follow
  std::uint32_t fallen = 0;  ///< number of boxes, as are the next three
  std::uint32_t moved = 0;
  std::uint32_t tilted = 0;
  std::uint32_t unstable = 0;
  float max_displacement = 0;            ///< largest of all boxes at the end, m
  float peak_displacement = 0;           ///< largest of all boxes and steps, m
  double total_kinetic_energy = 0;       ///< at the end, J
  double peak_kinetic_energy = 0;        ///< of all boxes together, largest over all steps, J
  double end_time = 0;                   ///< s
  std::uint64_t steps = 0;               ///< steps that the simulated time was cut into
  std::uint64_t steps_skipped = 0;       ///< of these, those in which nothing moves, which are not computed
  double max_residual = 0;               ///< change of a contact velocity in a last iteration, worst step, m/s
  double residual_scale = 0;             ///< velocity that the effective gravity adds in that step, m/s
  double max_penetration = 0;            ///< deepest overlap of any step, m; 0 where the engine does not measure it
  double cpu_seconds = 0;                ///< processor time of building and simulating, s
  std::uint64_t state_hash = 0;          ///< of the final poses and velocities: equal bits, equal hash
  std::vector<BoxOutcome> box_outcomes;  ///< one per box with `ScreenOptions::keep_boxes`, else empty
  /// Of floor, front, rear, left, right, roof; with `WallForces` or `Walls` of [Screening], else empty.
  std::vector<WallForce> walls;
  Series series;  ///< with `ScreenOptions::keep_series`, else empty
  ReplicaOutcome replicas;
};

/// How many g a layout stands: docs/margins.md. Entries are for the load pushed to the front, the rear, the left and
/// the right.
struct LayoutMargins {
  /// Largest constant acceleration under which all boxes come to rest displaced by less than 5 mm, up to 1.5 g;
  /// negative where the layout does not stand under gravity alone, not a number where `Screen::cancel` came before.
  std::array<double, 4> margin = {};
  /// Index of the box that goes first above the margin; -1: none up to 1.5 g.
  std::array<std::ptrdiff_t, 4> critical_box = {-1, -1, -1, -1};
  std::uint32_t trials = 0;  ///< accelerations that were tried
  double cpu_seconds = 0;    ///< processor time, s
};

/// Unit of the corners of boxes.
enum class LengthUnit : std::uint8_t { metre, centimetre };

/// What `evaluate` and `record` do with a layout that cannot be used.
enum class BadLayouts : std::uint8_t {
  raise,  ///< `evaluate` throws an `Error` with every problem of every layout, before anything is simulated
  mark,   ///< its worlds have `status::bad_layout` and a message; the others are simulated
};

/// A key of config.ini and its value, such as {"Native", "Accuracy", "screening"} or {"Material 3", "Density", "300"}.
struct Setting {
  std::string section, key, value;
};

/// The keys that the text of a config.ini gives (docs/config.md), in the order of that page. Throws `Error` with every
/// mistake, by line and column. May be called from any thread.
HOLDFAST_API std::vector<Setting> read_settings(const std::string& text);

/// How a `Screen` works. What is absent is as `config` says.
struct ScreenOptions {
  std::string config;             ///< text of a config.ini, see docs/config.md; empty: all defaults
  std::vector<Setting> settings;  ///< keys that are set after `config`, in this order
  /// Name of a norm whose accelerations the screen has before those that it is given, such as "road"
  /// (docs/norms.md); "": none.
  std::optional<std::string> norm;
  std::optional<std::string> engine;    ///< such as "native"; see `engines`
  std::optional<std::string> accuracy;  ///< of the native engine: "screening", "standard", "reference"
  /// Ends a world early: "moved", as soon as a box is beyond any threshold; "fallen", as soon as one has fallen; "end",
  /// never. Such a world is `Verdict::gave_way`, since its boxes may come back: no other verdict depends on this.
  std::optional<std::string> stop_when;
  std::optional<std::string> scheduler;  ///< "tbb", "openmp" or "serial"; never changes a result
  std::optional<int> threads;            ///< worlds that are simulated at the same time; 0: one per core
  /// Leaves the worlds of a layout out once one of them neither stayed nor failed to be simulated: they are
  /// `Verdict::not_needed`. In a call the accelerations that failed most layouts come first; a layout that is submitted
  /// takes them in their order.
  std::optional<bool> first_failure;
  LengthUnit unit = LengthUnit::metre;  ///< of the corners of boxes; layout files have centimetres
  BadLayouts bad_layouts = BadLayouts::raise;
  bool keep_boxes = false;         ///< fill `WorldOutcome::box_outcomes`
  bool keep_series = false;        ///< fill `WorldOutcome::series`
  std::size_t most_in_flight = 0;  ///< layouts that `submit` takes before `poll` gives one back; 0: 16 per thread
  /// Called whenever a submitted layout is finished, on a thread of the screen, so that the program need not wait in
  /// `poll`: it may write into a pipe or wake a loop of events. It returns soon, throws nothing and calls no function
  /// of the screen. May be empty.
  std::function<void()> on_finished;
};

/// How `Screen::record` treats its file.
struct RecordOptions {
  bool series = true;        ///< write time series too
  bool resume = false;       ///< continue a run of the same layouts that was stopped or killed
  bool overwrite = false;    ///< replace the results of an earlier run; not together with `resume`
  std::string command_line;  ///< noted in the file; may be empty
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

  /// The same into memory of the caller, whose capacity is used again.
  void evaluate(std::span<const Layout> layouts, std::vector<WorldOutcome>& worlds);

  /// The same of layouts in memory of the caller.
  void evaluate(std::span<const LayoutView> layouts, std::vector<WorldOutcome>& worlds);

  /// How many g each layout stands, one entry per layout; the accelerations of the screen play no part. Throws `Error`,
  /// also where the engine cannot: native can.
  std::vector<LayoutMargins> margins(std::span<const Layout> layouts);
  std::vector<LayoutMargins> margins(std::span<const LayoutView> layouts);

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

  /// What is wrong with the layouts of the last call of `evaluate`, `record` or `submit`, with `BadLayouts::mark`; at
  /// most some twenty per layout. Valid until the next call.
  std::span<const Problem> problems() const noexcept;

  /// The accelerations of the screen: those of its norm, and those that it was given.
  std::span<const Acceleration> accelerations() const noexcept;

 private:
  struct HOLDFAST_LOCAL State;
  std::unique_ptr<State> state_;
};

/// Where a box is.
struct Pose {
  std::array<double, 3> position = {};               ///< of the centre of mass, m
  std::array<double, 4> orientation = {1, 0, 0, 0};  ///< quaternion w x y z, container from body
};

/// One layout under one acceleration, taken forward as far as the caller wants: for pictures, and for analyses of one's
/// own. It needs neither files nor threads, never ends early and is part of `holdfast::core` too, which has the engines
/// that are no plug-ins. Objects are independent of each other; one is used by one thread at a time. At the end its
/// hash is that of the same world of a `Screen`.
class HOLDFAST_API World {
 public:
  /// Throws `Error` when a setting, the layout or the acceleration cannot be used.
  /// @param layout corners in `unit`
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

  /// Forces of the boxes on floor, front, rear, left, right and roof, mean over the last step, container frame, N.
  /// Empty without the setting `WallForces` or `Walls`, or where the engine does not measure them.
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
