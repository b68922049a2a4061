// Bytes that Jolt writes its state into, and reads it from.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/StateRecorder.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace plumb::jolt {

/// Appends to bytes; reads what it is given from the beginning on.
class Recorder final : public JPH::StateRecorder {
 public:
  explicit Recorder(std::vector<std::byte>& bytes) : bytes_(&bytes) {}
  explicit Recorder(std::span<const std::byte> data) : rest_(data) {}

  void WriteBytes(const void* data, std::size_t count) override {
    const auto* from = static_cast<const std::byte*>(data);
    bytes_->insert(bytes_->end(), from, from + count);
  }
  /// Zeros where there is no more.
  void ReadBytes(void* data, std::size_t count) override {
    failed_ = failed_ || count > rest_.size();
    if (failed_) {
      std::memset(data, 0, count);
      return;
    }
    std::memcpy(data, rest_.data(), count);
    rest_ = rest_.subspan(count);
  }
  [[nodiscard]] bool IsEOF() const override { return failed_; }
  [[nodiscard]] bool IsFailed() const override { return failed_; }
  [[nodiscard]] std::span<const std::byte> rest() const { return rest_; }

 private:
  std::vector<std::byte>* bytes_ = nullptr;
  std::span<const std::byte> rest_;
  bool failed_ = false;
};

}  // namespace plumb::jolt
