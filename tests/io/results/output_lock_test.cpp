#include "io/results/output_lock.hpp"

#include <fstream>

#include "io/results/results_fixture.hpp"

namespace output_lock_test {

using namespace results_fixture;

namespace {

Result<OutputLock> take(const std::string& path) {
  std::optional<Error> warning;
  Result<OutputLock> lock = OutputLock::take(path, warning);
  CHECK_FALSE(warning);
  return lock;
}

}  // namespace

TEST_CASE("output_lock: one run at a time holds it, and its file is removed", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  {
    const OutputLock lock = require_value(take(path));
    const Result<OutputLock> second = take(path);
    REQUIRE_FALSE(second);
    CHECK(second.error().message().find("results.h5: is being written by another run") != std::string::npos);
    CHECK(take(folder / "other.h5"));
    CHECK(list_directory(path + ".parts") == std::vector<std::string>{"lock"});
  }
  CHECK_FALSE(std::filesystem::exists(path + ".parts"));
  CHECK(take(path));
}

TEST_CASE("output_lock: the lock file of a killed run is reused, and parts remain", "[io][results]") {
  const Folder folder;
  const std::string path = folder / "results.h5";
  std::filesystem::create_directory(path + ".parts");
  std::ofstream(path + ".parts/lock") << "";
  std::ofstream(path + ".parts/part-000001.h5") << "worlds";
  { const OutputLock lock = require_value(take(path)); }
  CHECK(list_directory(path + ".parts") == std::vector<std::string>{"part-000001.h5"});
}

TEST_CASE("output_lock: a folder that cannot be created is an error", "[io][results]") {
  const Folder folder;
  std::ofstream(folder / "file") << "";
  const Result<OutputLock> lock = take(folder / "file/results.h5");
  REQUIRE_FALSE(lock);
  CHECK(lock.error().what == "cannot be created");
}

}  // namespace output_lock_test
