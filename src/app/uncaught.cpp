#include "app/uncaught.hpp"

#include <unistd.h>

#include <cstring>
#include <exception>
#include <new>

#include "app/exit_code.hpp"
#include "parallel/screening/work_in_hand.hpp"

namespace holdfast::internal {

namespace {

/// Without memory of its own: there may be none.
void say(const char* text) { static_cast<void>(!::write(STDERR_FILENO, text, std::strlen(text))); }

void say_cause() {
  try {
    if (const auto uncaught = std::current_exception()) std::rethrow_exception(uncaught);
    say("an error of unknown kind");
  } catch (const std::bad_alloc&) {
    say("memory ran out");
  } catch (const std::exception& exception) {
    say(exception.what());
  } catch (...) {
    say("an unknown error");
  }
}

[[noreturn]] void end_with_message() {
  if (WorkInHand::layout() != nullptr) {
    say(WorkInHand::layout());
    say(" under ");
    say(WorkInHand::acceleration());
    say(": ");
  }
  say_cause();
  say("; take less with fewer --threads, a longer ResultsIntervallInSeconds, or --no-series; finished parts are kept, "
      "and --resume continues from them\n");
  ::_exit(static_cast<int>(ExitCode::some_failed));
}

}  // namespace

void report_uncaught() { std::set_terminate(end_with_message); }

}  // namespace holdfast::internal
