#include "parallel/opencl/bullet3_pipeline.hpp"

#include <Bullet3Collision/BroadPhaseCollision/b3DynamicBvhBroadphase.h>
#include <Bullet3Collision/BroadPhaseCollision/b3OverlappingPairCache.h>
#include <Bullet3Collision/NarrowPhaseCollision/b3Config.h>
#include <Bullet3Common/b3Logging.h>
#include <Bullet3OpenCL/BroadphaseCollision/b3SapAabb.h>
#include <Bullet3OpenCL/ParallelPrimitives/b3OpenCLArray.h>
#include <Bullet3OpenCL/RigidBody/b3GpuNarrowPhase.h>
#include <Bullet3OpenCL/RigidBody/b3GpuNarrowPhaseInternalData.h>
#include <Bullet3OpenCL/RigidBody/b3GpuRigidBodyPipeline.h>
#include <Bullet3OpenCL/RigidBody/b3GpuRigidBodyPipelineInternalData.h>
#include <Bullet3OpenCL/RigidBody/b3Solver.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "parallel/opencl/contact_constants.hpp"
#include "parallel/opencl/kernel_patches.hpp"

// Switches and hooks of the library that its headers do not declare.
// NOLINTBEGIN(readability-identifier-naming)
extern bool gDebugSkipLoadingBinary;
extern bool gUseDbvt;
extern bool useMprGpu;
int b3OpenCLUtils_clewInit();
using CreateProgram = cl_program(cl_context, cl_uint, const char**, const std::size_t*, cl_int*);
using BuildProgram = cl_int(cl_program, cl_uint, const cl_device_id*, const char*, void (*)(cl_program, void*), void*);
extern "C" CreateProgram* __clewCreateProgramWithSource;
using GetProgramInfo = cl_int(cl_program, cl_program_info, std::size_t, void*, std::size_t*);
extern "C" BuildProgram* __clewBuildProgram;
extern "C" GetProgramInfo* __clewGetProgramInfo;
// NOLINTEND(readability-identifier-naming)

namespace holdfast::internal {

namespace {

static_assert(sizeof(DeviceBody) == sizeof(b3RigidBodyData) && sizeof(DeviceInertia) == sizeof(b3InertiaData));
static_assert(offsetof(b3RigidBodyData, m_invMass) == offsetof(DeviceBody, inverse_mass) &&
              offsetof(b3RigidBodyData, m_restituitionCoeff) == offsetof(DeviceBody, world) &&
              offsetof(b3RigidBodyData, m_frictionCoeff) == offsetof(DeviceBody, sweeps));

/// Capacity for pairs and contacts, per box; a densely packed box has about four.
constexpr std::size_t kPairsPerBody = 16;

/// Bullet's sort of contacts rounds their number up to a multiple of 512 and writes to a buffer for 512 Ki of them.
constexpr std::size_t kMostContacts = 512 * 1024;
static_assert(kPairsPerBody * kBodiesAtOnce == kMostContacts && kWorldsAtOnce == B3_SOLVER_N_CELLS);

/// Capacity of the narrow phase for vertices of a clipped face, per pair.
constexpr std::size_t kFaceVertices = 64;
constexpr std::size_t kUsualPairsPerBody = 4;

/// Largest number of characters kept of the library's error messages.
constexpr std::size_t kLongestMessage = 2000;

/// State of the library's message and hook functions, which have no argument for it. One pipeline at a time uses it.
struct LibraryHooks {
  std::string error;
  KernelPatcher* patcher = nullptr;
  CreateProgram* create_program = nullptr;
  BuildProgram* build_program = nullptr;
  GetProgramInfo* get_program_info = nullptr;
};
LibraryHooks& hooks() {
  static LibraryHooks instance;
  return instance;
}

void drop_message(const char*) {}
void keep_error(const char* message) {
  // A message arrives in several parts, beginning with its location; a failing step may repeat it for ever.
  if (hooks().error.size() < kLongestMessage) hooks().error += message;
}

cl_program create_patched_program(cl_context context, cl_uint count, const char** texts, const std::size_t* lengths,
                                  cl_int* error) {
  if (hooks().patcher == nullptr || count != 1) return hooks().create_program(context, count, texts, lengths, error);
  const std::string source = hooks().patcher->patched(lengths == nullptr ? std::string_view(texts[0])
                                                                         : std::string_view(texts[0], lengths[0]));
  const char* text = source.c_str();
  return hooks().create_program(context, 1, &text, nullptr, error);
}

/// Disables warnings about Bullet's code, which a driver writes to standard error.
cl_int build_silently(cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
                      void (*done)(cl_program, void*), void* data) {
  const std::string silent = std::string(options == nullptr ? "" : options) + " -w";
  return hooks().build_program(program, count, devices, silent.c_str(), done, data);
}

/// Reports that a program is built for no device. Bullet asks before it stores the binary in the folder `cache`, if
/// that exists, under a name that other programs with Bullet would load as their own.
cl_int hide_binaries(cl_program program, cl_program_info what, std::size_t size, void* value, std::size_t* written) {
  const cl_int code = hooks().get_program_info(program, what, size, value, written);
  if (what == CL_PROGRAM_NUM_DEVICES && value != nullptr) *static_cast<cl_uint*>(value) = 0;
  return code;
}

/// Finds the pairs of each world separately, by sort and sweep along x. Their order depends only on the world.
class WorldBroadphase final : public b3DynamicBvhBroadphase {
 public:
  /// @param room capacity for pairs; if there are more, that is an error, and no pairs are passed on
  explicit WorldBroadphase(std::size_t room) : b3DynamicBvhBroadphase(1), room_(room) {}

