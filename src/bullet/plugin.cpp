#include "bullet/bullet_engine.hpp"
#include "core/engine_plugin.hpp"

using namespace holdfast;

extern "C" __attribute__((visibility("default"))) void holdfast_make_engine(const std::string& name,
                                                                            const Settings& settings,
                                                                            Result<std::unique_ptr<Engine>>& engine) {
  std::vector<Error> errors = unsupported_by_bullet(settings);
  if (errors.empty()) {
    engine = std::unique_ptr<Engine>(std::make_unique<BulletEngine>(name, settings));
  } else {
    engine = std::move(errors);
  }
}
