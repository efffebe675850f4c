#include "parallel/opencl/opencl_engine.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <map>

#include "core/step_plan.hpp"
#include "parallel/opencl/contact_constants.hpp"
#include "parallel/opencl/device_batch.hpp"
#include "parallel/opencl/device_session.hpp"
#include "parallel/processor_time.hpp"

namespace holdfast {

namespace {

constexpr double kStepsPerSecond = 240.0;

/// Bodies of a layout under all of its accelerations, when batches are made to fit the device: 10 worlds of 200.
constexpr std::size_t kBodiesPerLayout = 2000;

/// Worlds of a batch, stepped together on the device. Holds the process's session for as long as it lives.
class OpenClSimulation final : public Simulation {
 public:
  OpenClSimulation(const WorldBatch& batch, const Settings& settings)
      : batch_(batch),
        gravity_(0.0, 0.0, -settings.gravity),
        steps_per_second_(settings.steps_per_second.value_or(kStepsPerSecond)),
        device_(make_device_batch(batch, settings, (settings.opencl.iterations + kOuterSweeps - 1) / kOuterSweeps)),
        start_(device_.bodies),
        start_position_(batch.state.position),
        lease_(settings.opencl.device, device_.bodies.size()),
        worlds_(batch.worlds.size()),
        steps_(batch.worlds.size()) {
    sweeps_ = std::uint64_t{kOuterSweeps} * static_cast<std::uint64_t>(device_.bodies.front().sweeps);
    if (lease_.session() == nullptr) {
      lost_ = true;
      return;
    }
    Bullet3Pipeline& pipeline = lease_.session()->pipeline();
    pipeline.clear();
    std::map<std::array<double, 6>, int> shapes;
    for (std::size_t i = 0; i < device_.bodies.size(); ++i) {
      const Vec3& half = device_.half_extents[i];
      const Vec3& centre = device_.shape_centre[i];
      const auto [entry, is_new] =
          shapes.try_emplace({half.x(), half.y(), half.z(), centre.x(), centre.y(), centre.z()}, 0);
      if (is_new) entry->second = pipeline.add_shape(half, centre);
      device_.bodies[i].shape = entry->second;
    }
    lease_.session()->upload(device_.bodies, device_.inertias, device_.body_inertia, batch.worlds.size());
    lost_ = !lease_.session()->take_error().empty();
  }

  double advance(std::span<const std::size_t> worlds, const Phase& phase, double watch) override {
    std::vector<Stride> strides;
    for (const std::size_t world : worlds) strides.push_back({world, phase, watch});
    advance_all(strides);
    return strides.front().time;
  }

  void advance_all(std::span<Stride> strides) override {
    std::uint64_t count = std::numeric_limits<std::uint64_t>::max();
    for (WorldStep& step : steps_) step = {};
    for (BodyRange& range : device_.ranges) range.stepping = false;
    for (const Stride& stride : strides) {
      ClockedWorld& world = worlds_[stride.world];
      if (!world.begun || stride.phase.begin != world.phase_begin)
        world = {.begun = true, .phase_begin = stride.phase.begin, .step = 0, .counters = world.counters};
      const StepPlan plan(stride.phase, steps_per_second_);
      count = std::min(count, steps_to_stop(plan, world.step, stride.watch));
      const Vec3 field = gravity_ - stride.phase.acceleration;
      steps_[stride.world].field_and_step = {static_cast<float>(field.x()), static_cast<float>(field.y()),
                                             static_cast<float>(field.z()), static_cast<float>(plan.step())};
      device_.ranges[stride.world].stepping = true;
    }

    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin = processor_seconds();
    if (!lost_) take_steps(count);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    const double waited = std::max(0.0, wall.count() - (processor_seconds() - cpu_begin));

    for (Stride& stride : strides) {
      ClockedWorld& world = worlds_[stride.world];
      world.step += count;
      stride.time = StepPlan(stride.phase, steps_per_second_).end_of(world.step - 1);
      world.counters.steps += count;
      world.counters.solve_iterations += count * sweeps_;
      world.counters.device_seconds += waited / static_cast<double>(strides.size());
    }
  }

