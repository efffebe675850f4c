#include "app/shared_script.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "app/program_folder.hpp"

namespace holdfast::internal {

std::optional<int> run_shared_script(const std::string& name, const std::vector<std::string>& arguments) {
  // Debian's Python: the one whose packages apt installs. -B, since the folder may not be ours to write into.
  std::vector<std::string> texts = {"/usr/bin/python3", "-B", (share_folder() / name).string()};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> words;
  for (std::string& text : texts) words.push_back(text.data());
  words.push_back(nullptr);
  pid_t child = 0;
  int status = 0;
  if (posix_spawn(&child, words.front(), nullptr, nullptr, words.data(), environ) != 0) return std::nullopt;
  if (waitpid(child, &status, 0) != child) return std::nullopt;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kBySignal + WTERMSIG(status);
}

}  // namespace holdfast::internal
