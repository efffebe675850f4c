#include "parallel/opencl/device_session.hpp"

#include <algorithm>
#include <semaphore>
#include <utility>

#include "parallel/opencl/kernel_sources.hpp"

namespace holdfast::internal {

namespace {

/// Device memory per body of the capacity, bytes (measured); most of it is for clipping faces.
constexpr std::uint64_t kBytesPerBody = 24 * 1024;

/// Capacity of the first session, bodies; it is doubled as often as needed.
constexpr std::size_t kFirstCapacity = 4096;

std::string build_log(cl_program program, cl_device_id device) {
  std::string log(4096, '\0');
  std::size_t size = 0;
  clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, log.size(), log.data(), &size);
  return log.substr(0, log.find('\0'));
}

/// The session of the process. It is never destroyed: drivers may be unloaded before static objects are destroyed.
struct Shared {
  std::binary_semaphore free{1};
  std::unique_ptr<DeviceSession> session;
};
Shared& shared() {
  static auto* const kShared = new Shared;
  return *kShared;
}

/// Makes the capacity of the shared session large enough; the caller holds its lock.
Result<DeviceSession*> fit(const std::string& wanted_device, std::size_t body_count) {
  Result<OpenClDevice> device = choose_device(opencl_devices(), wanted_device);
  if (!device) return device.errors();
  std::unique_ptr<DeviceSession>& session = shared().session;
  const bool same = session && session->device().id == device->id;
  if (same && session->pipeline().body_capacity() >= body_count) return session.get();
  std::size_t capacity = same ? session->pipeline().body_capacity() : kFirstCapacity;
  while (capacity < body_count) capacity *= 2;
  capacity = std::min(capacity, std::max(body_count, bodies_at_once(*device)));
  if (capacity * kBytesPerBody > device->memory) {
    return Error{.what = "the OpenCL device has too little memory for " + std::to_string(body_count) + " bodies",
                 .value = device->name};
  }
  session.reset();
  Result<std::unique_ptr<DeviceSession>> opened = DeviceSession::open(*device, capacity);
  if (!opened) return opened.errors();
  session = std::move(*opened);
  return session.get();
}

}  // namespace

Result<std::unique_ptr<DeviceSession>> DeviceSession::open(const OpenClDevice& device, std::size_t body_capacity) {
  std::unique_ptr<DeviceSession> session(new DeviceSession);
  session->device_ = device;
  cl_device_id id = device.id;
  cl_int code = CL_SUCCESS;
  const auto failed = [&](const char* what) {
    return Error{.what = std::string("the OpenCL device ") + what + " (code " + std::to_string(code) + ")",
                 .value = device.name};
  };
  session->context_ = ClContext(clCreateContext(nullptr, 1, &id, nullptr, nullptr, &code));
  if (code != CL_SUCCESS) return failed("does not create a context");
  // An in-order queue, created with the OpenCL 1.x call, as Bullet's own code expects.
  session->queue_ = ClQueue(clCreateCommandQueue(session->context_.get(), id, 0, &code));
  if (code != CL_SUCCESS) return failed("does not create a queue");

  const char* text = kWorldStepSource;
  session->program_ = ClProgram(clCreateProgramWithSource(session->context_.get(), 1, &text, nullptr, &code));
  if (code == CL_SUCCESS) code = clBuildProgram(session->program_.get(), 1, &id, "", nullptr, nullptr);
  if (code != CL_SUCCESS) {
    Error error = failed("cannot build kernels/opencl/world_step.cl");
    error.value = build_log(session->program_.get(), id);
    return error;
  }
  session->begin_step_ = ClKernel(clCreateKernel(session->program_.get(), "begin_step", &code));
  if (code == CL_SUCCESS) session->end_step_ = ClKernel(clCreateKernel(session->program_.get(), "end_step", &code));
  if (code != CL_SUCCESS) return failed("has no kernel of kernels/opencl/world_step.cl");

  Result<std::unique_ptr<Bullet3Pipeline>> pipeline =
      Bullet3Pipeline::create(session->context_.get(), id, session->queue_.get(), body_capacity);
  if (!pipeline) return pipeline.errors();
  session->pipeline_ = std::move(*pipeline);
  return session;
}

void DeviceSession::note(cl_int code, const char* what) {
  if (code != CL_SUCCESS && error_.empty()) error_ = std::string(what) + " failed with code " + std::to_string(code);
}