  void set_bodies(std::span<const DeviceBody> bodies) {
    boxes_.resize(bodies.size());
    fixed_.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) fixed_[i] = bodies[i].inverse_mass == 0.0F;
  }
  void set_ranges(std::span<const BodyRange> ranges) { ranges_ = ranges; }

  void setAabb(int body, const b3Vector3& low, const b3Vector3& high, b3Dispatcher*) override {
    // A body whose position is not finite cannot be sorted: it comes last and has no pairs.
    const float far = std::numeric_limits<float>::max();
    const bool somewhere = std::isfinite(low.x + low.y + low.z + high.x + high.y + high.z);
    boxes_[static_cast<std::size_t>(body)] =
        somewhere ? Box{low, high} : Box{b3MakeVector3(far, far, far), b3MakeVector3(-far, -far, -far)};
  }
  void calculateOverlappingPairs(b3Dispatcher*) override {
    b3BroadphasePairArray& pairs = cache_.getOverlappingPairArray();
    pairs.resizeNoInitialize(0);
    for (const BodyRange& range : ranges_)
      if (range.stepping && static_cast<std::size_t>(pairs.size()) < room_) sweep(range, pairs);
    if (static_cast<std::size_t>(pairs.size()) < room_) return;
    keep_error("more pairs of boxes than the device has memory for");
    pairs.resizeNoInitialize(0);
  }
  b3OverlappingPairCache* getOverlappingPairCache() override { return &cache_; }
  const b3OverlappingPairCache* getOverlappingPairCache() const override { return &cache_; }

 private:
  struct Box {
    b3Vector3 low, high;
  };

  void sweep(const BodyRange& range, b3BroadphasePairArray& pairs) {
    order_.clear();
    for (std::size_t i = range.begin; i < range.end; ++i) order_.push_back(static_cast<int>(i));
    std::sort(order_.begin(), order_.end(), [&](int a, int b) {
      const float x = box(a).low.x;
      const float y = box(b).low.x;
      return x < y || (x == y && a < b);
    });
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const Box& one = box(order_[i]);
      for (std::size_t j = i + 1; j < order_.size() && box(order_[j]).low.x <= one.high.x; ++j) {
        const Box& other = box(order_[j]);
        if (is_fixed(order_[i]) && is_fixed(order_[j])) continue;
        if (one.low.y > other.high.y || other.low.y > one.high.y) continue;
        if (one.low.z > other.high.z || other.low.z > one.high.z) continue;
        b3BroadphasePair pair;
        pair.x = std::min(order_[i], order_[j]);
        pair.y = std::max(order_[i], order_[j]);
        pair.z = -1;
        pair.w = -1;
        pairs.push_back(pair);
      }
    }
  }
  const Box& box(int body) const { return boxes_[static_cast<std::size_t>(body)]; }
  bool is_fixed(int body) const { return fixed_[static_cast<std::size_t>(body)]; }

  std::size_t room_;
  b3HashedOverlappingPairCache cache_;
  std::vector<Box> boxes_;
  std::vector<bool> fixed_;
  std::vector<int> order_;
  std::span<const BodyRange> ranges_;
};

/// Gives access to protected members of the library.
class OpenPipeline final : public b3GpuRigidBodyPipeline {
 public:
  using b3GpuRigidBodyPipeline::b3GpuRigidBodyPipeline;
  b3GpuRigidBodyPipelineInternalData& data() { return *m_data; }
};

b3Config config_for(std::size_t body_capacity) {
  const auto number = [](std::size_t value) { return static_cast<int>(value); };
  b3Config config;
  config.m_maxConvexBodies = number(body_capacity);
  config.m_maxConvexShapes = number(body_capacity);
  config.m_maxBroadphasePairs = number(std::min(kPairsPerBody * body_capacity, kMostContacts));
  config.m_maxContactCapacity = config.m_maxBroadphasePairs;
  config.m_maxVerticesPerFace = number(kFaceVertices * kUsualPairsPerBody);
  // No compounds and no meshes.
  config.m_compoundPairCapacity = 1;
  config.m_maxCompoundChildShapes = 1;
  config.m_maxTriConvexPairCapacity = 1;
  return config;
}

class Pipeline final : public Bullet3Pipeline {
 public:
  Pipeline(cl_context context, cl_device_id device, cl_command_queue queue, std::size_t body_capacity)
      : config_(config_for(body_capacity)),
        narrow_phase_(context, device, queue, config_),
        broad_phase_(static_cast<std::size_t>(config_.m_maxBroadphasePairs)),
        pipeline_(context, device, queue, &narrow_phase_, nullptr, &broad_phase_, config_) {
    // All forces are applied by the kernel of this project.
    const float none[3] = {0.0F, 0.0F, 0.0F};
    pipeline_.setGravity(none);
  }

