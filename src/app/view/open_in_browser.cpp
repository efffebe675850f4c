#include "app/view/open_in_browser.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace holdfast::internal {

namespace {

constexpr std::chrono::milliseconds kStart(1000);  // in which a browser that cannot start has ended
constexpr std::chrono::milliseconds kLook(20);

}  // namespace

bool open_in_browser(const std::string& place) {
  std::string program = "xdg-open";
  std::string word = place;
  char* const words[] = {program.data(), word.data(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  // A browser that starts has much to say.
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, program.c_str(), &files, nullptr, words, environ);
  posix_spawn_file_actions_destroy(&files);
  if (failure != 0) return false;
  // What finds no browser says so at once. A browser may be the same process, and lasts as long as its windows.
  for (auto waited = kStart; waited > kStart.zero(); waited -= kLook) {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child) return status == 0;
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

}  // namespace holdfast::internal
