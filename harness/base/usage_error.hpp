// What a user asks wrongly.
#pragma once

#include <stdexcept>

namespace plumb::harness {

/// The text names the thing, the value and the remedy. The program ends with status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace plumb::harness
