#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.hpp"
#include "core/model/settings.hpp"
#include "io/loads/read_load.hpp"

namespace holdfast::internal {

/// Whether a text is an object with the key `holdfast`: JSON of ours. It is read up to that key.
bool is_own_json(std::string_view text);

/// Reads JSON of ours, as docs/start/loads.md describes it, while it is parsed: there is no tree in memory. All
/// mistakes of a load are reported, up to the limit of ErrorList.
class OwnJson {
 public:
  /// All must outlive this.
  /// @param path of the file, for messages
  /// @param name of the file, without the folder
  OwnJson(const std::string& path, const std::string& name, const Settings& settings);
  OwnJson(const OwnJson&) = delete;
  OwnJson& operator=(const OwnJson&) = delete;
  ~OwnJson();

  /// Adds the loads of an object with the key `holdfast`, or says why the text is no JSON. What it says of all loads
  /// holds for those that `read_load` adds later, too.
  /// @param line of the text in the file; 0 where it is the whole file
  std::optional<Error> read_file(std::string_view text, long line);

  /// Adds a load, or says why the text is no JSON.
  std::optional<Error> read_load(std::string_view text, long line);

  LoadsOfFile take();

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace holdfast::internal
