#pragma once

#include <string>

namespace holdfast {

/// Has an exception that nobody can catch end the program with a message and the exit code `some_failed`: memory that
/// ran out where a library cannot go back, a thread that cannot be had. What is in finished parts is kept.
void report_uncaught();

/// What this thread works on, for that message, until its end. The texts must outlive it.
class WorkInHand {
 public:
  WorkInHand(const std::string& layout, const std::string& acceleration);
  WorkInHand(const WorkInHand&) = delete;
  WorkInHand& operator=(const WorkInHand&) = delete;
  ~WorkInHand();
};

}  // namespace holdfast
