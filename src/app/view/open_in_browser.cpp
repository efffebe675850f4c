#include "app/view/open_in_browser.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace holdfast::internal {

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
  int status = 0;
  return waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace holdfast::internal
