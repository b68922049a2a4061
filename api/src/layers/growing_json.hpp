// A file of JSON that is whole whenever nobody writes to it: what comes is put before its closing brackets, and they
// are written anew behind it, by one write.
#pragma once

#include <fstream>
#include <string>

namespace plumb::layers {

class GrowingJson {
 public:
  /// The file begins with head and ends with tail. Look at good() for whether it could be written.
  GrowingJson(const std::string& path, const std::string& head, std::string tail) : tail_(std::move(tail)) {
    out_.rdbuf()->pubsetbuf(nullptr, 0);  // a buffer would cut what is to be one write
    out_.open(path, std::ios::binary);
    std::string text = head;
    append(text);
  }

  /// text is left empty, with its memory.
  void append(std::string& text) {
    const auto size = static_cast<std::streamoff>(text.size());
    text += tail_;
    out_.seekp(end_);
    out_.write(text.data(), static_cast<std::streamsize>(text.size()));
    end_ += size;
    text.clear();
  }
  [[nodiscard]] bool good() const { return out_.good(); }
  void close() { out_.close(); }

 private:
  std::ofstream out_;
  std::string tail_;
  std::streamoff end_ = 0;  ///< where the tail begins
};

}  // namespace plumb::layers
