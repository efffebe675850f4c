#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/native/collision/manifold.hpp"
#include "core/native/native_options.hpp"
#include "core/native/solver/admm.hpp"

namespace holdfast::internal::native {

/// Everything that islands of a world share.
struct Scene {
  Bodies bodies;
  std::vector<Side> sides;
  std::vector<Manifold> manifolds;
  /// Manifolds as they were before an impact within the step renewed them, to take the step again.
  std::vector<std::pair<std::uint32_t, Manifold>> undo;
};

/// What holds for all islands in a step.
struct StepTerms {
  double step = 0.0;           ///< s
  double longest_step = 0.0;   ///< that any step may have, s: contacts are found for it
  Vec3 pull = Vec3::Zero();    ///< gravity and what the container's acceleration feels like, g − a, m/s²
  double velocity_unit = 0.0;  ///< |g − a| · step: what tolerances are measured in, m/s
  bool cold = false;           ///< the acceleration has just changed: the last step is no guess for this one
  double reach = 0.0;          ///< m, see `contact_reach`
};

/// Bodies that are solved together, with the manifolds inside: those whose ends are among the bodies or fixed.
struct IslandView {
  std::span<const std::uint32_t> bodies;
  std::span<const std::uint32_t> manifolds;
};

/// What an island's step has cost and reached.
struct IslandReport {
  std::uint64_t iterations = 0;
  double residual = 0.0;  ///< worst of its solves, m/s
  bool met_deep = false;  ///< bodies overlap where their last contact did not show it, see `overlaps_unseen`
};

/// True when a contact overlaps by `deep`, m, more than the one before it: it should have been seen earlier. Corners
/// that approach across two directions at once show no contact until they overlap.
bool overlaps_unseen(const ContactSet& contact, const ContactSet& before, double deep);

/// Overlap at the end of a step that calls for a contact to be solved, m: at least `late`; else what no one sees, and
/// little beside what a body falls in the step.
double least_overlap(const StepTerms& terms, double late);

/// How far apart two bodies may be that could meet within the next step, however long it is, m.
/// @param approach bound of the speed at which their surfaces near each other, m/s
double contact_reach(const StepTerms& terms, double approach);

/// The same of body or side `a` and body `b`, as fast as they are now in whatever direction, m.
double contact_reach(const StepTerms& terms, const Bodies& bodies, std::int32_t a, std::int32_t b);

/// Moves islands. Holds work buffers alone: what it does depends on its arguments only.
class IslandStepper {
 public:
  explicit IslandStepper(const NativeOptions& options) : options_(options) {}

  /// True when the bodies, all without velocity, stay where they are under the pull: forces within every contact's
  /// cone are found that balance each body to the tolerance. The manifolds' memory is set to these forces; it stays
  /// as it is where it already balances.
  /// @param leans some bodies lean on others that they have not yet pushed: only those may hold them that they push as
  ///              they begin to move by Coulomb's law
  bool rests(Scene& scene, const IslandView& island, const StepTerms& terms, bool leans, IslandReport& report);

  /// Takes the island a step forward, cut at impacts. Activates manifolds that the bodies would overlap at.
  void advance(Scene& scene, const IslandView& island, const StepTerms& terms, IslandReport& report);

 private:
  enum class Purpose { smooth, impact, rest, projection };

  /// The first overlap that a step would bring.
  struct Event {
    bool activated = false;                                 ///< manifolds became active: the step must be solved again
    double time = std::numeric_limits<double>::infinity();  ///< of the first fast impact, s from the step's start
  };

  void load(const Scene& scene, const IslandView& island, const StepTerms& terms, Purpose purpose, double step);
  void add_patches(const Scene& scene, std::uint32_t index, const StepTerms& terms, Purpose purpose, double step);
  void predict(const Scene& scene, const IslandView& island, const StepTerms& terms, double step);
  void remember(Scene& scene, const IslandView& island, Purpose purpose, double step) const;
  void resolve_impacts(Scene& scene, const IslandView& island, const StepTerms& terms, double step,
                       IslandReport& report);
  Vec3 end_velocity(const Bodies& bodies, std::int32_t body, const Vec3& point) const;
  double end_parting(const Bodies& bodies, const Manifold& manifold, const ContactPoint& point) const;
  void activate_nearby(Scene& scene, const IslandView& island, const StepTerms& terms, double step) const;
  Event find_overlap(Scene& scene, const IslandView& island, const StepTerms& terms, double step);
  bool pass_on(const Scene& scene, const IslandView& island, const StepTerms& terms, double step);
  double first_stop(const Scene& scene, const StepTerms& terms, double step) const;
  bool is_solved(const ContactPoint& point, double parting, const StepTerms& terms, double step) const;
  bool is_closed(const ContactPoint& point, const StepTerms& terms, double step) const;
  double slow_gap(const StepTerms& terms, double step) const;
  double fast_approach(const StepTerms& terms) const;
  void begin_motion(const IslandView& island, const StepTerms& terms, IslandReport& report);
  SplittingOptions cold_options() const;
  bool admit_pushed(const Scene& scene);
  bool find_balance(const StepTerms& terms, IslandReport& report);
  void move(Scene& scene, const IslandView& island, const StepTerms& terms, double step, double share);
  bool renew(Scene& scene, const IslandView& island, const StepTerms& terms);
  void project(Scene& scene, const IslandView& island, const StepTerms& terms, IslandReport& report);
  SplittingResult run(const SplittingOptions& options, const StepTerms& terms, double step, IslandReport& report);
  std::int32_t local(std::int32_t body) const { return body < 0 ? fixed_ : place_[static_cast<std::size_t>(body)]; }

  NativeOptions options_;
  Effort effort_;  ///< for the island that is stepped
  Splitting solver_;
  std::int32_t fixed_ = 0;                 ///< local index of what is fixed
  std::vector<std::int32_t> place_;        ///< of a body of the scene in the solver
  std::vector<Mat3> turn_mid_, turn_end_;  ///< predicted rotation from the start of the step, by place, where it turns
  std::vector<std::uint8_t> turning_;
  std::vector<BodyPair> pairs_;
  /// Where a patch comes from: manifold and the points of its lanes.
  struct Source {
    std::uint32_t manifold;
    std::array<std::uint8_t, kLanes> point;
  };
  std::vector<Source> sources_;
  /// A manifold of the scene: its points that take part in an impact, those that could, and those that are solved
  /// because they were found to close within the step, a bit each.
  std::vector<std::uint8_t> struck_, touching_, met_;
  bool captures_ = false;  ///< a contact of the solve closes too fast for the step and too slow to be located
  std::vector<std::uint8_t> captured_;  ///< 1: a body, by place, at such a contact
  bool may_cut_ = true;                 ///< impacts that lie ahead may cut the step; else they are solved at its end
};

}  // namespace holdfast::internal::native
