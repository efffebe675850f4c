#include "instance.hpp"

#include <fstream>
#include <stdexcept>

int Instance::box_count() const {
  int count = 0;
  for (const BoxType& type : types) count += type.count;
  return count;
}

Instance read_instance(const std::string& path, int problem) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": cannot be opened");
  const auto number = [&] {
    int value = 0;
    if (!(file >> value)) throw std::runtime_error(path + ": ends early, or has something that is no whole number");
    return value;
  };
  const auto positive = [&] {
    const int value = number();
    if (value < 1) throw std::runtime_error(path + ": " + std::to_string(value) + " where a positive number is needed");
    return value;
  };
  const int problems = positive();
  if (problem < 1 || problem > problems)
    throw std::runtime_error(path + ": no problem " + std::to_string(problem) + "; there are 1 to " +
                             std::to_string(problems));
  Instance instance;
  for (int i = 0; i < problem; ++i) {
    number(), number();  // of the problem, and the seed that it was drawn with
    for (int& extent : instance.container) extent = positive();
    instance.types.resize(static_cast<std::size_t>(positive()));
    for (BoxType& type : instance.types) {
      number();  // of the type
      for (std::size_t axis = 0; axis < 3; ++axis) {
        type.edges[axis] = positive();
        type.may_be_upright[axis] = number() == 1;
      }
      type.count = positive();
    }
  }
  return instance;
}
