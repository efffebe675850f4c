#include "instance.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

int Instance::box_count() const {
  int count = 0;
  for (const BoxType& type : types) count += type.count;
  return count;
}

namespace {

/// The numbers of a file, one after the other.
class Numbers {
 public:
  explicit Numbers(const std::string& path) : path_(path), file_(path) {
    if (!file_) throw std::runtime_error(path + ": cannot be opened");
  }

  template <class Number>
  Number next() {
    Number value = 0;
    if (!(file_ >> value)) throw std::runtime_error(path_ + ": ends early, or has something that is no such number");
    return value;
  }
  template <class Number>
  Number positive() {
    const auto value = next<Number>();
    if (!(value > 0)) {
      std::ostringstream text;
      text << path_ << ": " << value << " where a positive number is needed";
      throw std::runtime_error(text.str());
    }
    return value;
  }
  bool at_end() { return (file_ >> std::ws).eof(); }

 private:
  std::string path_;
  std::ifstream file_;
};

void read_edges(Numbers& numbers, BoxType& type) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    type.edges[axis] = numbers.positive<int>();
    type.may_be_upright[axis] = numbers.next<int>() == 1;
  }
  type.count = numbers.positive<int>();
}

Instance next_instance(Numbers& numbers) {
  Instance instance;
  numbers.next<int>(), numbers.next<int>();  // of the problem, and the seed that it was drawn with
  for (int& extent : instance.container) extent = numbers.positive<int>();
  instance.types.resize(numbers.positive<std::size_t>());
  for (BoxType& type : instance.types) {
    numbers.next<int>();  // of the type
    read_edges(numbers, type);
  }
  return instance;
}

Instance next_instance_with_masses(Numbers& numbers) {
  Instance instance;
  for (int& extent : instance.container) extent = numbers.positive<int>();
  instance.types.resize(numbers.positive<std::size_t>());
  numbers.positive<double>();  // volume of all boxes
  for (BoxType& type : instance.types) {
    read_edges(numbers, type);
    type.mass = numbers.positive<double>();
    for (int side = 0; side < 3; ++side) numbers.next<double>();
  }
  return instance;
}

/// Whether the first line is a container, and not the number of problems.
bool has_masses(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::istringstream words(line);
  return std::distance(std::istream_iterator<std::string>(words), {}) == 3;
}

}  // namespace

Instance read_instance(const std::string& path, int problem) {
  Numbers numbers(path);
  const bool masses = has_masses(path);
  const int problems = masses ? std::numeric_limits<int>::max() : numbers.positive<int>();
  for (int i = 1; i <= std::min(problem, problems) && !(masses && numbers.at_end()); ++i) {
    Instance instance = masses ? next_instance_with_masses(numbers) : next_instance(numbers);
    if (i == problem) return instance;
  }
  throw std::runtime_error(path + ": no problem " + std::to_string(problem) +
                           (masses ? "" : "; there are 1 to " + std::to_string(problems)));
}
