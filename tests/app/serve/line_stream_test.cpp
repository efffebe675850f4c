#include "app/serve/line_stream.hpp"

#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <vector>

namespace line_stream_test {

using namespace holdfast::internal;

namespace {

/// A pipe whose writing end is closed when the text is in it.
class FilledPipe {
 public:
  explicit FilledPipe(const std::string& text) {
    REQUIRE(::pipe(ends_.data()) == 0);
    REQUIRE(::write(ends_[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    ::close(ends_[1]);
  }
  FilledPipe(const FilledPipe&) = delete;
  FilledPipe& operator=(const FilledPipe&) = delete;
  ~FilledPipe() { ::close(ends_[0]); }

  int descriptor() const { return ends_[0]; }

 private:
  std::array<int, 2> ends_ = {};
};

/// The lines, `?` for one that is too long, each with its number.
std::vector<std::string> lines_of(const std::string& text, std::size_t longest) {
  const FilledPipe pipe(text);
  LineStream stream(pipe.descriptor(), longest);
  std::vector<std::string> lines;
  while (true) {
    while (const auto line = stream.next())
      lines.push_back(std::to_string(line->number) + (line->too_long ? "?" : ":" + std::string(line->text)));
    if (stream.ended()) return lines;
    stream.read_some();
  }
}

}  // namespace

TEST_CASE("line_stream: lines with their numbers; the last one needs no end", "[app][line_stream]") {
  using Lines = std::vector<std::string>;
  CHECK(lines_of("", 10).empty());
  CHECK(lines_of("a", 10) == Lines{"1:a"});
  CHECK(lines_of("a\n", 10) == Lines{"1:a"});
  CHECK(lines_of("a\n\nb\r\nc", 10) == Lines{"1:a", "2:", "3:b\r", "4:c"});
}

TEST_CASE("line_stream: a line that is too long is counted, and the next one is whole", "[app][line_stream]") {
  using Lines = std::vector<std::string>;
  CHECK(lines_of("0123456789\n0123456789a\nb", 10) == Lines{"1:0123456789", "2?", "3:b"});
  CHECK(lines_of("0123456789a", 10) == Lines{"1?"});
  const std::string long_line(50'000, 'x');
  CHECK(lines_of(long_line + "\nend\n", 1000) == Lines{"1?", "2:end"});
  CHECK(lines_of("a\n" + long_line, 1000) == Lines{"1:a", "2?"});
}

TEST_CASE("line_stream: what cannot be read has a reason", "[app][line_stream]") {
  LineStream stream(-1, 10);
  CHECK(!stream.next());
  stream.read_some();
  CHECK(stream.ended());
  CHECK(!stream.next());
  CHECK(!stream.failure().empty());
}

}  // namespace line_stream_test