ClBuffer DeviceSession::buffer(std::size_t bytes) {
  cl_int code = CL_SUCCESS;
  ClBuffer made(clCreateBuffer(context_.get(), CL_MEM_READ_WRITE, std::max<std::size_t>(bytes, 16), nullptr, &code));
  note(code, "a buffer on the device");
  return made;
}

void DeviceSession::upload(std::span<const DeviceBody> bodies, std::span<const DeviceInertia> inertias,
                           std::span<const Float4Column> body_inertia, std::size_t world_count) {
  body_count_ = bodies.size();
  worlds_on_device_.clear();
  if (body_room_ < body_count_) {
    body_room_ = pipeline_->body_capacity();
    body_inertia_ = buffer(body_room_ * sizeof(Float4Column));
    kept_ = buffer(body_room_ * 2 * sizeof(Float4Column));
  }
  if (world_room_ < world_count) {
    world_room_ = world_count;
    worlds_ = buffer(world_room_ * sizeof(WorldStep));
  }
  pipeline_->upload(bodies, inertias);
  note(clEnqueueWriteBuffer(queue_.get(), body_inertia_.get(), CL_TRUE, 0, body_inertia.size_bytes(),
                            body_inertia.data(), 0, nullptr, nullptr),
       "writing moments of inertia");
}

void DeviceSession::run(const ClKernel& kernel) {
  constexpr std::size_t kGroup = 64;
  const std::size_t items = (body_count_ + kGroup - 1) / kGroup * kGroup;
  note(clEnqueueNDRangeKernel(queue_.get(), kernel.get(), 1, nullptr, &items, &kGroup, 0, nullptr, nullptr),
       "a kernel of kernels/opencl/world_step.cl");
}

void DeviceSession::step(std::span<const WorldStep> worlds, std::span<const BodyRange> ranges) {
  const auto same = [](const WorldStep& a, const WorldStep& b) { return a.field_and_step == b.field_and_step; };
  if (!std::equal(worlds.begin(), worlds.end(), worlds_on_device_.begin(), worlds_on_device_.end(), same)) {
    worlds_on_device_.assign(worlds.begin(), worlds.end());
    note(clEnqueueWriteBuffer(queue_.get(), worlds_.get(), CL_TRUE, 0, worlds.size_bytes(), worlds.data(), 0, nullptr,
                              nullptr),
         "writing accelerations");
  }
  const auto give = [&](const ClKernel& kernel, auto... objects) {
    cl_uint index = 0;
    const auto set = [&](const auto& object) {
      // A buffer is passed as its handle.
      // NOLINTNEXTLINE(bugprone-sizeof-expression)
      note(clSetKernelArg(kernel.get(), index++, sizeof(object), &object), "an argument of a kernel");
    };
    (set(objects), ...);
  };
  const auto count = static_cast<cl_int>(body_count_);
  give(begin_step_, pipeline_->bodies(), pipeline_->inertias(), body_inertia_.get(), kept_.get(), worlds_.get(), count);
  run(begin_step_);
  pipeline_->solve(ranges);
  give(end_step_, pipeline_->bodies(), kept_.get(), worlds_.get(), count);
  run(end_step_);
}

void DeviceSession::read(std::span<DeviceBody> bodies) {
  note(clEnqueueReadBuffer(queue_.get(), pipeline_->bodies(), CL_TRUE, 0, bodies.size_bytes(), bodies.data(), 0,
                           nullptr, nullptr),
       "reading bodies");
}

std::string DeviceSession::take_error() {
  std::string error = std::exchange(error_, {});
  std::string reported = pipeline_->take_error();
  return error.empty() ? reported : error;
}

std::size_t bodies_at_once(const OpenClDevice& device) {
  return std::min<std::size_t>(kBodiesAtOnce, device.memory / kBytesPerBody);
}

Result<OpenClDevice> SessionLease::prepare(const std::string& wanted_device) {
  shared().free.acquire();
  const Result<DeviceSession*> session = fit(wanted_device, 0);
  Result<OpenClDevice> device = session ? Result<OpenClDevice>((*session)->device()) : session.errors();
  shared().free.release();
  return device;
}

SessionLease::SessionLease(const std::string& wanted_device, std::size_t body_count) {
  shared().free.acquire();
  const Result<DeviceSession*> session = fit(wanted_device, body_count);
  if (session) {
    session_ = *session;
  } else {
    error_ = session.error().message();
  }
}

SessionLease::~SessionLease() { shared().free.release(); }

}  // namespace holdfast::internal
