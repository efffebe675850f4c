#include "io/export/text_output.hpp"

#include <filesystem>

#include "io/results/results_fixture.hpp"

namespace text_output_test {

using namespace results_fixture;

namespace {

bool is_anything(const std::string&) { return true; }
bool is_nothing(const std::string&) { return false; }

}  // namespace

TEST_CASE("text_output: a file is created or replaced, without temporary files", "[io]") {
  const Folder folder;
  const std::string path = folder / "a.txt";
  for (const std::string text : {"first\n", "", "second\n"}) {
    require_ok(check_output_file(path, is_anything));
    require_ok(write_text_file(path, text));
    CHECK(file_bytes(path) == text);
    CHECK(list_directory(folder / "") == std::vector<std::string>{"a.txt"});
  }
}

TEST_CASE("text_output: a symbolic link is not replaced", "[io]") {
  const Folder folder;
  require_ok(write_text_file(folder / "a.txt", "first\n"));
  std::filesystem::create_symlink("a.txt", folder / "link");
  require_ok(write_text_file(folder / "link", "second\n"));
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(file_bytes(folder / "a.txt") == "second\n");
}

TEST_CASE("text_output: an unwritable path or a file of another kind is an error", "[io]") {
  const Folder folder;
  require_ok(write_text_file(folder / "a.txt", "text\n"));
  require_ok(write_text_file(folder / "empty.txt", ""));
  CHECK(check_output_file(folder / "a.txt", is_nothing));
  CHECK(file_bytes(folder / "a.txt") == "text\n");
  CHECK_FALSE(check_output_file(folder / "empty.txt", is_nothing));
  CHECK(check_output_file("", is_anything));
  for (const std::string& path :
       {folder / "", folder / "none/a.txt", folder / "a.txt/a.txt", std::string("/dev/null")}) {
    CAPTURE(path);
    CHECK(check_output_file(path, is_anything));
  }
  CHECK(write_text_file(folder / "none/a.txt", "text\n"));
}

}  // namespace text_output_test
