#pragma once

#include <memory>
#include <string>

#include "core/base/result.hpp"
#include "core/engine/engine.hpp"
#include "core/model/settings.hpp"

namespace holdfast::peers {

/// Makes the engine that a name of the command line stands for, with its setting:
///
///   native-screening, native-standard, native-reference    the accuracies of native
///   native-screening:StepsPerSecond=240:Iterations=32      with keys of the section [Native]
///   bullet, bullet-stock, ...                              the other engines, with keys of [Bullet]
///   box3d-60x4[k][s]        60 steps/s of 4 substeps; k: as stiff as the rate allows; s: with sleeping
///   jolt-60[x20x4][p][s]    60 steps/s; 20 velocity and 4 position iterations; p: precise; s: with sleeping
///
/// An error says what is wrong with the name, or that this build has no such peer.
/// @param settings of the world; the engine keeps a copy
internal::Result<std::unique_ptr<internal::Engine>> engine_of(const std::string& name,
                                                              const internal::Settings& settings);

}  // namespace holdfast::peers