  void set_shapes(std::span<const DeviceShape> shapes) override {
    narrow_phase_.reset();
    pipeline_.reset();
    for (std::size_t i = 0; i < shapes.size(); ++i)
      if (add(shapes[i]) != static_cast<int>(i)) keep_error("a shape was not accepted");
  }

  void upload(std::span<const DeviceBody> bodies, std::span<const DeviceInertia> inertias) override {
    b3GpuNarrowPhaseInternalData& data = *narrow_phase_.getInternalData();
    const int count = static_cast<int>(bodies.size());
    data.m_bodyBufferCPU->resizeNoInitialize(count);
    data.m_inertiaBufferCPU->resizeNoInitialize(count);
    std::memcpy(static_cast<void*>(&data.m_bodyBufferCPU->at(0)), bodies.data(), bodies.size_bytes());
    std::memcpy(static_cast<void*>(&data.m_inertiaBufferCPU->at(0)), inertias.data(), inertias.size_bytes());
    data.m_numAcceleratedRigidBodies = count;
    narrow_phase_.writeAllBodiesToGpu();
    pipeline_.data().m_allAabbsCPU.resize(count);
    pipeline_.data().m_allAabbsGPU->resize(bodies.size());
    broad_phase_.set_bodies(bodies);
  }

  void solve(std::span<const BodyRange> ranges) override {
    broad_phase_.set_ranges(ranges);
    pipeline_.stepSimulation(0.0F);
    const bool any = broad_phase_.getOverlappingPairCache()->getNumOverlappingPairs() > 0;
    if (any && narrow_phase_.getNumContactsGpu() >= config_.m_maxContactCapacity)
      keep_error("more contacts than the device has memory for");
  }

  std::string take_error() override { return std::exchange(hooks().error, {}); }
  cl_mem bodies() const override { return const_cast<b3GpuNarrowPhase&>(narrow_phase_).getBodiesGpu(); }
  cl_mem inertias() const override { return const_cast<b3GpuNarrowPhase&>(narrow_phase_).getBodyInertiasGpu(); }
  std::size_t body_capacity() const override { return static_cast<std::size_t>(config_.m_maxConvexBodies); }

 private:
  int add(const DeviceShape& shape) {
    float vertices[8][4] = {};
    for (unsigned corner = 0; corner < 8; ++corner) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        const double side = (corner >> axis & 1U) != 0 ? 1.0 : -1.0;
        vertices[corner][axis] =
            static_cast<float>(shape.centre[axis] + side * (shape.half_extents[axis] + kShapeMargin));
      }
    }
    const float scale[3] = {1.0F, 1.0F, 1.0F};
    return narrow_phase_.registerConvexHullShape(&vertices[0][0], sizeof(vertices[0]), 8, scale);
  }

  b3Config config_;
  b3GpuNarrowPhase narrow_phase_;
  WorldBroadphase broad_phase_;
  OpenPipeline pipeline_;
};

}  // namespace

Result<std::unique_ptr<Bullet3Pipeline>> Bullet3Pipeline::create(cl_context context, cl_device_id device,
                                                                 cl_command_queue queue, std::size_t body_capacity) {
  b3SetCustomPrintfFunc(drop_message);
  b3SetCustomWarningMessageFunc(drop_message);
  b3SetCustomErrorMessageFunc(keep_error);
  // Its cache of binaries identifies a program only by name, and would return binaries without the patches.
  gDebugSkipLoadingBinary = true;
  gUseDbvt = true;
  // Portal refinement would replace a corner of the face by another point.
  useMprGpu = false;

  LibraryHooks& library = hooks();
  library.error.clear();
  if (library.create_program == nullptr) {
    if (b3OpenCLUtils_clewInit() != 0)
      return Error{.what = "Bullet cannot load libOpenCL.so.1", .value = library.error};
    library.create_program = __clewCreateProgramWithSource;
    library.build_program = __clewBuildProgram;
    library.get_program_info = __clewGetProgramInfo;
    __clewCreateProgramWithSource = create_patched_program;
    __clewBuildProgram = build_silently;
    __clewGetProgramInfo = hide_binaries;
  }
  KernelPatcher patcher(kernel_patches());
  library.patcher = &patcher;
  auto pipeline = std::make_unique<Pipeline>(context, device, queue, body_capacity);
  library.patcher = nullptr;
  const std::vector<std::string> unapplied = patcher.unapplied();
  if (!unapplied.empty()) {
    std::string names;
    for (const std::string& name : unapplied) names += (names.empty() ? "" : ", ") + name;
    return Error{
        .what = "changes to Bullet's OpenCL kernels do not fit", .value = names, .accepted = "Bullet 3.24 is expected"};
  }
  if (!library.error.empty()) return Error{.what = "Bullet's OpenCL pipeline cannot be built", .value = library.error};
  return std::unique_ptr<Bullet3Pipeline>(std::move(pipeline));
}

}  // namespace holdfast::internal
