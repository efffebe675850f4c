#include "app/uncaught.hpp"

#include <unistd.h>

#include <cstring>
#include <exception>
#include <new>

#include "app/exit_code.hpp"

namespace holdfast {

namespace {

thread_local const char* layout_in_hand = nullptr;
thread_local const char* acceleration_in_hand = nullptr;

/// Without memory of its own: there may be none.
void say(const char* text) { static_cast<void>(!::write(STDERR_FILENO, text, std::strlen(text))); }

void say_cause() {
  try {
    if (const auto uncaught = std::current_exception()) std::rethrow_exception(uncaught);
    say("an error that nobody can name");
  } catch (const std::bad_alloc&) {
    say("memory ran out");
  } catch (const std::exception& exception) {
    say(exception.what());
  } catch (...) {
    say("an unknown error");
  }
}

[[noreturn]] void end_with_message() {
  if (layout_in_hand != nullptr) {
    say(layout_in_hand);
    say(" under ");
    say(acceleration_in_hand);
    say(": ");
  }
  say_cause();
  say("; take less with fewer --threads, a longer ResultsIntervallInSeconds, or --no-series; finished parts are kept, "
      "and "
      "--resume goes on from them\n");
  ::_exit(static_cast<int>(ExitCode::some_failed));
}

}  // namespace

void report_uncaught() { std::set_terminate(end_with_message); }

WorkInHand::WorkInHand(const std::string& layout, const std::string& acceleration) {
  layout_in_hand = layout.c_str();
  acceleration_in_hand = acceleration.c_str();
}

WorkInHand::~WorkInHand() { layout_in_hand = acceleration_in_hand = nullptr; }

}  // namespace holdfast
