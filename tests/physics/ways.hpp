#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "scenes.hpp"

namespace holdfast::internal::physics {

/// An engine, with the accuracy where it has several.
struct Way {
  std::string engine;
  Accuracy accuracy = Accuracy::standard;
};

/// Every engine that simulates all of the model, one after the other.
inline Way any_way() {
  return GENERATE(Way{"native", Accuracy::screening}, Way{"native", Accuracy::standard},
                  Way{"native", Accuracy::reference}, Way{"native-plain"}, Way{"bullet"}, Way{"bullet-f64"});
}

inline scenes::Run run_by(const Way& way, const Layout& layout, const Acceleration& acceleration, Settings settings) {
  settings.native.accuracy = way.accuracy;
  return scenes::run(way.engine, layout, acceleration, settings);
}

}  // namespace holdfast::internal::physics
