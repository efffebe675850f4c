#include "app/progress.hpp"

#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <string>

namespace progress_test {

using namespace holdfast::internal;

namespace {

/// A stream and what has been written to it.
class Captured {
 public:
  explicit Captured(bool terminal) {
    int writing = -1;
    if (terminal) {
      REQUIRE(openpty(&reading_, &writing, nullptr, nullptr, nullptr) == 0);
    } else {
      int ends[2];
      REQUIRE(pipe(ends) == 0);
      reading_ = ends[0];
      writing = ends[1];
    }
    stream = fdopen(writing, "w");
    REQUIRE(stream != nullptr);
    fcntl(reading_, F_SETFL, O_NONBLOCK);
  }
  ~Captured() {
    std::fclose(stream);
    close(reading_);
  }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;

  std::string read() {
    std::fflush(stream);
    std::string text;
    char buffer[256];
    for (ssize_t count = 0; (count = ::read(reading_, buffer, sizeof buffer)) > 0;)
      text.append(buffer, static_cast<std::size_t>(count));
    return text;
  }

  std::FILE* stream = nullptr;

 private:
  int reading_ = -1;
};

}  // namespace

TEST_CASE("progress: the text before anything is done", "[app][progress]") {
  RunProgress progress;
  progress.total = 12;
  CHECK(progress_text(progress, "worlds", 0.0) == "0/12 worlds");
  CHECK(progress_text(progress, "worlds", 5.0) == "0/12 worlds");
  progress.done = 3;
  CHECK(progress_text(progress, "worlds", 0.0) == "3/12 worlds");
}

TEST_CASE("progress: rate, share of steps skipped and time to go", "[app][progress]") {
  RunProgress progress;
  progress.total = 1000;
  progress.done = 100;
  progress.steps = 2000;
  progress.steps_skipped = 500;
  CHECK(progress_text(progress, "worlds", 4.0) == "100/1000 worlds  25 worlds/s  25 % of steps skipped  0:36 to go");
  CHECK(progress_text(progress, "worlds", 40.0) == "100/1000 worlds  2.50 worlds/s  25 % of steps skipped  6:00 to go");
  CHECK(progress_text(progress, "worlds", 4000.0) ==
        "100/1000 worlds  0.03 worlds/s  25 % of steps skipped  10:00:00 to go");
}

TEST_CASE("progress: what an earlier run finished counts as done, not as speed", "[app][progress]") {
  RunProgress progress;
  progress.total = 100;
  progress.resumed = 60;
  progress.done = 60;
  CHECK(progress_text(progress, "worlds", 10.0) == "60/100 worlds");
  progress.done = 80;
  CHECK(progress_text(progress, "worlds", 10.0) == "80/100 worlds  2.00 worlds/s  0:10 to go");
}

TEST_CASE("progress: one line drawn over and over on a terminal, wiped at the end", "[app][progress]") {
  RunProgress progress;
  progress.total = 12;
  Captured terminal(true);
  {
    ProgressLine line(progress, "worlds", terminal.stream, false);
    line.show();
    CHECK(terminal.read() == "\r0/12 worlds");
    line.show();
    CHECK(terminal.read() == "\r0/12 worlds");
    progress.total = 9;
    line.show();
    CHECK(terminal.read() == "\r0/9 worlds ");
    line.note("a note");
    CHECK(terminal.read() == "\r          \ra note\r\n");
    line.show();
    CHECK(terminal.read() == "\r0/9 worlds");
  }
  CHECK(terminal.read() == "\r          \r");
}

TEST_CASE("progress: nothing to wipe where nothing was drawn", "[app][progress]") {
  RunProgress progress;
  Captured terminal(true);
  { ProgressLine line(progress, "worlds", terminal.stream, false); }
  CHECK(terminal.read().empty());
}

TEST_CASE("progress: elsewhere no line is drawn over, and notes are plain", "[app][progress]") {
  RunProgress progress;
  progress.total = 12;
  Captured pipe(false);
  {
    ProgressLine line(progress, "worlds", pipe.stream, false);
    line.show();
    line.note("a note");
    line.show();
  }
  CHECK(pipe.read() == "a note\n");
}

TEST_CASE("progress: quiet keeps the notes", "[app][progress]") {
  RunProgress progress;
  for (const bool terminal : {true, false}) {
    Captured captured(terminal);
    {
      ProgressLine line(progress, "worlds", captured.stream, true);
      line.show();
      line.note("a note");
    }
    CHECK(captured.read() == (terminal ? "a note\r\n" : "a note\n"));
  }
}

}  // namespace progress_test
