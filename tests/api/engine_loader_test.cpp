#include "api/engine_loader.hpp"

#include <catch2/catch.hpp>

namespace engine_loader_test {

using namespace holdfast::internal;

TEST_CASE("engine_loader: every engine can be made and knows its name", "[api][engine_loader]") {
  REQUIRE_FALSE(engine_registry().empty());
  for (const EngineEntry& entry : engine_registry()) {
    CAPTURE(entry.name);
    CHECK_FALSE(entry.sentence.empty());
    const Result<std::unique_ptr<Engine>> engine = make_engine(std::string(entry.name), Settings{});
    if (!engine && entry.name == "bullet-opencl") {
      // A machine without a device, or a build without the library, says so.
      CHECK_THAT(engine.error().message(), Catch::Contains("OpenCL") || Catch::Contains("plug-in"));
      continue;
    }
    REQUIRE(engine);
    CHECK((*engine)->traits().name == entry.name);
  }
}

TEST_CASE("engine_loader: the default of the settings is the first", "[api][engine_loader]") {
  CHECK(engine_registry().front().name == Settings{}.screening.engine);
}

TEST_CASE("engine_loader: a misspelt engine gets a suggestion", "[api][engine_loader]") {
  const Result<std::unique_ptr<Engine>> engine = make_engine("bulet", Settings{});
  REQUIRE_FALSE(engine);
  CHECK(engine.error().message() == "unknown engine: bulet; did you mean 'bullet'?");
}

TEST_CASE("engine_loader: an unknown engine gets the list", "[api][engine_loader]") {
  const Result<std::unique_ptr<Engine>> engine = make_engine("warp", Settings{});
  REQUIRE_FALSE(engine);
  CHECK(engine.error().what == "unknown engine");
  for (const EngineEntry& entry : engine_registry())
    CHECK(engine.error().accepted.find(entry.name) != std::string::npos);
  CHECK_FALSE(make_engine("", Settings{}));
}

TEST_CASE("engine_loader: an engine refuses what it cannot model", "[api][engine_loader]") {
  Settings settings;
  settings.container.motion = ContainerMotion::free;
  settings.contact.friction_model = FrictionModel::pairs;
  settings.contact.box_floor = 0.5;
  settings.contact.box_wall = 0.3;
  for (const char* name : {"bullet", "bullet-f64", "bullet-stock"}) {
    const Result<std::unique_ptr<Engine>> engine = make_engine(name, settings);
    REQUIRE_FALSE(engine);
    CHECK(engine.error().message() ==
          "a free container is one body in Bullet, with one friction coefficient; "
          "BoxFloor and BoxWall must be equal, or Motion = prescribed");
  }
  settings.contact.box_wall = 0.5;
  CHECK(make_engine("bullet", settings));

  // Rows of materials, by what they mean for floor and walls.
  const auto row = [](Settings with, const char* partners, double coefficient) {
    with.contact.materials.set(*parse_partners(partners), coefficient);
    return with;
  };
  const Settings on_floor = row(settings, "carton, floor", 0.4);
  const Result<std::unique_ptr<Engine>> differing = make_engine("bullet", on_floor);
  REQUIRE_FALSE(differing);
  CHECK(differing.error().message() ==
        "a free container is one body in Bullet, with one friction coefficient: [Friction] carton, floor; "
        "carton, floor and carton, wall must be equal, or Motion = prescribed");
  CHECK(make_engine("bullet", row(on_floor, "carton, wall", 0.4)));
  CHECK(make_engine("bullet", row(settings, "carton, any", 0.4)));
  CHECK(make_engine("bullet", row(settings, "carton, pallet", 0.4)));
  CHECK_FALSE(make_engine("bullet", row(row(settings, "carton, any", 0.4), "carton, wall", 0.5)));
  Settings prescribed = on_floor;
  prescribed.container.motion = ContainerMotion::prescribed;
  CHECK(make_engine("bullet", prescribed));

  const Result<std::unique_ptr<Engine>> native = make_engine("native", settings);
  REQUIRE_FALSE(native);
  CHECK(native.error().message() ==
        "native moves boxes in a container that goes as the acceleration file says, and has no free one; "
        "Engine = bullet or bullet-f64, or Motion = prescribed");
}

}  // namespace engine_loader_test
