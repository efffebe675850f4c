#pragma once

#include <string_view>

/// What every text does to a reader: it is read or refused, and what comes out keeps what the reader promises.
/// Throws `std::logic_error` when it does not; libFuzzer and Catch2 both take that for a finding.
namespace fuzz {

void read_layout(std::string_view text);
void read_acceleration(std::string_view text);
void read_config(std::string_view text);

/// Files of loads: tables and JSON, as `classify` and the program take them.
void read_load_file(std::string_view text);

/// Every line is one request to `holdfast serve`.
void read_requests(std::string_view text);

}  // namespace fuzz
