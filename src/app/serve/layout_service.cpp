#include "app/serve/layout_service.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <string_view>
#include <utility>

#include "api/convert.hpp"
#include "app/report.hpp"
#include "parallel/screening/world_limits.hpp"

namespace holdfast::internal {

namespace {

/// Bytes of a line: 20,000 boxes, which are the most, with all digits.
constexpr std::size_t kLongestLine = std::size_t{8} << 20U;

/// Lines per thread without an answer: enough that no thread waits for the next line; fewer with series, which are
/// large.
constexpr std::size_t kOpenPerThread = 16;
constexpr std::size_t kOpenPerThreadWithSeries = 1;

constexpr int kPatience = 100;  // ms between two looks for a signal

Error error_of(const holdfast::Problem& problem) {
  return {.what = problem.what,
          .value = problem.value,
          .accepted = problem.accepted,
          .box = problem.box + 1,
          .box_number = problem.box_column + 1};
}

/// Throws when a series would have too many samples.
void check_length(const holdfast::Acceleration& acceleration, const Settings& settings) {
  if (const auto error = check_samples(acceleration.name, value_or_throw(read_acceleration(acceleration)), settings))
    throw exception_of({*error});
}

}  // namespace

LayoutService::LayoutService(std::vector<holdfast::Acceleration> accelerations, holdfast::ScreenOptions options,
                             const Settings& settings, std::size_t threads, bool ordered, const StopSignal& stop)
    : accelerations_(std::move(accelerations)),
      screen_options_(std::move(options)),
      settings_(settings),
      threads_(threads),
      stop_(stop),
      input_(STDIN_FILENO, kLongestLine),
      answers_(ordered, stop.drop) {
  for (const holdfast::Acceleration& acceleration : accelerations_) names_.push_back(acceleration.name);
  screen_options_.most_in_flight = kOpenPerThread * threads;
  screen_options_.on_finished = [this] { finished_.wake(); };
  make_screen({});
}

ExitCode LayoutService::run() {
  while (true) {
    give_finished();
    if (stop_.drop) break;
    submit_waiting();
    take_lines();
    // What was answered at once may have made room for what has been read already.
    if (answers_.outstanding() == 0 && (stop_.no_more || input_.ended())) break;
    wait();
  }
  if (stop_.signal != 0) {
    screen_->cancel();
    print_to(stderr, "stopped after {} answers\n", answers_.written());
    return exit_code_of(stop_);
  }
  if (input_.failure().empty()) return ExitCode::done;
  return fail(ExitCode::some_failed, {.file = "standard input", .what = "cannot be read", .value = input_.failure()});
}

void LayoutService::make_screen(const RequestOptions& wanted) {
  screen_.reset();  // its threads end before others are started
  options_ = wanted;
  screen_options_.unit = wanted.unit;
  screen_options_.keep_boxes = wanted.per_box;
  screen_options_.keep_series = wanted.series;
  screen_.emplace(screen_options_);
  screen_names_.clear();
  const auto add = [&](const holdfast::Acceleration& acceleration) {
    if (wanted.series) check_length(acceleration, settings_);
    screen_->add_acceleration(acceleration);
    screen_names_.push_back(acceleration.name);
  };
  for (const std::size_t index : wanted.accelerations) add(accelerations_[index]);
  if (!wanted.accelerations.empty()) return;
  for (const holdfast::Acceleration& acceleration : accelerations_) add(acceleration);
}

std::size_t LayoutService::most_open() const {
  return threads_ * (options_.series ? kOpenPerThreadWithSeries : kOpenPerThread);
}

void LayoutService::take_lines() {
  while (may_read()) {
    const std::optional<InputLine> line = input_.next();
    if (!line) return;
    take(*line);
  }
}

void LayoutService::take(const InputLine& line) {
  if (!line.too_long && line.text.find_first_not_of(" \t\r") == std::string_view::npos) return;
  Open open{answers_.announce(), {.layout = layouts_++, .line = line.number}};
  if (line.too_long)
    return answers_.give(open.ticket,
                         error_text(open.line, {.what = "the line is too long",
                                                .accepted = fmt::format("at most {} bytes", kLongestLine)}));
  ReadRequest read = read_request(line.text, names_);
  open.line.id = std::move(read.request.id);
  open.line.box_names = read.request.box_names();
  if (read.error) return answers_.give(open.ticket, error_text(open.line, *read.error));
  if (read.request.options == options_) return submit(open, line.text, read.request);
  waiting_ = Waiting{std::move(open), std::string(line.text), std::move(read.request)};
  submit_waiting();
}

void LayoutService::submit_waiting() {
  if (!waiting_ || !in_flight_.empty()) return;
  const Waiting waiting = *std::exchange(waiting_, std::nullopt);
  try {
    make_screen(waiting.request.options);
  } catch (const holdfast::Error& error) {
    options_ = {};
    make_screen({});
    return answers_.give(waiting.open.ticket, error_text(waiting.open.line, error_of(error.problems().front())));
  }
  submit(waiting.open, waiting.text, waiting.request);
}

void LayoutService::submit(const Open& open, std::string_view text, const LayoutRequest& request) {
  try {
    const std::string name = fmt::format("layout {}", open.line.layout);
    holdfast::LayoutView view{name, request.numbers};
    if (request.layout) view.layout = &*request.layout;
    const auto ticket = screen_->submit(view);
    in_flight_.emplace(ticket.value(), open);  // there is room: the screen has no more in flight than has no answer
  } catch (const holdfast::Error& exception) {
    const holdfast::Problem& problem = exception.problems().front();
    Error error = error_of(problem);
    error.column = column_of(text, request, problem.box, problem.box_column);
    answers_.give(open.ticket, error_text(open.line, error, exception.problems().size() - 1));
  }
}

void LayoutService::give_finished() {
  finished_.clear();
  holdfast::FinishedLayout finished;
  while (!stop_.drop) {
    std::optional<Error> error;
    try {
      if (!screen_->poll(finished)) return;
    } catch (const holdfast::Error& exception) {
      error = error_of(exception.problems().front());
    }
    const Open open = std::move(in_flight_.extract(finished.ticket).mapped());
    answers_.give(open.ticket, error ? error_text(open.line, *error)
                                     : verdicts_text(open.line, finished.worlds, screen_names_, options_));
  }
}

void LayoutService::wait() {
  // A negative descriptor is passed over.
  const bool reads = may_read() && !input_.ended();
  std::array<pollfd, 2> events = {{{finished_.descriptor(), POLLIN, 0}, {reads ? STDIN_FILENO : -1, POLLIN, 0}}};
  if (::poll(events.data(), events.size(), kPatience) > 0 && events[1].revents != 0) input_.read_some();
}

}  // namespace holdfast::internal