  void read_back(std::size_t world, StateColumns& state) const override {
    const World& range = batch_.worlds[world];
    for (std::size_t i = 0; i < range.box_count; ++i) {
      const std::size_t body = device_.ranges[world].begin + i;
      const DeviceBody& now = device_.bodies[body];
      const std::size_t row = range.box_begin + i;
      // A body that has not moved has exactly the position it was given, whatever the device's precision.
      state.position[row] = start_position_[row] + (vector_of(now.position) - vector_of(start_[body].position));
      state.orientation[row] = Rotation(now.orientation[3], now.orientation[0], now.orientation[1], now.orientation[2]);
      state.orientation[row].normalize();
      state.velocity[row] = vector_of(now.velocity);
      state.angular_velocity[row] = vector_of(now.angular_velocity);
    }
  }

  Counters counters(std::size_t world) const override { return worlds_[world].counters; }
  Status status(std::size_t /*world*/) const override { return lost_ ? Status::capacity : Status::ok; }

 private:
  struct ClockedWorld {
    bool begun = false;
    double phase_begin = 0.0;  ///< of the phase that the world is in, s
    std::uint64_t step = 0;    ///< steps taken in that phase
    Counters counters;
  };

  static Vec3 vector_of(const Float4Column& v) { return {v[0], v[1], v[2]}; }

  /// Steps up to the last end not after `watch`, at least one, never past the phase.
  static std::uint64_t steps_to_stop(const StepPlan& plan, std::uint64_t taken, double watch) {
    const std::uint64_t left = plan.step_count() - taken;
    if (plan.end_of(plan.step_count() - 1) <= watch) return left;
    std::uint64_t count = 1;
    while (count < left && plan.end_of(taken + count) <= watch) ++count;
    return count;
  }

  void take_steps(std::uint64_t count) {
    DeviceSession& session = *lease_.session();
    for (std::uint64_t i = 0; i < count && !lost_; ++i) {
      session.step(steps_, device_.ranges);
      lost_ = !session.take_error().empty();
    }
    session.read(device_.bodies);
    lost_ = lost_ || !session.take_error().empty();
  }

  const WorldBatch& batch_;
  Vec3 gravity_;
  double steps_per_second_;
  std::uint64_t sweeps_ = 0;
  DeviceBatch device_;
  std::vector<DeviceBody> start_;     ///< as the device rounded it
  std::vector<Vec3> start_position_;  ///< as given, m
  SessionLease lease_;
  std::vector<ClockedWorld> worlds_;
  std::vector<WorldStep> steps_;
  bool lost_ = false;
};

std::vector<Error> unsupported(const Settings& settings) {
  std::vector<Error> errors;
  if (settings.container.motion == ContainerMotion::free) {
    errors.push_back({.what = "bullet-opencl has no free container",
                      .accepted = "Motion = prescribed in [Container], or another engine"});
  }
  return errors;
}

}  // namespace

OpenClEngine::OpenClEngine(const std::string& name, const Settings& settings, const OpenClDevice& device)
    : settings_(settings) {
  traits_.name = name;
  const std::size_t fitting = std::max<std::size_t>(1, bodies_on(device) / kBodiesPerLayout);
  traits_.layouts_per_unit = std::min(static_cast<std::size_t>(settings.opencl.layouts_per_batch), fitting);
  traits_.all_together = true;
}

Result<std::unique_ptr<Engine>> OpenClEngine::make(const std::string& name, const Settings& settings) {
  std::vector<Error> errors = unsupported(settings);
  if (!errors.empty()) return errors;
  const Result<OpenClDevice> device = SessionLease::prepare(settings.opencl.device);
  if (!device) return device.errors();
  return std::unique_ptr<Engine>(new OpenClEngine(name, settings, *device));
}

std::unique_ptr<Simulation> OpenClEngine::build(const WorldBatch& batch) const {
  return std::make_unique<OpenClSimulation>(batch, settings_);
}

}  // namespace holdfast
