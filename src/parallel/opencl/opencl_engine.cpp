#include "parallel/opencl/opencl_engine.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/engine/step_plan.hpp"
#include "parallel/opencl/contact_constants.hpp"
#include "parallel/opencl/device_batch.hpp"
#include "parallel/opencl/device_session.hpp"
#include "parallel/schedulers/processor_time.hpp"

namespace holdfast::internal {

namespace {

constexpr double kStepsPerSecond = 240.0;

/// Assumed boxes per layout when the number of layouts in a batch is limited by the device, which stores all shapes.
constexpr std::size_t kBoxesPerLayout = 200;

/// Worlds that are on the device at the same time: a range of the batch.
struct Part {
  std::size_t begin = 0;
  std::size_t end = 0;

  std::size_t world_count() const { return end - begin; }
};

/// Divides the worlds, whose bodies are `ranges`, into parts of at most `most` bodies or of one world.
std::vector<Part> parts_of(std::span<const BodyRange> ranges, std::size_t most) {
  std::vector<Part> parts;
  for (std::size_t world = 0; world < ranges.size(); ++world) {
    const bool fits = !parts.empty() && parts.back().world_count() < kWorldsAtOnce &&
                      ranges[world].end - ranges[parts.back().begin].begin <= most;
    if (!fits) parts.push_back({world, world});
    parts.back().end = world + 1;
  }
  return parts;
}

/// Worlds of a batch that are stepped together on the device, in parts if they do not fit at once. Owns the session of
/// the process until destroyed.
class OpenClSimulation final : public Simulation {
 public:
  OpenClSimulation(const WorldBatch& batch, const Settings& settings, std::size_t bodies_at_once)
      : batch_(batch),
        gravity_(0.0, 0.0, -settings.gravity),
        steps_per_second_(settings.steps_per_second.value_or(kStepsPerSecond)),
        device_(make_device_batch(batch, (settings.opencl.iterations + kOuterSweeps - 1) / kOuterSweeps)),
        start_(device_.bodies),
        start_position_(batch.state.position),
        parts_(parts_of(device_.ranges, bodies_at_once)),
        lease_(settings.opencl.device, room_needed()),
        worlds_(batch.worlds.size()),
        steps_(batch.worlds.size()) {
    sweeps_ = std::uint64_t{kOuterSweeps} * static_cast<std::uint64_t>(device_.bodies.front().sweeps);
    DeviceSession* session = lease_.session();
    if (session != nullptr) session->pipeline().set_shapes(device_.shapes);
    const bool ready = session != nullptr && session->take_error().empty();
    for (ClockedWorld& world : worlds_) world.lost = !ready;
  }

  void advance(std::span<AdvanceRequest> requests) override {
    for (WorldStep& step : steps_) step = {};
    for (BodyRange& range : device_.ranges) range.stepping = false;
    for (const AdvanceRequest& request : requests) {
      ClockedWorld& world = worlds_[request.world];
      if (!world.begun || request.phase.begin != world.phase_begin)
        world = {true, world.lost, request.phase.begin, 0, world.counters};
      const StepPlan plan(request.phase, steps_per_second_);
      const Vec3 field = gravity_ - request.phase.acceleration;
      steps_[request.world].field_and_step = {static_cast<float>(field.x()), static_cast<float>(field.y()),
                                              static_cast<float>(field.z()), static_cast<float>(plan.step())};
      device_.ranges[request.world].stepping = !world.lost;
    }

    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin = processor_seconds();
    take_step();
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    const double waited = std::max(0.0, wall.count() - (processor_seconds() - cpu_begin));

    for (AdvanceRequest& request : requests) {
      ClockedWorld& world = worlds_[request.world];
      ++world.step;
      request.reached = StepPlan(request.phase, steps_per_second_).end_of(world.step - 1);
      ++world.counters.steps;
      world.counters.solve_iterations += sweeps_;
      world.counters.device_seconds += waited / static_cast<double>(requests.size());
    }
  }

  void read_back(std::size_t world, StateColumns& state) const override {
    const World& range = batch_.worlds[world];
    for (std::size_t i = 0; i < range.box_count; ++i) {
      const std::size_t body = device_.ranges[world].begin + i;
      const DeviceBody& now = device_.bodies[body];
      const std::size_t row = range.box_begin + i;
      // A body that has not moved has exactly its given position, in spite of the precision of the device.
      state.position[row] = start_position_[row] + (vector_of(now.position) - vector_of(start_[body].position));
      state.orientation[row] = Rotation(now.orientation[3], now.orientation[0], now.orientation[1], now.orientation[2]);
      state.orientation[row].normalize();
      state.velocity[row] = vector_of(now.velocity);
      state.angular_velocity[row] = vector_of(now.angular_velocity);
    }
  }

