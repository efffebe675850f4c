#pragma once

#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "api/apply_settings.hpp"
#include "api/c_arguments.hpp"
#include "api/c_settings.hpp"
#include "core/engine/engine_registry.hpp"
#include "core/engine/engine_support.hpp"
#include "core/engine/world_record.hpp"
#include "holdfast/holdfast.h"
#include "io/input/text_file.hpp"

#define EXPORTED extern "C" __attribute__((visibility("default")))

/// What the functions that the page calls have in common.
namespace holdfast::internal {

/// What a call leaves for the page. It has one thread: an answer is there until the next call.
struct PageAnswer {
  std::string message;          ///< why the call failed
  std::vector<double> numbers;  ///< what it has read or found
  std::string text;             ///< the same as a text
  std::string columns;          ///< a line for each column of `numbers`: its name and how many they are
};
inline PageAnswer page_answer;

/// Runs the work of a call. What it throws becomes the message, and the status.
template <class Work>
int call(Work&& work) noexcept {
  page_answer = {};
  try {
    work();
    return HOLDFAST_OK;
  } catch (const BadArgument& bad) {
    page_answer.message = bad.what;
    return HOLDFAST_BAD_ARGUMENT;
  } catch (const std::exception& error) {
    page_answer.message = error.what();
    return HOLDFAST_ERROR;
  }
}

/// The settings that a handle has, in the order in which they were set.
std::vector<holdfast::Setting> given_settings(const holdfast_settings* handle);

/// The settings behind a handle, where the default of `holdfast_world_new` is that of the page too.
Settings settings_of(const holdfast_settings* handle);

/// A text that the page has as a file.
/// @param name what messages call it
TextFile file_of(const char* name, const char* text);

/// The engine that settings name, which is one that the page has.
std::unique_ptr<Engine> engine_of(const Settings& settings);

/// Simulates a world to its end, as `holdfast screen` does.
/// @param series whether to record samples
WorldRecord simulate_world(const Engine& engine, const Layout& layout, const Acceleration& acceleration,
                           const Settings& settings, bool series);

/// Adds what became of a world to the numbers, in the order that `page_outcome_rows` tells.
void append(const holdfast::WorldOutcome& world);

}  // namespace holdfast::internal
