#include "io/input/text_file.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "io/input/memory_file.hpp"
#include "io/results/results_fixture.hpp"

namespace text_file_test {

using namespace holdfast::internal;
using namespace holdfast::internal::test;
using results_fixture::Folder;

TEST_CASE("text_file: a file of any length is read completely", "[io][text_file]") {
  const Folder folder;
  for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 200000U}) {
    const std::string path = folder / "a.txt";
    const std::string text(size, 'x');
    std::ofstream(path) << text;
    const Result<TextFile> file = read_text_file(path);
    REQUIRE(file);
    CHECK(file->text == text);
    CHECK(file->name == "a.txt");
    CHECK(file->sha256 == sha256_of(text));
  }
}

TEST_CASE("text_file: a file of the kernel, which reports no size, is read", "[io][text_file]") {
  const Result<TextFile> file = read_text_file("/proc/self/status");
  REQUIRE(file);
  CHECK(file->text.find("holdfast_tests") != std::string::npos);
}

TEST_CASE("text_file: a path that is not a regular file is refused without waiting", "[io][text_file]") {
  const Folder folder;
  const std::string pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const std::string cure = "; save its output in a file, and give that file";
  CHECK(messages_of(read_text_file(pipe)) == Messages{pipe + ": is a pipe, not a file" + cure});
  CHECK(messages_of(read_text_file("/dev/zero")) == Messages{"/dev/zero: is a device, not a file" + cure});
  CHECK(messages_of(read_text_file(folder / "")) == Messages{(folder / "") + ": is a folder; a file is needed here"});
  const std::string missing = folder / "none";
  CHECK(messages_of(read_text_file(missing)) == Messages{missing + ": cannot be read: No such file or directory"});
}

TEST_CASE("text_file: the hash is SHA-256", "[io][text_file]") {
  // The examples of FIPS 180-4, and the empty message.
  CHECK(sha256_of("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256_of("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

}  // namespace text_file_test