  Counters counters(std::size_t world) const override { return worlds_[world].counters; }
  Status status(std::size_t world) const override { return worlds_[world].lost ? Status::capacity : Status::ok; }

 private:
  struct ClockedWorld {
    bool begun = false;
    bool lost = false;         ///< the device has too little memory for it, or failed
    double phase_begin = 0.0;  ///< start of the current phase of the world, s
    std::uint64_t step = 0;    ///< steps taken in that phase
    Counters counters;
  };

  static Vec3 vector_of(const Float4Column& v) { return {v[0], v[1], v[2]}; }

  /// Number of bodies of the largest part, or of shapes if there are more.
  std::size_t room_needed() const {
    std::size_t room = device_.shapes.size();
    for (const Part& part : parts_) room = std::max(room, bodies_of(part).end - bodies_of(part).begin);
    return room;
  }

  BodyRange bodies_of(const Part& part) const {
    return {device_.ranges[part.begin].begin, device_.ranges[part.end - 1].end};
  }

  /// Advances all worlds by a step. A part that overflows the device is halved and repeats it.
  void take_step() {
    for (std::size_t i = 0; i < parts_.size();) {
      const Part part = parts_[i];
      if (step_part(part)) {
        ++i;
      } else if (part.world_count() > 1) {
        parts_[i].end = part.begin + part.world_count() / 2;
        parts_.insert(parts_.begin() + static_cast<std::ptrdiff_t>(i) + 1, {parts_[i].end, part.end});
      } else {
        worlds_[part.begin].lost = true;
        ++i;
      }
    }
  }

  /// False, without any change, if the device reports an error or loses data.
  bool step_part(const Part& part) {
    std::vector<BodyRange> ranges;
    const BodyRange all = bodies_of(part);
    bool stepping = false;
    for (std::size_t world = part.begin; world < part.end; ++world) {
      const BodyRange& range = device_.ranges[world];
      ranges.push_back({range.begin - all.begin, range.end - all.begin, range.stepping});
      stepping = stepping || range.stepping;
    }
    if (!stepping) return true;

    DeviceSession& session = *lease_.session();
    const std::span bodies = std::span(device_.bodies).subspan(all.begin, all.end - all.begin);
    if (on_device_.begin != part.begin || on_device_.end != part.end) {
      session.upload(bodies, std::span(device_.inertias).subspan(all.begin, bodies.size()),
                     std::span(device_.body_inertia).subspan(all.begin, bodies.size()), worlds_.size());
      on_device_ = part;
    }
    bool well = session.take_error().empty();
    if (well) session.step(steps_, ranges);
    well = well && session.take_error().empty();
    after_.resize(bodies.size());
    if (well) session.read(after_);
    well = well && session.take_error().empty();
    if (well) {
      std::copy(after_.begin(), after_.end(), bodies.begin());
    } else {
      on_device_ = {};
    }
    return well;
  }

  const WorldBatch& batch_;
  Vec3 gravity_;
  double steps_per_second_;
  std::uint64_t sweeps_ = 0;
  DeviceBatch device_;                ///< bodies as they were last read
  std::vector<DeviceBody> start_;     ///< the start, as rounded by the device
  std::vector<Vec3> start_position_;  ///< as given, m
  std::vector<Part> parts_;           ///< that take turns on the device
  SessionLease lease_;
  std::vector<ClockedWorld> worlds_;
  std::vector<WorldStep> steps_;
  Part on_device_;
  std::vector<DeviceBody> after_;  ///< buffer for the bodies of a part
};

std::vector<Error> unsupported(const Settings& settings) {
  std::vector<Error> errors;
  if (settings.container.motion == ContainerMotion::free) {
    errors.push_back({.what = "bullet-opencl has no free container",
                      .accepted = "Motion = prescribed in [Container], or another engine"});
  }
  if (!settings.contact.materials.empty()) {
    errors.push_back({.what = "bullet-opencl has no coefficients for pairs of materials",
                      .value = "[Friction] " + settings.contact.materials.rows().front().partners.text(),
                      .accepted = "rows of any, floor and wall alone, or another engine"});
  }
  return errors;
}

}  // namespace

OpenClEngine::OpenClEngine(const std::string& name, const Settings& settings, const OpenClDevice& device)
    : settings_(settings), bodies_at_once_(bodies_at_once(device)) {
  traits_.name = name;
  traits_.steps_per_second = settings.steps_per_second.value_or(kStepsPerSecond);
  const std::size_t fitting = std::max<std::size_t>(1, bodies_at_once_ / kBoxesPerLayout);
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
  return std::make_unique<OpenClSimulation>(batch, settings_, bodies_at_once_);
}

}  // namespace holdfast::internal
