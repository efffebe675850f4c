#include "app/view/served_page.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <random>

#include "api/plugin_file.hpp"
#include "app/page_server/page_server.hpp"
#include "app/view/viewer_page.hpp"

namespace holdfast::internal {

namespace {

/// 128 bits that nobody can guess, as text.
std::string new_token() {
  std::random_device source;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", source());
  return token;
}

}  // namespace

std::optional<Error> serve_page(const std::string& page, const std::string& results_path, int port,
                                const std::function<void(const std::string&)>& listening) {
  void* library = dlopen(plugin_file(kServePagePlugin).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return Error{.what = "the page server cannot be loaded", .value = dlerror()};
  auto* entry = reinterpret_cast<ServePage*>(dlsym(library, kServePageEntry));
  if (entry == nullptr) return Error{.what = "no page server", .value = kServePagePlugin};
  const std::string name = std::filesystem::path(results_path).filename().string();
  std::optional<Error> error;
  (*entry)({.page = page_with_address(page, name, kResultsAddress),
            .results_path = results_path,
            .token = new_token(),
            .port = port},
           listening, error);
  return error;
}

}  // namespace holdfast::internal
