// Numbers as the bytes of a file, little end first as every machine has them that this runs on.
#pragma once

#include <string>

namespace plumb::harness {

template <class Number>
void put(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace plumb::harness
